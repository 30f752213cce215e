// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Certificates that two convex hulls meet or do not, found by the algorithm of Gilbert, Johnson and
// Keerthi (1988) in any arithmetic: a plane with all vertices on their sides, or a tetrahedron of
// differences of vertices with the origin inside. It shares nothing with verified.hpp.
#pragma once
#include "judge.hpp"

namespace judge {

template <class T>
constexpr T roundoff = T(0x1p-53);
template <>
constexpr long double roundoff<long double> = 0x1p-64L;
template <>
constexpr Quad roundoff<Quad> = Quad(0x1p-113);

// Of a simplex, the point nearest to the origin, and the corners of the smallest part that holds
// it. Ericson, Real-Time Collision Detection, 2005, section 5.1.
template <class T>
struct Simplex {
  Point<T> v[4];
  int n = 0;
  Point<T> nearest{};
  bool inside = false;

  void keep(std::initializer_list<int> some) {
    Point<T> kept[3];
    int m = 0;
    for (const int i : some) kept[m++] = v[i];
    std::copy_n(kept, m, v), n = m;
  }

  static Point<T> between(const Point<T>& p, const Point<T>& e, T t) {
    return {p.x + t * e.x, p.y + t * e.y, p.z + t * e.z};
  }

  void segment() {
    const Point<T> e = v[1] - v[0];
    const T t = -dot(v[0], e), all = dot(e, e);
    if (!(t > 0)) return nearest = v[0], keep({0});
    if (!(t < all)) return nearest = v[1], keep({1});
    nearest = between(v[0], e, t / all);
  }

  void triangle() {
    const Point<T> a = v[0], b = v[1], c = v[2], e = b - a, f = c - a;
    const T d1 = -dot(e, a), d2 = -dot(f, a), d3 = -dot(e, b), d4 = -dot(f, b), d5 = -dot(e, c),
            d6 = -dot(f, c);
    const T va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (d1 <= 0 && d2 <= 0) return nearest = a, keep({0});
    if (d3 >= 0 && d4 <= d3) return nearest = b, keep({1});
    if (d6 >= 0 && d5 <= d6) return nearest = c, keep({2});
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return nearest = between(a, e, d1 / (d1 - d3)), keep({0, 1});
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return nearest = between(a, f, d2 / (d2 - d6)), keep({0, 2});
    if (va <= 0 && d4 >= d3 && d5 >= d6)
      return nearest = between(b, c - b, (d4 - d3) / (d4 - d3 + d5 - d6)), keep({1, 2});
    const T sum = va + vb + vc;
    nearest = between(between(a, e, vb / sum), f, vc / sum);
  }

  void tetrahedron() {
    Simplex best;
    T least = 0;
    for (int i = 0; i < 4; ++i) {
      Simplex face;
      for (int j = 0; j < 4; ++j)
        if (j != i) face.v[face.n++] = v[j];
      const Point<T> m = cross(face.v[1] - face.v[0], face.v[2] - face.v[0]);
      const T here = -dot(m, face.v[0]), there = dot(m, v[i] - face.v[0]);
      if (here * there > 0) continue;  // the origin is on the fourth corner's side
      face.triangle();
      const T far = dot(face.nearest, face.nearest);
      if (best.n == 0 || far < least) best = face, least = far;
    }
    if (best.n == 0)
      inside = true;
    else
      *this = best;
  }

  // From a triangle along its normal: where the origin is near it, `nearest` is off by more than
  // its length.
  Point<T> towards() const {
    if (n == 3) {
      const Point<T> m = cross(v[1] - v[0], v[2] - v[0]);
      const T height = dot(m, v[0]);
      if (height > 0) return {-m.x, -m.y, -m.z};
      if (height < 0) return m;
    }
    return {-nearest.x, -nearest.y, -nearest.z};
  }

  void close_in() {
    if (n == 1)
      nearest = v[0];
    else if (n == 2)
      segment();
    else if (n == 3)
      triangle();
    else
      tetrahedron();
  }
};

// Is the origin in the tetrahedron, farther than `off` from every face, however the corners' own
// rounding and that of what is computed here fall?
template <class T>
bool holds_origin(const Point<T> (&v)[4], T off) {
  static constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  for (const auto& f : faces) {
    const Point<T> p = v[f[0]], e = v[f[1]] - p, g = v[f[2]] - p, m = cross(e, g);
    const T here = -dot(m, p), there = dot(m, v[f[3]] - p);
    const T doubt = 2 * off * size_of(m) + 64 * roundoff<T> * size_of(e) * size_of(g) *
                                               (size_of(p) + size_of(v[f[3]]) + off);
    const bool above = here > doubt && there > doubt, below = here < -doubt && there < -doubt;
    if (!above && !below) return false;
  }
  return true;
}

template <class T>
Point<T> farthest(const Points<T>& all, const Point<T>& d) {
  std::size_t best = 0;
  T most = dot(all[0], d);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const T t = dot(all[i], d);
    if (t > most) most = t, best = i;
  }
  return all[best];
}

// A certificate, or `near` where none is found. A point of A - B is off by less than 2^6 units of
// rounding of what it is the sum of; 2^8 are allowed for.
template <class T>
Says by_certificate(const Posed<T>& at) {
  const T off = 256 * roundoff<T> * at.lengths;
  static constexpr int starts[][3] = {{0, 0, 0}, {3, -2, 1}, {-1, 3, 2}};
  for (const auto& start : starts) {
    Point<T> d = at.b[0] - at.a[0];
    if (start[0] != 0) d = {T(start[0]), T(start[1]), T(start[2])};
    Simplex<T> s;
    for (int step = 0; step < 60; ++step) {
      const Point<T> m = farthest(at.a, d) - farthest(at.b, {-d.x, -d.y, -d.z});
      if (dot(m, d) < -off * size_of(d)) return Says::clear;
      if (s.n > 0 && !(dot(m - s.nearest, d) > off / 16 * size_of(d))) break;
      s.v[s.n++] = m;
      s.close_in();
      if (s.inside) break;
      d = s.towards();
    }
    if (s.inside && holds_origin(s.v, off)) return Says::hit;
    if (!s.inside && size_of(s.nearest) < 8 * off) break;  // wherever it starts
  }
  return Says::near;
}

}  // namespace judge
