// Poses, motions over one step, and the motion of one body as seen from the other. Always in double, whatever the meshes hold:
// the relative pose is where positions far from the world's origin cancel.
#pragma once
#include "vector.hpp"

namespace ofg {

// World point = N(q)/|q|^2 v + p: the quaternion (w, x, y, z) may have any non-zero length.
struct Pose {
  double q[4] = {1, 0, 0, 0};
  Vec3<double> p;
};

// x(t) = p + t d + Rot(axis/|axis|, angle t) R(q) v for t in [0, 1]: a body turns about its own frame's origin.
struct Motion {
  Vec3<double> displacement;
  Vec3<double> axis{0, 0, 1};
  double angle = 0;
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
  template <class U>
  explicit operator Transform<U>() const {
    Transform<U> u;
    for (int i = 0; i < 3; ++i) u.r.row[i] = Vec3<U>(r.row[i]);
    u.p = Vec3<U>(p);
    return u;
  }
};

// N(q)/|q|^2 without a square root: 180 and 90 degree turns about the axes are exact.
inline Mat3<double> rotation(const double (&q)[4]) {
  const double w = q[0], x = q[1], y = q[2], z = q[3], n = w * w + x * x + y * y + z * z;
  Mat3<double> m;
  m.row[0] = {(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n};
  m.row[1] = {2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n};
  m.row[2] = {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n};
  return m;
}

inline Mat3<double> turn(const Vec3<double>& axis, double angle) {
  const double half = 0.5 * angle, s = std::sin(half) / length(axis);
  const double q[4] = {std::cos(half), s * axis.x, s * axis.y, s * axis.z};
  return rotation(q);
}

// One moving body: its start pose resolved to a matrix, and its motion.
struct Mover {
  Mat3<double> r;
  Vec3<double> p;
  Motion motion;

  Mover(const Pose& pose, const Motion& m) : r(rotation(pose.q)), p(pose.p), motion(m) {}
  bool turns() const { return motion.angle != 0; }
  Transform<double> at(double t) const {
    return {turns() ? turn(motion.axis, motion.angle * t) * r : r, p + motion.displacement * t};
  }
  // How far a point of the body at this distance from its origin can stray from its chord over a share h of the step:
  // |x''| <= angle^2 distance, and no more than the diameter of its circle.
  double stray(double distance, double h) const {
    const double turned = std::abs(motion.angle) * h;
    return distance * std::fmin(turned * turned / 8, 2.0);
  }
};

// The motion of A as seen from B.
struct Track {
  Mover a, b;

  Track(const Pose& pose_a, const Pose& pose_b, const Motion& motion_a = {}, const Motion& motion_b = {})
      : a(pose_a, motion_a), b(pose_b, motion_b) {}

  bool turns() const { return a.turns() || b.turns(); }

  // A's frame in B's frame at time t.
  Transform<double> at(double t) const {
    if (!turns()) {
      const Mat3<double> rt = b.r.transposed();
      return {rt * a.r, rt * ((a.p - b.p) + (a.motion.displacement - b.motion.displacement) * t)};
    }
    const Transform<double> ta = a.at(t), tb = b.at(t);
    const Mat3<double> rt = tb.r.transposed();
    return {rt * ta.r, rt * (ta.p - tb.p)};
  }

  // From a point of B to a point of A (each in its own frame), in the world, at time t.
  Vec3<double> between(const Vec3<double>& in_a, const Vec3<double>& in_b, double t) const {
    const Vec3<double> d = (a.p - b.p) + (a.motion.displacement - b.motion.displacement) * t;
    const Vec3<double> ra = a.r * in_a, rb = b.r * in_b;
    return d + (a.turns() ? turn(a.motion.axis, a.motion.angle * t) * ra : ra) -
           (b.turns() ? turn(b.motion.axis, b.motion.angle * t) * rb : rb);
  }

  // Bound on the relative speed (length per step) of points at these distances from the origins of their bodies, seen from
  // the frame of A or of B whichever turns; `apart` bounds the distance between the two origins over the step.
  double speed(double distance_a, double distance_b, double apart) const {
    const Vec3<double> v = a.motion.displacement - b.motion.displacement;
    return length(v) + (std::abs(a.motion.angle) + std::abs(b.motion.angle)) * (distance_a + distance_b + apart);
  }
};

}  // namespace ofg
