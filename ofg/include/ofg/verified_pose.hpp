// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Two hulls at one pair of poses, in B's axes, and how far rounding may have moved them.
#pragma once
#include "motion.hpp"
#include "verified_hull.hpp"

namespace ofg::verified {

// How far apart the origins of two hulls' frames are: what is known before any rotation. Without
// units.
struct Frames {
  Vec3<double> shift;  // from B's origin to A's, in the world
  double far;          // its length
  double slack;        // as Posed has it, which derives it
  bool sure;           // likewise

  Frames(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb) : shift(pa.p - pb.p) {
    far = length(shift);
    const double sum = a.radius + b.radius, lengths = sum + a.way + b.way + far;
    slack = 256 * unit_roundoff * lengths;
    sure = sum > 1e-100 && lengths < 1e100;
  }
};

// And where the centres are in the world.
struct Centres : Frames {
  Mat3<double> turn_a, turn_b;  // from the bodies' axes to the world's
  Vec3<double> between;         // from B's centre to A's

  Centres(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb, const Frames& frames)
      : Frames(frames), turn_a(rotation(pa.q)), turn_b(rotation(pb.q)) {
    between = turn_a * a.centre + shift - turn_b * b.centre;
  }
};

// Everything below is about M = A - B, the differences of a point of A and one of B: the interiors
// meet where the origin is interior to M. Lengths are in units of a power of two near the sum of
// the radii, so that no product of a few of them leaves the range of doubles.
//
// How far a computed point of M may be from the true one, in units u = 2^-53:
// - A rotation N(q)/|q|^2. |q|^2 is off by 4 u of itself. On the diagonal, four squares summed are
//   off by 4 u |q|^2: with the division 9 u. Off it, 2 (xy - wz) is off by 2 u |q|^2: 7 u. No entry
//   by more than 10 u, so the matrix by 30 u (its Frobenius norm).
// - r = Rb^T Ra: 60 u from the two, and sums of three products of rows of length 1: 3 u an entry,
//   9 u the matrix. Together 70 u.
// - r x for a vertex x relative to A's centre: 70 u |x|, three products summed 6 u |x|, x itself
//   rounded once, u |x|: 80 u r_A.
// - between in the world = Ra c_A + d - Rb c_B, d = p_A - p_B: u |d| from the difference, 36 u |c|
//   from each matrix and its sums, and two sums more, 2 u (|c_A| + |d| + |c_B|).
// - between = Rb^T of that: 30 u from the matrix and 6 u from the sums, of |c_A| + |d| + |c_B| and
//   a little: altogether 76 u (|c_A| + |c_B|) + 40 u |d|.
// - a point r x - y + between: besides those u r_B of y, and two sums, 2 u (r_A + r_B + |between|).
// Altogether less than 84 u (r_A + r_B + |c_A| + |c_B| + |d|). The support of M along an axis n is
// computed as (r^T n) . x - n . y + n . between: r^T n is off by 76 u |n|, three products summed by
// 4 u each, the three terms by 2 u; the same lengths again, less than 100 u of them times |n|.
// `slack` is 256 u of the same lengths: more than either, with room for |n| rounded.
struct Posed {
  Mat3<double> r;        // from A's axes to B's
  Vec3<double> between;  // from B's centre to A's
  double unit = 1;
  double slack = 0;  // as above, in these units
  double away = 0;   // distance of `between`, as it is, from a point of M, besides
  bool sure = true;  // false where numbers left their range: nothing is known

  Posed() = default;

  Posed(const Hull& a, const Hull& b, const Centres& at) {
    unit = unit_of(a.radius + b.radius);
    const Mat3<double> back = at.turn_b.transposed();
    r = back * at.turn_a;
    between = back * at.between * unit;
    slack = at.slack * unit;
    away = (a.off_centre + b.off_centre) * unit;
    sure = at.sure && slack < 1e100;
  }

  Posed(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb)
      : Posed(a, b, Centres(a, b, pa, pb, Frames(a, b, pa, pb))) {}
};

namespace detail {

// The quaternion in units of its largest component, which changes no rotation.
inline void in_range(const double (&q)[4], double (&to)[4]) {
  const double unit = unit_of(std::fmax(std::abs(q[0]), largest(Vec3<double>(q[1], q[2], q[3]))));
  for (int i = 0; i < 4; ++i) to[i] = q[i] * unit;
}

}  // namespace detail

// The points of A and of B, relative to the centres and in their axes, whose difference is farthest
// along an axis n of B's axes.
struct Support {
  Vec3<double> a, b, point;  // point: of M
  double height;             // the support function along n, within slack |n|
};

inline Support support(const Hull& a, const Hull& b, const Posed& at, const Vec3<double>& n) {
  static constexpr double zero[lanes<double>] = {};
  static constexpr CloudView<double> origin{zero, zero, zero, lanes<double>};
  const Vec3<double> turned = at.r.transposed() * n;
  Support s;
  s.a = ofg::support(a.cloud.view(), origin, -turned);
  s.b = ofg::support(b.cloud.view(), origin, n);
  s.point = (at.r * s.a - s.b) * at.unit + at.between;
  s.height = (dot(turned, s.a) - dot(n, s.b)) * at.unit + dot(n, at.between);
  return s;
}

// Is the plane at right angles to n with M on one side proved to keep the origin on the other?
inline bool clear_along(const Support& s, const Vec3<double>& n, const Posed& at) {
  return s.height < -at.slack * length(n);
}

// Does a tetrahedron with corners in M hold the origin, farther than `margin` from each face? If
// every true corner is within the margin of the computed one, the true tetrahedron holds the origin
// too: along any unit axis its support is at least the margin of the computed one less than the
// margin. With edges e, f of a face and p a corner, all in doubles: the cross product n is off by
// 8 u |e| |f| (differences 2 u, products and their difference 2 u, per component |e| |f|), and its
// product with p by 12 u |e| |f| |p|. So n . p is worth margin |n| if it exceeds that by
// 16 u |e| |f| (|p| + margin).
inline bool holds_origin(const Vec3<double> (&v)[4], double margin) {
  static constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  int outward = 0;  // how the four are wound: the same of all, or the origin is outside
  for (const auto& c : face) {
    const Vec3<double> p = v[c[0]], e = v[c[1]] - p, f = v[c[2]] - p, n = cross(e, f);
    const double size = length(p), height = dot(n, p), wide = length(e) * length(f);
    if (!(std::abs(height) > margin * length(n) + 16 * unit_roundoff * wide * (size + margin)))
      return false;
    const int side = height > 0 ? 1 : -1;
    if (outward != 0 && side != outward) return false;
    outward = side;
  }
  return true;
}

}  // namespace ofg::verified
