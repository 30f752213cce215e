// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Searches for a separating plane between two sets of points. A plane found is a proof; none found
// proves nothing.
#pragma once
#include "simd/kernels.hpp"

namespace ofg {

// Points in structure-of-arrays, padded with copies of the first to whole registers.
template <class T>
struct Cloud {
  std::vector<T> x, y, z;
  int size = 0;

  void push(const Vec3<T>& p) { x.push_back(p.x), y.push_back(p.y), z.push_back(p.z); }
  void pad() {
    while (x.size() % lanes<T>) push({x[0], y[0], z[0]});
    size = int(x.size());
  }
  CloudView<T> view() const { return {x.data(), y.data(), z.data(), size}; }
};

// The point of (a - b) least along an axis.
template <class T>
inline Vec3<T> support(const CloudView<T>& a, const CloudView<T>& b, const Vec3<T>& axis) {
  const T v[3] = {axis.x, axis.y, axis.z};
  T w[3];
  kernels<T>.support(a, b, v, w);
  return {w[0], w[1], w[2]};
}

namespace detail {

// The point nearest to the origin of a simplex of up to four points, and the points that span it,
// kept in place. Ericson, Real-Time Collision Detection, 2005, sections 5.1.2, 5.1.5, 5.1.6.
// Returns the origin for a tetrahedron that contains it.
template <class T>
struct Simplex {
  Vec3<T> p[4];
  int n = 0;

  Vec3<T> nearest() {
    if (n == 1) return p[0];
    if (n == 2) return on_segment();
    if (n == 3) return on_triangle();
    return on_tetrahedron();
  }

 private:
  Vec3<T> on_segment() {
    const Vec3<T> d = p[1] - p[0];
    const T at = -dot(p[0], d), all = dot(d, d);
    if (!(at > 0)) return n = 1, p[0];
    if (at >= all) return p[0] = p[1], n = 1, p[0];
    return p[0] + d * (at / all);
  }

  Vec3<T> on_triangle() {
    const Vec3<T> a = p[0], b = p[1], c = p[2], ab = b - a, ac = c - a;
    const T d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b),
            d5 = -dot(ab, c), d6 = -dot(ac, c);
    if (d1 <= 0 && d2 <= 0) return n = 1, a;
    if (d3 >= 0 && d4 <= d3) return p[0] = b, n = 1, b;
    const T vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return n = 2, a + ab * (d1 / (d1 - d3));
    if (d6 >= 0 && d5 <= d6) return p[0] = c, n = 1, c;
    const T vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return p[1] = c, n = 2, a + ac * (d2 / (d2 - d6));
    const T va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
      return p[0] = b, p[1] = c, n = 2, b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const T sum = va + vb + vc;
    return sum > 0 ? a + ab * (vb / sum) + ac * (vc / sum) : (n = 1, a);
  }

  Vec3<T> on_tetrahedron() {
    static constexpr int side[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    const Simplex whole = *this;
    Vec3<T> best;
    T least = std::numeric_limits<T>::infinity();
    for (const auto& s : side) {
      const Vec3<T> m = cross(whole.p[s[1]] - whole.p[s[0]], whole.p[s[2]] - whole.p[s[0]]);
      const T origin = -dot(m, whole.p[s[0]]), fourth = dot(m, whole.p[s[3]] - whole.p[s[0]]);
      if ((origin > 0 && fourth > 0) || (origin < 0 && fourth < 0)) continue;
      Simplex f;
      f.n = 3, f.p[0] = whole.p[s[0]], f.p[1] = whole.p[s[1]], f.p[2] = whole.p[s[2]];
      const Vec3<T> v = f.nearest();
      if (dot(v, v) < least) least = dot(v, v), best = v, *this = f;
    }
    return best;
  }
};

}  // namespace detail

// Searches for a plane that keeps two sets apart by more than `gap`; `axis` is the first axis tried
// and the last found, from the second set to the first (Gilbert, Johnson, Keerthi 1988).
// `least_of(axis)` returns the point of (first - second) least along an axis.
template <class T, class Least>
bool separated(Vec3<T>& axis, T gap, Least least_of, int iterations = 12) {
  detail::Simplex<T> s;
  for (int i = 0; i < iterations; ++i) {
    const T size = length(axis);
    if (!(size > 0)) return false;
    const Vec3<T> v = axis * (T(1) / size), w = least_of(v);
    const T apart = dot(v, w);
    if (apart > gap) return true;
    // Nearer than this the search has converged: the rest is at most the gap.
    if (i > 1 && apart > 0 && size - apart <= T(1e-3) * size && size <= gap) return false;
    s.p[s.n++] = w;
    axis = s.nearest();
    if (s.n == 4) return false;
  }
  return false;
}

}  // namespace ofg
