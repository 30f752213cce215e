// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// An answer to "do the solids in two closed surfaces meet?" that shares nothing with
// verified_solid.hpp: every edge of one against every face of the other in 113 bits, and rays.
#pragma once
#include <array>

#include "judge.hpp"

namespace judge {

using Faces = std::vector<std::array<int, 3>>;

struct Skin {
  const Points<Quad>& points;
  const Faces& faces;
};

inline Quad size_of(Quad x) { return x < 0 ? -x : x; }

// The sign of a determinant; 0 where it is no larger than 113 bits may be off, 1e-26 of the cube of
// the largest coordinate.
struct Sign {
  Quad doubt = 0;

  explicit Sign(Quad most) : doubt(Quad(1e-26) * most * most * most) {}
  int operator()(const Point<Quad>& a, const Point<Quad>& b, const Point<Quad>& c,
                 const Point<Quad>& d) const {
    const Quad x = dot(cross(b - a, c - a), d - a);
    return size_of(x) <= doubt ? 0 : x > 0 ? 1 : -1;
  }
};

// 1 or -1: the segment passes through the face, from front to back or the other way; 0: it does
// not; 2: nobody knows.
inline int passes(const Point<Quad>& p, const Point<Quad>& q, const Point<Quad> (&f)[3],
                  const Sign& sign) {
  const int s = sign(f[0], f[1], f[2], p), t = sign(f[0], f[1], f[2], q);
  if (s == t && s != 0) return 0;
  int seen[3] = {};
  for (int i = 0; i < 3; ++i) ++seen[1 + sign(p, q, f[i], f[(i + 1) % 3])];
  if (seen[0] && seen[2]) return 0;
  return s == 0 || t == 0 || seen[1] ? 2 : s;
}

inline bool boxes_apart(const Point<Quad>& p, const Point<Quad>& q, const Point<Quad> (&f)[3],
                        Quad margin) {
  const auto apart = [&](auto of) {
    const Quad lo = std::min({of(f[0]), of(f[1]), of(f[2])}),
               hi = std::max({of(f[0]), of(f[1]), of(f[2])});
    return std::max(of(p), of(q)) < lo - margin || std::min(of(p), of(q)) > hi + margin;
  };
  return apart([](const Point<Quad>& v) { return v.x; }) ||
         apart([](const Point<Quad>& v) { return v.y; }) ||
         apart([](const Point<Quad>& v) { return v.z; });
}

inline void corners(const Skin& s, const std::array<int, 3>& face, Point<Quad> (&f)[3]) {
  for (std::size_t i = 0; i < 3; ++i) f[i] = s.points[std::size_t(face[i])];
}

// hit: an edge of A passes through a face of B; near: it may.
inline Says edges(const Skin& a, const Skin& b, const Sign& sign, Quad margin) {
  Says says = Says::clear;
  Point<Quad> e[3], f[3];
  for (const auto& x : a.faces) {
    corners(a, x, e);
    for (const auto& y : b.faces) {
      corners(b, y, f);
      for (int i = 0; i < 3; ++i) {
        const auto &p = e[i], &q = e[(i + 1) % 3];
        if (boxes_apart(p, q, f, margin)) continue;
        const int way = passes(p, q, f, sign);
        if (way == 1 || way == -1) return Says::hit;
        if (way == 2) says = Says::near;
      }
    }
  }
  return says;
}

// Is a vertex of A inside B? reach: no coordinate is larger. By a ray whose direction meets no
// edge, if one of a few does.
inline Says inside(const Point<Quad>& from, const Skin& b, const Sign& sign, Quad reach) {
  static constexpr double ways[4][3] = {
      {1, 0.3141, 0.2718}, {-0.4142, 1, 0.1732}, {0.2236, -0.3317, 1}, {-1, -0.6180, -0.1234}};
  for (const auto& w : ways) {
    const Point<Quad> to = {from.x + 4 * reach * w[0], from.y + 4 * reach * w[1],
                            from.z + 4 * reach * w[2]};
    int sum = 0;
    bool known = true;
    for (const auto& face : b.faces) {
      Point<Quad> f[3];
      corners(b, face, f);
      const int way = passes(from, to, f, sign);
      known = known && way != 2, sum += way;
    }
    if (known) return sum ? Says::hit : Says::clear;
  }
  return Says::near;
}

inline Says surfaces(const Question& question, const Faces& faces_a, const Faces& faces_b) {
  const Posed<Quad> posed(question);
  const Skin a{posed.a, faces_a}, b{posed.b, faces_b};
  const Sign sign(posed.lengths);
  const Quad margin = Quad(1e-20) * posed.lengths;
  const Says one = edges(a, b, sign, margin);
  const Says two = one == Says::hit ? one : edges(b, a, sign, margin);
  if (one == Says::hit || two == Says::hit) return Says::hit;
  if (one == Says::near || two == Says::near) return Says::near;
  Says says = Says::clear;
  for (const auto& [s, t] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const auto& face : s->faces) {
      const Says in = inside(s->points[std::size_t(face[0])], *t, sign, posed.lengths);
      if (in == Says::hit) return in;
      if (in == Says::near) says = in;
    }
  return says;
}

}  // namespace judge
