// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Two hulls in relative motion: where they are at a time of the step, and how far rounding may have
// moved them.
#pragma once
#include "verified_pose.hpp"

namespace ofg::verified {

// One hull that rotates about a pivot at a constant rate, in axes that do not rotate: those that B
// has at the start. Lengths in units of Moving. R(t) = still + cos(angle t) cosine + sin(angle t)
// sine.
struct Turning {
  Mat3<double> start, still, cosine, sine;
  Vec3<double> axis;  // of length 1
  double angle = 0;   // over the step
  Vec3<double> arm;   // from the pivot to the hull's centre, in the hull's axes
  double reach = 0;   // no vertex is farther from the pivot
  double swing = 0;   // nor from the line through it along the axis

  Turning() = default;

  // r: the hull's axes at the start. A hull that does not rotate has its pivot at its centre.
  Turning(const Hull& hull, const Mat3<double>& r, const Vec3<double>& axis_, double angle_,
          const Vec3<double>& about, double unit)
      : start(r), angle(angle_) {
    constexpr double up = 1 + 64 * unit_roundoff;
    if (angle == 0) {
      reach = swing = hull.radius * unit;
      return;
    }
    axis = axis_ * (1 / length(axis_));
    arm = (hull.centre - about) * unit;
    const double radius = hull.radius * unit;
    const Vec3<double> k = r.transposed() * axis;
    reach = (length(arm) + radius) * up;
    swing = std::fmin((length(cross(k, arm)) + radius) * up, reach);
    if (hull.size() <= most_looked_at) {
      double most = 0;
      for (int i = 0; i < hull.size(); ++i) {
        const Vec3<double> s = cross(k, hull.point(i) * unit + arm);
        most = std::fmax(most, dot(s, s));
      }
      swing = std::fmin(swing, std::sqrt(most) * up + 64 * unit_roundoff * reach);
    }
    for (int i = 0; i < 3; ++i) {
      const double ki = i == 0 ? axis.x : i == 1 ? axis.y : axis.z;
      still.row[i] = k * ki;
      cosine.row[i] = r.row[i] - still.row[i];
    }
    sine.row[0] = r.row[2] * axis.y - r.row[1] * axis.z;
    sine.row[1] = r.row[0] * axis.z - r.row[2] * axis.x;
    sine.row[2] = r.row[1] * axis.x - r.row[0] * axis.y;
  }

  bool turns() const { return angle != 0; }

  Mat3<double> at(double t) const {
    if (!turns()) return start;
    const double c = std::cos(angle * t), s = std::sin(angle * t);
    Mat3<double> r;
    for (int i = 0; i < 3; ++i) r.row[i] = still.row[i] + cosine.row[i] * c + sine.row[i] * s;
    return r;
  }

 private:
  static constexpr int most_looked_at = 64;
};

// Poses of both hulls at one time.
struct Instant {
  double t = 0;
  Mat3<double> a, b;     // from the hulls' axes
  Vec3<double> between;  // from B's centre to A's
};

// A's pivot seen from B's is at p + t d. How far what is computed may be from what is true, in
// units u = 2^-53 (verified_pose.hpp counts those of poses):
// - The matrix of a hull that turns: 70 u from the relative pose; 80 u from the axis, which is off
//   by 40 u (30 u from the matrix that turns it, 6 u from sums, 4 u from its length); 10 u from
//   products and sums, 2 u from sine and cosine, and |angle| u as the angle is off by 1 u of
//   itself.
// - A point: as much of its distance from the pivot, and 10 u from turning and adding it. The
// pivots
//   themselves: 75 u of those in the hulls' axes, 40 u of the way between the poses and of d.
// `slack` is 256 + 4 |angle| units of all these lengths: more than a point is off, and than the gap
// along an axis is that is known exactly. An axis that turns is off by 170 + |angle| u of itself,
// one normal to two edges by twice as much: there the gap is worth twice slack (Plane::margin).
struct Moving {
  const Hull &a, &b;
  const ExtremeLists *lists_a, *lists_b;
  Turning of_a, of_b;
  Vec3<double> p, d;
  double unit = 1, slack = 0, away = 0;
  bool sure = true;  // false where numbers left their range: nothing is known

