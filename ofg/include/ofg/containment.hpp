// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Point-in-body tests. Disjoint surfaces still overlap as solids if one lies inside the other.
#pragma once
#include "mesh.hpp"
#include "motion.hpp"

namespace ofg {

// Strictly behind every face plane of a convex mesh, by more than rounding.
template <class T>
bool inside_convex(const Mesh<T>& m, const Vec3<T>& p) {
  const Vec3<T> d = p - m.centre;
  if (dot(d, d) > m.radius * m.radius) return false;
  const T slack = rounding<T> * (m.extent + largest(p));
  for (int f = 0; f < m.size(); ++f) {
    const Triangle<T> t = m.triangle(f);
    const Vec3<T> n = t.normal();
    if (dot(n, p - t.a) > -slack * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) && dot(n, n) > 0)
      return false;
  }
  return true;
}

// Whether the winding number of a closed mesh is non-zero (van Oosterom and Strackee 1983). The
// solid angles of its faces sum to 4 pi times that number, which is 2 where a shell lies in
// another, and negative in an inside-out shell.
template <class T>
bool inside_closed(const Mesh<T>& m, const Vec3<T>& p) {
  const Vec3<T> d = p - m.centre;
  if (dot(d, d) > m.radius * m.radius) return false;
  double angle = 0;
  for (int f = 0; f < m.size(); ++f) {
    const Triangle<T> t = m.triangle(f);
    const Vec3<double> a(t.a - p), b(t.b - p), c(t.c - p);
    const double la = length(a), lb = length(b), lc = length(c);
    angle += std::atan2(triple(a, b, c),
                        la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  // Half of the full 2 pi: atan2 gives half of each solid angle.
  return std::abs(angle) > 3.14159265358979323846;
}

template <class T>
bool inside(const Mesh<T>& m, const Vec3<T>& p) {
  return m.convex ? inside_convex(m, p) : inside_closed(m, p);
}

// Whether either solid contains a point of any part of the other. For solids with disjoint surfaces
// this decides whether they overlap: each part of a surface is then wholly inside the other or
// outside.
template <class T>
bool one_inside_other(const Mesh<T>& a, const Mesh<T>& b, const Transform<T>& a_to_b) {
  const Transform<T> b_to_a = a_to_b.inverse();
  const auto in = [](const Mesh<T>& m, const Transform<T>& to_m) {
    return [&](const Vec3<T>& p) { return inside(m, to_m(p)); };
  };
  return std::any_of(a.own_points.begin(), a.own_points.end(), in(b, a_to_b)) ||
         std::any_of(b.own_points.begin(), b.own_points.end(), in(a, b_to_a));
}

}  // namespace ofg
