// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// What the bounding and inscribed spheres of two hulls alone prove: the first step of verified
// overlap, and a step that any other method could take first.
#pragma once
#include "verified_portal.hpp"

namespace ofg::verified {

// A length is off by 4 units of rounding of itself, which slack covers: it counts 256.
inline Verdict by_spheres(const Hull& a, const Hull& b, const Posed& at) {
  if (!at.sure) return Verdict::unsure;
  const double apart = length(at.between);
  if (apart > (a.radius + b.radius) * at.unit + at.slack) return Verdict::apart;
  if (apart + at.slack < (a.inner + b.inner) * at.unit) return Verdict::meeting;
  return Verdict::unsure;
}

}  // namespace ofg::verified
