// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Two closed surfaces at one pair of poses: which faces cross, and which vertices lie inside.
#pragma once
#include "verified_surface.hpp"

namespace ofg::verified::detail {

// The end of a ray along x from a point of the target's axes: beyond its bounding ball.
inline Vec3<double> beyond(const Surface& target, const Vec3<double>& from) {
  return target.centre + from + Vec3<double>(4 * target.radius, 0, 0);
}

class Crossing {
 public:
  Crossing(const Surface& a, const Surface& b, const Between& at, Sides& sides)
      : a_(a), b_(b), at_(at), sides_(sides) {}

  // Do these faces cross? B gives way where they only touch.
  bool faces(int i, int j) {
    // built where they stand: copies of what was just written in parts make the processor wait
    const Point p[3] = {vertex_of_a(a_.index(i, 0)), vertex_of_a(a_.index(i, 1)),
                        vertex_of_a(a_.index(i, 2))};
    const Point q[3] = {vertex_of_b(b_.index(j, 0)), vertex_of_b(b_.index(j, 1)),
                        vertex_of_b(b_.index(j, 2))};
    int above_b[3], above_a[3];
    if (!straddles(q, p, above_b) || !straddles(p, q, above_a)) return false;
    // Each plane cuts the other face in a segment, both on one line; two signs say whether these
    // overlap (Guigue and Devillers 2003). a, b: the vertices alone
    // on their sides.
    const int m = alone(above_b), n = alone(above_a);
    const bool turn_a = above_a[n] < 0, turn_b = above_b[m] < 0;
    const Point &a = p[m], &a1 = p[(m + (turn_a ? 2 : 1)) % 3], &a2 = p[(m + (turn_a ? 1 : 2)) % 3],
                &b = q[n], &b1 = q[(n + (turn_b ? 2 : 1)) % 3], &b2 = q[(n + (turn_b ? 1 : 2)) % 3];
    return sides_(a, a1, b, b1) < 0 && sides_(a, a2, b2, b) < 0;
  }

  // Where no faces cross, a part of a surface is inside the other solid where any of its vertices
  // is.
  bool contained(std::int64_t& pairs) {
    for (const int v : a_.shells)
      if (winding(vertex_of_a(std::size_t(v)), b_, true, pairs) != 0) return true;
    for (const int v : b_.shells)
      if (winding(vertex_of_b(std::size_t(v)), a_, false, pairs) != 0) return true;
    return false;
  }

  // How often a surface winds about a point, which is of the other body and not on the surface.
  int winding(const Point& from, const Surface& target, bool is_b, std::int64_t& pairs) {
    const Vec3<double> local = is_b ? from.at : at_.r.transposed() * (from.at - at_.between);
    if (at_.sure && length(local) > target.radius + at_.slack) return 0;
    const Vec3<double> end = beyond(target, local), far = end - target.centre;
    Point to;
    to.at = is_b ? far : at_.r * far + at_.between;
    to.given = &end, to.in_b = is_b, to.moves = from.moves;
    int sum = 0;
    const auto face = [&](int i) {
      Point q[3];
      for (int k = 0; k < 3; ++k)
        q[k] = is_b ? vertex_of_b(target.index(i, k)) : vertex_of_a(target.index(i, k));
      const int side = sides_(q[0], q[1], q[2], from);
      if (side != sides_(q[0], q[1], q[2], to) && sides_.passes(from, to, q)) sum += side;
    };
    if (!at_.sure) {
      for (const int i : target.broad) face(i);
      return sum;
    }
    meet_ray(target.tree, local * (1 / target.radius), 2 * at_.slack / target.radius, pairs, face);
    return sum;
  }

 private:
  Point vertex_of_a(std::size_t v) const {
    return {at_.r * a_.cloud[v] + at_.between, &a_.vertices[v], 1, false, false, true};
  }
  Point vertex_of_b(std::size_t v) const {
    return {b_.cloud[v], &b_.vertices[v], 1, true, true, true};
  }

  static int alone(const int (&side)[3]) {
    return side[0] == side[1] ? 2 : side[0] == side[2] ? 1 : 0;
  }

  bool straddles(const Point (&plane)[3], const Point (&p)[3], int (&side)[3]) {
    sides_.of_plane(plane, p, side);
    return side[0] != side[1] || side[1] != side[2];
  }

  const Surface &a_, &b_;
  const Between& at_;
  Sides& sides_;
};

}  // namespace ofg::verified::detail