  Moving(const Hull& a_, const Hull& b_, const Pose& pa, const Pose& pb, const Motion& ma,
         const Motion& mb)
      : a(a_), b(b_), lists_a(a.extreme_lists()), lists_b(b.extreme_lists()) {
    unit = unit_of(a.radius + b.radius);
    const Mat3<double> ra = rotation(pa.q), rb = rotation(pb.q), back = rb.transposed();
    const auto turning = [&](const Hull& hull, const Mat3<double>& r, const Motion& m) {
      const Vec3<double> axis = m.axis * unit_of(largest(m.axis));
      return Turning(hull, r, back * axis, m.angle, m.about, unit);
    };
    of_a = turning(a, back * ra, ma);
    of_b = turning(b, Mat3<double>(), mb);
    const auto pivot = [](const Hull& hull, const Motion& m) {
      return m.angle != 0 ? m.about : hull.centre;
    };
    const Vec3<double> pivot_a = pivot(a, ma), pivot_b = pivot(b, mb), way = pa.p - pb.p;
    p = (back * (ra * pivot_a + way) - pivot_b) * unit;
    d = back * (ma.displacement - mb.displacement) * unit;
    const double angle = std::abs(ma.angle) + std::abs(mb.angle);
    const double lengths = (length(pivot_a) + length(pivot_b) + length(way)) * unit + length(d) +
                           of_a.reach + of_b.reach + (length(a.centre) + length(b.centre)) * unit;
    slack = (256 + 4 * angle) * unit_roundoff * lengths;
    away = (a.off_centre + b.off_centre) * unit;
    sure = a.radius + b.radius > 1e-100 && lengths < 1e60 && slack < 1e-3;
  }

  Instant at(double t) const {
    Instant now{t, of_a.at(t), of_b.at(t), {}};
    now.between = pivots(t) + now.a * of_a.arm - now.b * of_b.arm;
    return now;
  }

  Vec3<double> pivots(double t) const { return p + d * t; }

  // For a portal at one time.
  Posed posed(const Instant& now) const {
    Posed at;
    const Mat3<double> back = now.b.transposed();
    at.r = back * now.a, at.between = back * now.between;
    at.unit = unit, at.slack = slack, at.away = away;
    return at;
  }
};

// A vertex of each hull, relative to its centre and in its axes.
struct Ends {
  Vec3<double> a, b;
};

// The vertex of A least along in_a and that of B farthest along in_b, in the hulls' axes.
inline Ends least_apart(const Hull& a, const ExtremeLists* lists_a, const Vec3<double>& in_a,
                        const Hull& b, const ExtremeLists* lists_b, const Vec3<double>& in_b) {
  const double axis_a[3] = {in_a.x, in_a.y, in_a.z}, axis_b[3] = {-in_b.x, -in_b.y, -in_b.z};
  const CloudView<double> of_a = lists_a ? lists_a->along(-in_a) : a.cloud.view(),
                          of_b = lists_b ? lists_b->along(in_b) : b.cloud.view();
  int at[2];
  kernels<double>.extremes(of_a, axis_a, of_b, axis_b, at);
  const auto [i, j] = at;
  return {{of_a.x[i], of_a.y[i], of_a.z[i]}, {of_b.x[j], of_b.y[j], of_b.z[j]}};
}

// A vertex of each hull, relative to its centre and in its axes, least apart along an axis n from B
// to A: where the gap along n is more than slack |n|, the hulls are apart.
struct Gap {
  Vec3<double> a, b;
  Vec3<double> w;    // from b to a
  double along = 0;  // n . w
};

inline Gap gap(const Moving& m, const Instant& now, const Vec3<double>& n) {
  // The rows of a matrix, each times a component: its transpose times n.
  const auto in = [&](const Mat3<double>& r) {
    return r.row[0] * n.x + r.row[1] * n.y + r.row[2] * n.z;
  };
  const Vec3<double> in_a = in(now.a), in_b = in(now.b);
  const Ends ends = least_apart(m.a, m.lists_a, in_a, m.b, m.lists_b, in_b);
  Gap g;
  g.a = ends.a, g.b = ends.b;
  g.w = (now.a * g.a - now.b * g.b) * m.unit + now.between;
  // By the products that chose the vertices: n . w would count the choice's rounding twice.
  g.along = (dot(in_a, g.a) - dot(in_b, g.b)) * m.unit + dot(n, now.between);
  return g;
}

}  // namespace ofg::verified
