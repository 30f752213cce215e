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

  // Leaves only what spans it. The origin for a tetrahedron that holds it.
  Vec3<double> nearest() {
    if (n == 1) return p[0].w;
    if (n == 2) return on_segment();
    if (n == 3) return on_triangle();
    return on_tetrahedron();
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
  Vec3<double> on_segment() {
    const Vec3<double> d = p[1].w - p[0].w;
    const double at = -dot(p[0].w, d), all = dot(d, d);
    if (!(at > 0)) return n = 1, p[0].w;
    if (at >= all) return p[0] = p[1], n = 1, p[0].w;
    return p[0].w + d * (at / all);
  }

  Vec3<double> on_triangle() {
    const Vec3<double> a = p[0].w, b = p[1].w, c = p[2].w, ab = b - a, ac = c - a;
    const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b),
                 d5 = -dot(ab, c), d6 = -dot(ac, c);
    if (d1 <= 0 && d2 <= 0) return n = 1, a;
    if (d3 >= 0 && d4 <= d3) return p[0] = p[1], n = 1, b;
    if (d6 >= 0 && d5 <= d6) return p[0] = p[2], n = 1, c;
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return n = 2, a + ab * (d1 / (d1 - d3));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return p[1] = p[2], n = 2, a + ac * (d2 / (d2 - d6));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
      return p[0] = p[2], n = 2, b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    // The foot of the perpendicular: more exact than the weighted corners where it is near.
    const Vec3<double> m = cross(ab, ac);
    const double square = dot(m, m);
    if (square > 1e-24 * dot(ab, ab) * dot(ac, ac)) return m * (dot(m, a) / square);
    // In line: whichever side comes nearest.
    Simplex best;
    Vec3<double> least;
    for (int i = 0; i < 3; ++i) {
      Simplex side;
      side.push(p[i]), side.push(p[(i + 1) % 3]);
      const Vec3<double> v = side.on_segment();
      if (i == 0 || dot(v, v) < dot(least, least)) least = v, best = side;
    }
    return *this = best, least;
  }

  Vec3<double> on_tetrahedron() {
    static constexpr int side[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    const Simplex whole = *this;
    Vec3<double> best;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& s : side) {
      const Vec3<double> o = whole.p[s[0]].w, m = cross(whole.p[s[1]].w - o, whole.p[s[2]].w - o);
      const double origin = -dot(m, o), fourth = dot(m, whole.p[s[3]].w - o);
      if ((origin > 0 && fourth > 0) || (origin < 0 && fourth < 0)) continue;
      Simplex f;
      f.push(whole.p[s[0]]), f.push(whole.p[s[1]]), f.push(whole.p[s[2]]);
      const Vec3<double> v = f.on_triangle();
      if (dot(v, v) < least) least = dot(v, v), best = v, *this = f;
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
