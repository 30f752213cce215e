// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Poses, motions over one step, and the motion of one body relative to the other. Always in double,
// whatever the meshes' type: positions far from the world's origin cancel in the relative pose.
#pragma once
#include "vector.hpp"

namespace ofg {

// World point = N(q)/|q|^2 v + p: the quaternion (w, x, y, z) may have any non-zero length.
struct Pose {
  double q[4] = {1, 0, 0, 0};
  Vec3<double> p;
};

// x(t) = p + R(q) c + t d + Rot(axis/|axis|, angle t) R(q) (v - c) for t in [0, 1]: a body rotates
// about its point c = `about`, which is given in its own frame.
struct Motion {
  Vec3<double> displacement;
  Vec3<double> axis{0, 0, 1};
  double angle = 0;
  Vec3<double> about;
};

template <class T>
struct Transform {
  Mat3<T> r;
  Vec3<T> p;
  Vec3<T> operator()(const Vec3<T>& v) const { return r * v + p; }
  Transform inverse() const {
    const Mat3<T> t = r.transposed();
    return {t, -(t * p)};
  }
  // The transformed points are in another unit of length.
  Transform in_units(T unit) const {
    Transform u{r, p * unit};
    for (auto& row : u.r.row) row = row * unit;
    return u;
  }
  template <class U>
  explicit operator Transform<U>() const {
    Transform<U> u;
    for (int i = 0; i < 3; ++i) u.r.row[i] = Vec3<U>(r.row[i]);
    u.p = Vec3<U>(p);
    return u;
  }
};

// N(q)/|q|^2 without a square root: rotations by 180 and 90 degrees about the axes are exact. In
// another unit if squares would overflow or underflow.
inline Mat3<double> rotation(const double (&q)[4]) {
  double w = q[0], x = q[1], y = q[2], z = q[3], n = w * w + x * x + y * y + z * z;
  if (!(n > 1e-100 && n < 1e100)) {
    const double unit = unit_of(std::fmax(std::abs(w), largest(Vec3<double>(x, y, z))));
    w *= unit, x *= unit, y *= unit, z *= unit;
    n = w * w + x * x + y * y + z * z;
  }
  Mat3<double> m;
  m.row[0] = {(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n,
              2 * (x * z + w * y) / n};
  m.row[1] = {2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n,
              2 * (y * z - w * x) / n};
  m.row[2] = {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n,
              (w * w - x * x - y * y + z * z) / n};
  return m;
}

inline Mat3<double> turn(const Vec3<double>& axis, double angle) {
  const double half = 0.5 * angle, s = std::sin(half) / length(axis);
  const double q[4] = {std::cos(half), s * axis.x, s * axis.y, s * axis.z};
  return rotation(q);
}

// One moving body: its start pose as a matrix, and its motion.
struct Mover {
  Mat3<double> r;
  Vec3<double> p;
  Motion motion;
  Vec3<double> arm;  // from the frame's origin to the centre of rotation, at the start, in the
                     // world; zero without rotation

  Mover(const Pose& pose, const Motion& m) : r(rotation(pose.q)), p(pose.p), motion(m) {
    if (turns()) {
      arm = r * m.about;
      motion.axis = m.axis * unit_of(largest(m.axis));  // its square stays in range
    } else {
      motion.about = {};  // without rotation any point will do
    }
  }
  bool turns() const { return motion.angle != 0; }
  Mat3<double> turned(double t) const { return turn(motion.axis, motion.angle * t); }
  // The distance of a point of the body from its centre of rotation.
  double lever(const Vec3<double>& v) const { return length(v - motion.about); }
  // The largest deviation of a point of the body with this lever from its chord over a share h of
  // the step: |x''| <= angle^2 lever, and at most the diameter of its circle.
  double stray(double lever, double h) const {
    const double turned = std::abs(motion.angle) * h;
    return lever * std::fmin(turned * turned / 8, 2.0);
  }
};

// The motion of A relative to B.
struct Track {
  Mover a, b;

  Track(const Pose& pose_a, const Pose& pose_b, const Motion& motion_a = {},
        const Motion& motion_b = {})
      : a(pose_a, motion_a), b(pose_b, motion_b) {}

  bool turns() const { return a.turns() || b.turns(); }

  // From the origin of B's frame at the start to A's, at time t without rotation: here positions
  // far from the world's origin cancel.
  Vec3<double> shift(double t) const {
    return (a.p - b.p) + (a.motion.displacement - b.motion.displacement) * t;
  }

  // A's frame in B's frame at time t.
  Transform<double> at(double t) const {
    if (!turns()) {
      const Mat3<double> rt = b.r.transposed();
      return {rt * a.r, rt * shift(t)};
    }
    Mat3<double> ra = a.r, rb = b.r;
    Vec3<double> d = shift(t);
    if (a.turns()) {
      const Mat3<double> turned = a.turned(t);
      ra = turned * a.r, d = d + (a.arm - turned * a.arm);
    }
    if (b.turns()) {
      const Mat3<double> turned = b.turned(t);
      rb = turned * b.r, d = d - (b.arm - turned * b.arm);
    }
    const Mat3<double> rt = rb.transposed();
    return {rt * ra, rt * d};
  }

  // From a point of B to a point of A (each in its own frame), in the world, at time t.
  Vec3<double> between(const Vec3<double>& in_a, const Vec3<double>& in_b, double t) const {
    const auto moved = [t](const Mover& m, const Vec3<double>& v) {
      const Vec3<double> w = m.r * v;
      return m.turns() ? m.turned(t) * (w - m.arm) + m.arm : w;
    };
    return shift(t) + moved(a, in_a) - moved(b, in_b);
  }

  // From B's centre of rotation to A's, at time t: linear in t.
  Vec3<double> pivots(double t) const { return shift(t) + (a.arm - b.arm); }

  // Lengths that a rotation adds and subtracts again: the rounding of poses is of their size.
  double arms() const { return length(a.arm) + length(b.arm); }

  // Bound on the relative velocity of the centres of rotation.
  double slide() const { return length(a.motion.displacement - b.motion.displacement); }

  // Bound on the speed (length per step) of a point of A with lever_a relative to B, where lever_b
  // is 0, or of a point of B with lever_b relative to A, where lever_a is 0; `apart` bounds the
  // distance between the centres of rotation. Relative to B, with r = x_A - P_B from B's centre of
  // rotation: |r' - w_B x r| <= slide + |w_A| lever_a + |w_B| (lever_a + apart).
  double speed(double lever_a, double lever_b, double apart) const {
    return slide() +
           (std::abs(a.motion.angle) + std::abs(b.motion.angle)) * (lever_a + lever_b + apart);
  }
};

}  // namespace ofg
