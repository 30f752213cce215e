// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Distance and overlap of two convex point sets by their support functions (Gilbert, Johnson,
// Keerthi 1988).
#pragma once
#include <array>
#include <limits>
#include <vector>

#include "dd.hpp"

namespace truth {

template <class T>
constexpr double resolution() {
  return std::is_same_v<T, double> ? 2.3e-16 : 1e-30;
}

template <class T>
using Points = std::vector<vec<T>>;

template <class T>
int support(const Points<T>& p, vec<T> n) {
  int best = 0;
  T top = dot(p[0], n);
  for (int i = 1, m = int(p.size()); i < m; ++i) {
    T s = dot(p[i], n);
    if (s > top) top = s, best = i;
  }
  return best;
}

// status: Apart with the vector v from A to B between the closest points; Meet with the tetrahedron
// of B - A that holds the origin.
enum class Status { Apart, Meet, Unknown };
template <class T>
struct Corner {
  vec<T> c;
  int a, b;
};
template <class T>
struct Gjk {
  Status status = Status::Unknown;
  vec<T> v;
  int n = 0;
  std::array<Corner<T>, 4> s;
  std::array<T, 4> w;  // barycentric weights of v, or of the origin
};

namespace detail {
// Each reduces `g` to the least sub-simplex that holds the point closest to the origin and sets v
// and w.
template <class T>
void point1(Gjk<T>& g) {
  g.n = 1;
  g.v = g.s[0].c;
  g.w[0] = T(1);
}
template <class T>
void point2(Gjk<T>& g) {
  auto a = g.s[0].c, ab = g.s[1].c - a;
  T t = -dot(a, ab), l = dot(ab, ab);
  if (!(t > T(0)) || !(l > T(0))) return point1(g);
  if (t >= l) {
    g.s[0] = g.s[1];
    return point1(g);
  }
  t = t / l;
  g.n = 2;
  g.v = a + ab * t;
  g.w[0] = T(1) - t;
  g.w[1] = t;
}
template <class T>
void best_edge(Gjk<T>& g) {
  Gjk<T> best;
  T least(0);
  bool any = false;
  for (int i = 0; i < 3; ++i) {
    Gjk<T> e = g;
    e.s[0] = g.s[i];
    e.s[1] = g.s[(i + 1) % 3];
    point2(e);
    T d = dot(e.v, e.v);
    if (!any || d < least) best = e, least = d, any = true;
  }
  g = best;
}
template <class T>
void point3(Gjk<T>& g) {
  auto a = g.s[0].c, b = g.s[1].c, c = g.s[2].c;
  auto n = cross(b - a, c - a);
  T nn = dot(n, n);
  T u = dot(n, cross(b, c)), v = dot(n, cross(c, a)), w = dot(n, cross(a, b));
  if (!(nn > T(0)) || !(u > T(0)) || !(v > T(0)) || !(w > T(0))) return best_edge(g);
  T sum = u + v + w;
  g.n = 3;
  g.w[0] = u / sum;
  g.w[1] = v / sum;
  g.w[2] = w / sum;
  g.v = n * (dot(n, a) / nn);
}
template <class T>
bool point4(Gjk<T>& g) {  // true: the origin is strictly inside
  auto p = g.s;
  Gjk<T> best;
  T least(0);
  bool any = false, inside = true;
  std::array<T, 4> vol;
  for (int i = 0; i < 4; ++i) {
    auto &a = p[(i + 1) % 4].c, &b = p[(i + 2) % 4].c, &c = p[(i + 3) % 4].c;
    auto n = cross(b - a, c - a);
    T o = -dot(n, a), q = dot(n, p[i].c - a);
    vol[i] = q == T(0) ? T(-1) : o / q;
    if (vol[i] > T(0)) continue;
    inside = false;
    Gjk<T> f = g;
    f.s[0] = p[(i + 1) % 4];
    f.s[1] = p[(i + 2) % 4];
    f.s[2] = p[(i + 3) % 4];
    point3(f);
    T d = dot(f.v, f.v);
    if (!any || d < least) best = f, least = d, any = true;
  }
  if (inside) {
    g.n = 4;
    g.w = vol;
    return true;
  }
  g = best;
  return false;
}
}  // namespace detail

// tolerance: relative width at which the distance counts as converged. size: length scale, for
// "zero".
template <class T>
Gjk<T> gjk(const Points<T>& A, const Points<T>& B, vec<T> guess, double size, double tolerance) {
  Gjk<T> g;
  const T zero = T(16 * resolution<T>() * size) * T(16 * resolution<T>() * size);
  vec<T> v = guess;
  T last = T(std::numeric_limits<double>::max());
  int stalled = 0;
  for (int round = 0; round < 200; ++round) {
    int ia = support(A, v), ib = support(B, -v);
    Corner<T> w{B[ib] - A[ia], ia, ib};
    if (g.n) {
      T vv = dot(v, v);
      if (vv - dot(v, w.c) <= T(tolerance) * vv) {
        g.status = Status::Apart;
        return g;
      }
      for (int i = 0; i < g.n; ++i)
        if (g.s[i].a == ia && g.s[i].b == ib) {
          g.status = dot(v, w.c) > T(0) ? Status::Apart : Status::Unknown;
          return g;
        }
    }
    g.s[g.n++] = w;
    if (g.n == 4) {
      if (detail::point4(g)) {
        g.status = Status::Meet;
        return g;
      }
    } else if (g.n == 3)
      detail::point3(g);
    else if (g.n == 2)
      detail::point2(g);
    else
      detail::point1(g);
    v = g.v;
    T vv = dot(v, v);
    if (!(vv > zero)) {
      g.status = Status::Unknown;
      return g;
    }
    if (vv >= last && ++stalled > 4) {
      g.status = Status::Unknown;
      return g;
    }
    last = vv;
  }
  return g;
}

}  // namespace truth
