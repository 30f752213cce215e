// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// An axis along which two hulls are apart at one time (Gilbert, Johnson and Keerthi 1988), and the
// features that are nearest.
#pragma once
#include "answer.hpp"
#include "verified_motion.hpp"

namespace ofg::verified {

// Up to four differences of a vertex of A and one of B: those that span the point nearest to the
// origin. Ericson, Real-Time Collision Detection, 2005, sections 5.1.2, 5.1.5, 5.1.6.
struct Simplex {
  Gap p[4];
  int n = 0;

  void push(const Gap& g) { p[n++] = g; }

  // If it is not there yet, and there is room.
  void add(const Gap& g) {
    for (int i = 0; i < n; ++i)
      if (g.a == p[i].a && g.b == p[i].b) return;
    if (n < 4) push(g);
  }

  // Leaves only what spans it. The origin for a tetrahedron that holds it.
  Vec3<double> nearest() {
    unsigned kept = 1;
    const Vec3<double> v = n == 1   ? p[0].w
                           : n == 2 ? on_segment(0, 1, kept)
                           : n == 3 ? on_triangle(0, 1, 2, kept)
                                    : on_tetrahedron(kept);
    const int all = n;
    n = 0;
    for (int i = 0; i < all; ++i)
      if (kept >> i & 1) {
        if (i != n) p[n] = p[i];
        ++n;
      }
    return v;
  }

  // Different vertices of one body: 1 to 4.
  template <class Of>
  int kinds(Of of) const {
    int count = 0;
    for (int i = 0; i < n; ++i) {
      bool seen = false;
      for (int j = 0; j < i; ++j) seen |= of(p[i]) == of(p[j]);
      count += !seen;
    }
    return count;
  }

 private:
  // Each says in `kept` which corners span the point, as bits.
  Vec3<double> on_segment(int i, int j, unsigned& kept) const {
    const Vec3<double>&a = p[i].w, d = p[j].w - a;
    const double at = -dot(a, d), all = dot(d, d);
    kept = at > 0 ? at < all ? 1u << i | 1u << j : 1u << j : 1u << i;
    return at > 0 ? at < all ? a + d * (at / all) : p[j].w : a;
  }

  Vec3<double> on_triangle(int i, int j, int k, unsigned& kept) const {
    const Vec3<double>&a = p[i].w, &b = p[j].w, &c = p[k].w, ab = b - a, ac = c - a;
    const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b),
                 d5 = -dot(ab, c), d6 = -dot(ac, c);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc > 0 && vb > 0 && va > 0) {
      // The foot of the perpendicular: more exact than the weighted corners where it is near.
      const Vec3<double> m = cross(ab, ac);
      const double square = dot(m, m);
      kept = 1u << i | 1u << j | 1u << k;
      if (square > 1e-24 * dot(ab, ab) * dot(ac, ac)) return m * (dot(m, a) / square);
    } else {
      if (d1 <= 0 && d2 <= 0) return kept = 1u << i, a;
      if (d3 >= 0 && d4 <= d3) return kept = 1u << j, b;
      if (d6 >= 0 && d5 <= d6) return kept = 1u << k, c;
      if (vc <= 0 && d1 > 0 && d3 < 0) return on_segment(i, j, kept);
      if (vb <= 0 && d2 > 0 && d6 < 0) return on_segment(i, k, kept);
      if (va <= 0 && d4 - d3 > 0 && d5 - d6 > 0) return on_segment(j, k, kept);
    }
    // In line: whichever side comes nearest.
    const int side[3][2] = {{i, j}, {j, k}, {k, i}};
    Vec3<double> least;
    for (const auto& s : side) {
      unsigned here = 0;
      const Vec3<double> v = on_segment(s[0], s[1], here);
      if (&s == side || dot(v, v) < dot(least, least)) least = v, kept = here;
    }
    return least;
  }

  Vec3<double> on_tetrahedron(unsigned& kept) const {
    static constexpr int side[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    Vec3<double> best;
    double least = std::numeric_limits<double>::infinity();
    kept = 15;
    for (const auto& s : side) {
      const Vec3<double>&o = p[s[0]].w, m = cross(p[s[1]].w - o, p[s[2]].w - o);
      const double origin = -dot(m, o), fourth = dot(m, p[s[3]].w - o);
      if ((origin > 0 && fourth > 0) || (origin < 0 && fourth < 0)) continue;
      unsigned here = 0;
      const Vec3<double> v = on_triangle(s[0], s[1], s[2], here);
      if (dot(v, v) < least) least = dot(v, v), best = v, kept = here;
    }
    return best;
  }
};

// The gap along `axis`, of length 1, at one time, and what spans the distance there.
struct Apart {
  bool found = false;
  Vec3<double> axis;
  Gap gap;
};

constexpr int most_axes = 64;

// An axis along which the hulls are apart by more than `least`, and by `share` of their distance or
// more. axis: the first tried. simplex: kept from call to call, as the nearest features seldom
// change.
inline Apart apart_at(const Moving& m, const Instant& now, Vec3<double> axis, double least,
                      double share, Simplex& simplex, Counts& counts) {
  Apart best;
  best.gap.along = least;
  for (int i = 0; i < simplex.n; ++i) {
    Gap& g = simplex.p[i];
    g.w = (now.a * g.a - now.b * g.b) * m.unit + now.between;
  }
  Vec3<double> v = axis;
  if (simplex.n > 0) {
    v = simplex.nearest();
    if (simplex.n == 4) simplex.n = 0, v = axis;
  }
  if (simplex.n == 0 && !(length(v) > 1e-100)) v = now.between;
  if (simplex.n == 0 && !(length(v) > 1e-100)) v = {1, 0, 0};
  for (int step = 0; step < most_axes; ++step) {
    const double size = length(v);
    if (!(size > 1e-100)) return best;
    const Vec3<double> n = v * (1 / size);
    const Gap g = gap(m, now, n);
    counts.distances += m.a.size() + m.b.size(), ++counts.full_tests;
    if (g.along > best.gap.along) best = {true, n, g};
    // `size` bounds the distance from above once v is of the simplex.
    const bool of_simplex = simplex.n > 0;
    if (of_simplex && best.found && best.gap.along >= share * size) return best;
    if (of_simplex && size <= least) return best;
    for (int i = 0; i < simplex.n; ++i)
      if (g.a == simplex.p[i].a && g.b == simplex.p[i].b) return best;
    simplex.push(g);
    v = simplex.nearest();
    if (simplex.n == 4) return best;  // the origin is inside, as far as doubles can tell
  }
  return best;
}

}  // namespace ofg::verified
