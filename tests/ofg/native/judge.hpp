// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// An answer to "do the interiors of two convex hulls meet?" that shares nothing with verified.hpp:
// every plane that three vertices of one body or an edge of each can span is tried, in doubles and,
// where these are not sure, in 113 bits.
#pragma once
#include <algorithm>
#include <vector>

#include "ofg/motion.hpp"

namespace judge {

__extension__ typedef __float128 Quad;

template <class T>
struct Point {
  T x, y, z;
};
template <class T>
Point<T> operator-(const Point<T>& a, const Point<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
T dot(const Point<T>& a, const Point<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Point<T> cross(const Point<T>& a, const Point<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Posed = std::vector<Point<Quad>>;

// Vertices in the world less an origin near both, in quads.
inline Posed posed(const std::vector<ofg::Vec3<double>>& vertices, const ofg::Pose& pose,
                   const ofg::Vec3<double>& origin) {
  Quad q[4], size = 0, most = 0;
  for (const double c : pose.q) most = std::max(most, Quad(c < 0 ? -c : c));
  for (int i = 0; i < 4; ++i) q[i] = pose.q[i] / most, size += q[i] * q[i];
  const Quad w = q[0], x = q[1], y = q[2], z = q[3];
  const Quad m[9] = {
      w * w + x * x - y * y - z * z, 2 * (x * y - w * z),           2 * (x * z + w * y),
      2 * (x * y + w * z),           w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
      2 * (x * z - w * y),           2 * (y * z + w * x),           w * w - x * x - y * y + z * z};
  const Quad p[3] = {Quad(pose.p.x) - origin.x, Quad(pose.p.y) - origin.y,
                     Quad(pose.p.z) - origin.z};
  Posed out;
  for (const auto& v : vertices) {
    const auto row = [&](int i) {
      return (m[3 * i] * v.x + m[3 * i + 1] * v.y + m[3 * i + 2] * v.z) / size + p[i];
    };
    out.push_back({row(0), row(1), row(2)});
  }
  return out;
}

struct Pair {
  Posed a, b;
  std::vector<Point<double>> da, db;  // the same, rounded
  double size = 0;                    // of all coordinates

  Pair(Posed a_, Posed b_) : a(std::move(a_)), b(std::move(b_)) {
    for (auto* side : {&a, &b})
      for (const auto& p : *side) {
        (side == &a ? da : db).push_back({double(p.x), double(p.y), double(p.z)});
        for (const Quad c : {p.x, p.y, p.z}) size = std::max(size, std::abs(double(c)));
      }
  }

  // Calls f(normal in doubles, normal in quads as a function) for every candidate.
  template <class F>
  void normals(F f) const {
    for (const auto* side : {&a, &b}) {
      const auto& d = side == &a ? da : db;
      for (std::size_t i = 0; i < d.size(); ++i)
        for (std::size_t j = i + 1; j < d.size(); ++j)
          for (std::size_t k = j + 1; k < d.size(); ++k)
            f(cross(d[j] - d[i], d[k] - d[i]),
              [&, i, j, k] { return cross((*side)[j] - (*side)[i], (*side)[k] - (*side)[i]); });
    }
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = i + 1; j < a.size(); ++j)
        for (std::size_t k = 0; k < b.size(); ++k)
          for (std::size_t l = k + 1; l < b.size(); ++l)
            f(cross(da[j] - da[i], db[l] - db[k]),
              [&, i, j, k, l] { return cross(a[j] - a[i], b[l] - b[k]); });
  }

  // How far apart the two are along n, times |n|: the least along it of B less the greatest of A.
  template <class T>
  static T gap(const std::vector<Point<T>>& a, const std::vector<Point<T>>& b, const Point<T>& n) {
    T most = dot(a[0], n), least = dot(b[0], n);
    for (const auto& p : a) most = std::max(most, dot(p, n));
    for (const auto& p : b) least = std::min(least, dot(p, n));
    return least - most;
  }
};

enum class Says { clear, hit, near };  // near: within 1e-24 of touching, as good as touching

inline Says overlap(const Pair& pair) {
  // A normal is off by some 1e-15 size^2, so what is along it by 1e-15 size^3, however short it is.
  const double off = 1e-14 * pair.size * pair.size * pair.size;
  const Quad tiny = Quad(1e-28) * pair.size * pair.size * pair.size;
  bool clear = false, near = false;
  pair.normals([&](const Point<double>& n, auto exactly) {
    if (clear) return;
    double most[2] = {-1e300, -1e300}, least[2] = {1e300, 1e300};
    for (const auto& p : pair.da) {
      const double t = dot(p, n);
      most[0] = std::max(most[0], t), least[0] = std::min(least[0], t);
    }
    for (const auto& p : pair.db) {
      const double t = dot(p, n);
      most[1] = std::max(most[1], t), least[1] = std::min(least[1], t);
    }
    const double apart = std::max(least[1] - most[0], least[0] - most[1]);
    if (apart > off) clear = true;
    if (apart > off || apart < -off) return;
    const Point<Quad> m = exactly(), back = Point<Quad>{-m.x, -m.y, -m.z};
    if (dot(m, m) <= tiny * tiny / pair.size / pair.size) return;  // three in a line, or parallel
    const Quad gap = std::max(Pair::gap(pair.a, pair.b, m), Pair::gap(pair.a, pair.b, back));
    if (gap > tiny)
      clear = true;
    else if (gap >= -tiny)
      near = true;
  });
  return clear ? Says::clear : near ? Says::near : Says::hit;
}

// How far A may go along a direction and still meet B, if it goes on from where they do: beyond it
// they are apart. In doubles.
inline double reach(const Pair& pair, const Point<double>& way) {
  double far = 1e300;
  pair.normals([&](const Point<double>& n, auto) {
    for (const double side : {1.0, -1.0}) {
      const Point<double> m{side * n.x, side * n.y, side * n.z};
      const double speed = -dot(m, way);  // at which the gap along m grows
      if (!(speed > 0 && speed * speed > 1e-18 * dot(n, n) * dot(way, way))) continue;
      far = std::min(far, -Pair::gap(pair.da, pair.db, m) / speed);
    }
  });
  return far;
}

}  // namespace judge
