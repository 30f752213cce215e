// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// What the bounding and inscribed spheres of two hulls alone prove: the first step of verified
// overlap, and a step that any other method could take first.
#pragma once
#include "verified_portal.hpp"

namespace ofg::verified {

// A length is off by 4 units of rounding of itself, which slack covers: it counts 256. doubt: how
// far the spheres' centres may be from where `far` has them.
inline Verdict by_spheres(const Hull& a, const Hull& b, double far, double doubt) {
  if (far - doubt > a.radius + b.radius) return Verdict::apart;
  if (far + doubt < a.inner + b.inner) return Verdict::meeting;
  return Verdict::unsure;
}

inline Verdict by_spheres(const Hull& a, const Hull& b, const Frames& at) {
  return at.sure ? by_spheres(a, b, at.far, a.way + b.way + at.slack) : Verdict::unsure;
}

inline Verdict by_spheres(const Hull& a, const Hull& b, const Centres& at) {
  return at.sure ? by_spheres(a, b, length(at.between), at.slack) : Verdict::unsure;
}

// Without a rotation, if that is enough.
inline Verdict by_spheres(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb) {
  const Frames frames(a, b, pa, pb);
  const Verdict said = by_spheres(a, b, frames);
  return said != Verdict::unsure ? said : by_spheres(a, b, Centres(a, b, pa, pb, frames));
}

}  // namespace ofg::verified
