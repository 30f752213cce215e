// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Tests between triangles, segments and points.
// Touching counts as meeting. Every test takes `scale`, a bound on the absolute value of the
// coordinates, and settles nothing by less than a few units of rounding of it: faces closer than
// that touch. There is no absolute tolerance, so scaling by a power of two changes no answer.
// Degenerate triangles are treated as segments or points.
#pragma once
#include <limits>

#include "vector.hpp"

namespace ofg {

template <class T>
struct Triangle {
  Vec3<T> a, b, c;
  Vec3<T> normal() const { return cross(b - a, c - a); }
};

template <class T>
Triangle<T> in_units(const Triangle<T>& t, T unit) {
  return {t.a * unit, t.b * unit, t.c * unit};
}

template <class T>
constexpr T rounding = 8 * std::numeric_limits<T>::epsilon();

namespace detail {

template <class T>
struct Interval {
  T lo, hi;
  Interval(T a, T b, T c)
      : lo(a < b ? (a < c ? a : c) : (b < c ? b : c)),
        hi(a > b ? (a > c ? a : c) : (b > c ? b : c)) {}
};

template <class T>
inline bool apart_along(const Vec3<T>& axis, const Triangle<T>& s, const Triangle<T>& t, T slack) {
  const Interval<T> i(dot(axis, s.a), dot(axis, s.b), dot(axis, s.c)),
      j(dot(axis, t.a), dot(axis, t.b), dot(axis, t.c));
  const T least = slack * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
  return j.lo - i.hi > least || i.lo - j.hi > least;
}

// So thin that its computed normal is mostly rounding. The threshold decides only whether more axes
// are tried, never an answer.
template <class T>
inline bool sliver(const Triangle<T>& t) {
  const Vec3<T> e = t.b - t.a, f = t.c - t.b, g = t.a - t.c, n = t.normal();
  const T longest = std::fmax(dot(e, e), std::fmax(dot(f, f), dot(g, g)));
  return !(dot(n, n) > std::sqrt(std::numeric_limits<T>::epsilon()) * longest * longest);
}

// Two coplanar triangles that degenerate to segments have none of their separating axes among the
// seventeen: these are the remaining axes.
template <class T>
inline bool slivers_apart(const Triangle<T>& s, const Triangle<T>& t, T slack) {
  const Vec3<T> e[3] = {s.b - s.a, s.c - s.b, s.a - s.c}, f[3] = {t.b - t.a, t.c - t.b, t.a - t.c};
  const Vec3<T> p[3] = {s.a, s.b, s.c}, q[3] = {t.a, t.b, t.c};
  for (int i = 0; i < 3; ++i) {
    if (apart_along(e[i], s, t, slack) || apart_along(f[i], s, t, slack)) return true;
    for (int j = 0; j < 3; ++j) {
      const Vec3<T> n = cross(e[i], f[j]), w = q[j] - p[i];
      if (apart_along(cross(n, e[i]), s, t, slack) || apart_along(cross(n, f[j]), s, t, slack) ||
          apart_along(w, s, t, slack) || apart_along(cross(cross(e[i], w), e[i]), s, t, slack) ||
          apart_along(cross(cross(f[j], w), f[j]), s, t, slack))
        return true;
    }
  }
  return false;
}

}  // namespace detail

// Whether two triangles share a point. Separating axes: the two normals, the nine products of edges
// and, for coplanar triangles, the six normals of edges within the plane (Gottschalk, Lin, Manocha
// 1996, section 5, for triangles). Every axis is a separate proof, so rounding can change a verdict
// only within `rounding` of touching, where the answer is "meet".
template <class T>
inline bool triangles_meet(const Triangle<T>& s0, const Triangle<T>& t0, T scale) {
  const Vec3<T> o = t0.a;
  const Triangle<T> s{s0.a - o, s0.b - o, s0.c - o}, t{{}, t0.b - o, t0.c - o};
  const T slack = rounding<T> * scale;
  const Vec3<T> n = s.normal(), m = t.normal();
  if (detail::apart_along(m, s, t, slack) || detail::apart_along(n, s, t, slack)) return false;
  const Vec3<T> e[3] = {s.b - s.a, s.c - s.b, s.a - s.c}, f[3] = {t.b - t.a, t.c - t.b, t.a - t.c};
  for (const auto& x : e)
    for (const auto& y : f)
      if (detail::apart_along(cross(x, y), s, t, slack)) return false;
  for (int i = 0; i < 3; ++i)
    if (detail::apart_along(cross(n, e[i]), s, t, slack) ||
        detail::apart_along(cross(m, f[i]), s, t, slack))
      return false;
  return !((detail::sliver(s) || detail::sliver(t)) && detail::slivers_apart(s, t, slack));
}

// Least parameter in [0, 1] at which the segment p + s (q - p) meets the triangle, or -1. Along an
// edge shared by two faces both use the same three products with opposite sign, so nothing slips
// through between them.
template <class T>
inline T segment_meets(const Vec3<T>& p, const Vec3<T>& q, const Triangle<T>& t, T scale) {
  const Vec3<T> n = t.normal(), d = q - p, a = t.a - p, b = t.b - p, c = t.c - p;
  const T least = rounding<T> * scale * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  const T from = -dot(n, a), to = dot(n, d) + from;
  if ((from > least && to > least) || (from < -least && to < -least)) return -1;
  if (std::abs(from) > least || std::abs(to) > least) {
    const T u = dot(cross(a, b), d), v = dot(cross(b, c), d), w = dot(cross(c, a), d);
    // All three 0: seen from p the triangle is a point, and the segment may cross its plane
    // anywhere.
    const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    if (!inside || (u == 0 && v == 0 && w == 0)) return -1;
    const T s = from / (from - to);
    return s > 0 ? (s < 1 ? s : T(1)) : T(0);
  }
  // In the plane of the triangle: clip the segment by its three sides.
  T enter = 0, leave = 1;
  const Vec3<T> corner[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> inward = cross(n, corner[(i + 1) % 3] - corner[i]);
    const T at = -dot(inward, corner[i]), along = dot(inward, d);
    if (along == 0) {
      if (at < 0) return -1;
    } else if (along > 0) {
      enter = std::fmax(enter, -at / along);
    } else {
      leave = std::fmin(leave, -at / along);
    }
  }
  return enter <= leave && dot(n, n) > 0 ? enter : T(-1);
}

// Squared distance from a point to a triangle (Ericson, Real-Time Collision Detection, 2005,
// section 5.1.5).
template <class T>
inline T squared_distance(const Vec3<T>& p, const Triangle<T>& t) {
  const Vec3<T> ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const auto to = [&](const Vec3<T>& x) {
    const Vec3<T> d = p - x;
    return dot(d, d);
  };
  const auto share = [](T part, T all) {
    return all > 0 ? part / all : T(0);
  };  // 0 on an edge of zero length
  const T d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return to(t.a);
  const Vec3<T> bp = p - t.b;
  const T d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return to(t.b);
  const T vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return to(t.a + ab * share(d1, d1 - d3));
  const Vec3<T> cp = p - t.c;
  const T d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return to(t.c);
  const T vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return to(t.a + ac * share(d2, d2 - d6));
  const T va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return to(t.b + (t.c - t.b) * share(d4 - d3, (d4 - d3) + (d5 - d6)));
  const T sum = va + vb + vc;
  return sum > 0 ? to(t.a + ab * (vb / sum) + ac * (vc / sum)) : to(t.a);
}

// The segment from p to q, whose ends move by dp and dq, against the fixed segment from a to b: the
// least time in [0, 1] at which they cross, or -1. The four points are coplanar at the roots of a
// quadratic. Edges that stay coplanar throughout, or are parallel to rounding when they meet, are
// left to the tests of vertices against faces, which detect the same contact.
template <class T>
inline T edges_cross(const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& dp, const Vec3<T>& dq,
                     const Vec3<T>& a, const Vec3<T>& b, T scale) {
  const Vec3<T> f = b - a, e = q - p, de = dq - dp, w = p - a;
  const T c0 = triple(e, f, w), c1 = triple(de, f, w) + triple(e, f, dp), c2 = triple(de, f, dp);
  T root[2];
  int roots = 0;
  if (c2 == 0) {
    if (c1 != 0) root[roots++] = -c0 / c1;
  } else {
    const T disc = c1 * c1 - 4 * c2 * c0;
    if (disc < 0) return -1;
    const T h = -(c1 + (c1 < 0 ? -std::sqrt(disc) : std::sqrt(disc))) / 2;
    root[roots++] = h / c2;
    if (h != 0) root[roots++] = c0 / h;
    if (roots == 2 && root[1] < root[0]) {
      const T r = root[0];
      root[0] = root[1];
      root[1] = r;
    }
  }
  constexpr T slack = 64 * std::numeric_limits<T>::epsilon();
  for (int i = 0; i < roots; ++i) {
    T t = root[i];
    if (!(t >= -slack && t <= 1 + slack)) continue;
    t = t < 0 ? T(0) : t > 1 ? T(1) : t;
    const Vec3<T> et = e + de * t, wt = w + dp * t, n = cross(et, f);
    const T nn = dot(n, n), ef = dot(et, et) * dot(f, f);
    if (!(nn > std::numeric_limits<T>::epsilon() * ef)) continue;
    const T s = dot(cross(f, wt), n), u = dot(cross(et, wt), n);
    if (!(s >= -slack * nn && s <= nn * (1 + slack) && u >= -slack * nn && u <= nn * (1 + slack)))
      continue;
    // A root of a polynomial of rounding errors is not a contact: the two points must coincide, to
    // the accuracy that this angle permits.
    const Vec3<T> gap = wt + et * (s / nn) - f * (u / nn);
    const T least = slack * scale;
    if (dot(gap, gap) * nn <= least * least * ef) return t;
  }
  return -1;
}

}  // namespace ofg
