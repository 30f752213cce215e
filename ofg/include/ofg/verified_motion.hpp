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

// A's pivot seen from B's is at p + t d. Besides what Posed counts (84 units of the lengths), the
// matrices of a rotation are off by 30 units from the pose and 20 from the axis and the products,
// the angle by 1 unit of itself, its sine and cosine by 2 units, their products and sums by 6: a
// point by (60 + |angle|) units of its distance from the pivot, the pivots by 40 units of p and d.
// `slack` is 256 + 4 |angle| units of all these lengths.
struct Moving {
  const Hull &a, &b;
  Turning of_a, of_b;
  Vec3<double> p, d;
  double unit = 1, slack = 0, away = 0;
  bool sure = true;  // false where numbers left their range: nothing is known

  Moving(const Hull& a_, const Hull& b_, const Pose& pa, const Pose& pb, const Motion& ma,
         const Motion& mb)
      : a(a_), b(b_) {
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

// A vertex of each hull, relative to its centre and in its axes, least apart along an axis n from B
// to A: where the gap along n is more than slack |n|, the hulls are apart.
struct Gap {
  Vec3<double> a, b;
  Vec3<double> w;    // from b to a
  double along = 0;  // n . w
};

inline Gap gap(const Moving& m, const Instant& now, const Vec3<double>& n) {
  static constexpr double zero[lanes<double>] = {};
  static constexpr CloudView<double> origin{zero, zero, zero, lanes<double>};
  const Vec3<double> in_a = now.a.transposed() * n, in_b = now.b.transposed() * n;
  Gap g;
  g.a = ofg::support(m.a.cloud.view(), origin, in_a);
  g.b = ofg::support(m.b.cloud.view(), origin, -in_b);
  g.w = (now.a * g.a - now.b * g.b) * m.unit + now.between;
  g.along = (dot(in_a, g.a) - dot(in_b, g.b)) * m.unit + dot(n, now.between);
  return g;
}

}  // namespace ofg::verified
