// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Where two bodies are at a time of their motions, in long doubles and apart from the code that is
// tested.
#pragma once
#include <cmath>

#include "ofg/motion.hpp"

namespace moved {

struct Poses {
  ofg::Pose a, b;
};

namespace detail {

using Long = long double;
using Vec = ofg::Vec3<Long>;

// v turned by a quaternion of length 1.
inline Vec turned(const Long (&q)[4], const Vec& v) {
  const Vec u(q[1], q[2], q[3]), t = cross(u, v) * 2;
  return v + t * q[0] + cross(u, t);
}

// At time t, with positions relative to `origin`.
inline ofg::Pose pose(const ofg::Pose& from, const ofg::Motion& by, double t,
                      const ofg::Vec3<double>& origin) {
  Long q[4], size = 0;
  for (int i = 0; i < 4; ++i) size += Long(from.q[i]) * from.q[i];
  for (int i = 0; i < 4; ++i) q[i] = from.q[i] / std::sqrt(size);
  const Vec k(by.axis), p = Vec(from.p) - Vec(origin) + Vec(by.displacement) * Long(t);
  const Long half = Long(by.angle) * t / 2, s = std::sin(half) / length(k), c = std::cos(half);
  const Long turn[4] = {c, s * k.x, s * k.y, s * k.z};
  const Vec arm = turned(q, Vec(by.about)), u(turn[1], turn[2], turn[3]), w(q[1], q[2], q[3]),
            way = by.angle == 0 ? Vec() : arm - turned(turn, arm);
  const Vec v = w * turn[0] + u * q[0] + cross(u, w);
  ofg::Pose to;
  to.q[0] = double(turn[0] * q[0] - dot(u, w));
  to.q[1] = double(v.x), to.q[2] = double(v.y), to.q[3] = double(v.z);
  if (by.angle == 0)
    for (int i = 0; i < 4; ++i) to.q[i] = from.q[i];
  to.p = ofg::Vec3<double>(p + way);
  return to;
}

}  // namespace detail

// Positions relative to B's at the start.
inline Poses poses(const ofg::Pose& a, const ofg::Pose& b, const ofg::Motion& by_a,
                   const ofg::Motion& by_b, double t) {
  return {detail::pose(a, by_a, t, b.p), detail::pose(b, by_b, t, b.p)};
}

// How far points of bodies of this size are off in these poses: a quaternion by 2 units of 2^-53,
// what it turns by twice that, and a position by 1 unit.
inline double rounding(const ofg::Pose& a, const ofg::Pose& b, const ofg::Motion& by_a,
                       const ofg::Motion& by_b, double size) {
  return 1e-15 * (4 * size + length(a.p - b.p) + length(by_a.displacement) +
                  length(by_b.displacement) + 2 * length(by_a.about) + 2 * length(by_b.about));
}

}  // namespace moved
