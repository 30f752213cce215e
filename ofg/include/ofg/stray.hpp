// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Bounds on the deviation of the true paths of vertices from their chords, relative to the other
// body.
#pragma once
#include "mesh.hpp"
#include "motion.hpp"

namespace ofg::detail {

// No vertex of the body is farther from its centre of rotation: |v - c| <= |v| + |c|, and |v - c|
// <= |v - centre| + |centre - c|.
template <class T>
double lever_of(const Mesh<T>& m, const Mover& mover) {
  const double by_origin = double(m.extent) + length(mover.motion.about);
  return std::fmin(by_origin, double(m.radius) + mover.lever(Vec3<double>(m.centre)));
}

// Bound on |y''| of a point with this lever on one body, relative to the other. Let w and u be the
// angular velocities of its own body and of the other one, P and Q their centres of rotation, and R
// the other's rotation, so that
//   y = R^T r with r = x - Q,   y' = R^T (r' - u x r),   y'' = R^T (r'' - 2 u x r' + u x (u x r)),
// since u is constant. With x = P + s, |s| = lever and s' = w x s, and P and Q moving in straight
// lines:
//   |r'| <= |P' - Q'| + |w| lever,   |r''| <= |w|^2 lever.
// slide: |P' - Q'|; apart: bound on |r|.
inline double bend(double w, double u, double lever, double slide, double apart) {
  return w * w * lever + 2 * u * (slide + w * lever) + u * u * apart;
}

// The largest deviation of any vertex of A, relative to B, from its chord over a share h of the
// step, at the same share of both: |y''| h^2 / 8. |r| <= |P - Q| + lever; P - Q is linear in time,
// so its length is greatest at an end of the step.
template <class T>
double stray(const Mesh<T>& a, const Track& track, double h) {
  if (!track.turns()) return 0;
  const double lever = lever_of(a, track.a),
               apart = std::fmax(length(track.pivots(0)), length(track.pivots(1)));
  return bend(std::abs(track.a.motion.angle), std::abs(track.b.motion.angle), lever, track.slide(),
              apart + lever) *
         h * h / 8;
}

// The same for the vertices of B that meet A, relative to A. At the contact, |r| is at most A's
// lever; elsewhere in the window it is at most that plus the change by |r'|.
template <class T>
double stray_of_b(const Mesh<T>& a, const Mesh<T>& b, const Track& track, double h) {
  if (!track.turns()) return 0;
  const double w = std::abs(track.b.motion.angle), lever = lever_of(b, track.b);
  const double apart = lever_of(a, track.a) + (track.slide() + w * lever) * h;
  return bend(w, std::abs(track.a.motion.angle), lever, track.slide(), apart) * h * h / 8;
}

}  // namespace ofg::detail
