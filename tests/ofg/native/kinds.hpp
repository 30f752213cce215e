// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The kinds of bodies and poses that verified overlap is asked about, and a count of each.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ofg/motion.hpp"
#include "shapes.hpp"

namespace kinds {

using Random = std::mt19937_64;

inline double uniform(Random& r, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(r);
}
inline int whole(Random& r, int a, int b) { return std::uniform_int_distribution<int>(a, b)(r); }

// A query may be of several; `any` is every one.
enum Kind {
  any,
  grid,
  needle,
  plate,
  doubled,
  coplanar,
  off_centre,
  open,
  size_ratio,
  far_away,
  near_touching,
  large,
  count
};
constexpr const char* names[count] = {"all",
                                      "on a grid",
                                      "needles",
                                      "plates",
                                      "vertices twice",
                                      "coplanar vertices",
                                      "centre far off",
                                      "open or no faces",
                                      "sizes 10 to 1e6 apart",
                                      "far from the origin",
                                      "moved to within 1e-6",
                                      "50 vertices and more"};

struct Kinds {
  bool is[count] = {true};
  bool& operator[](Kind k) { return is[k]; }
  bool operator[](Kind k) const { return is[k]; }
};

struct Row {
  long queries = 0, hits = 0, touching = 0, exact = 0, alone = 0, doubles = 0, quads = 0,
       planes = 0;
};

struct Tally {
  Row rows[count];
  long flat = 0;  // pairs of bodies refused

  template <class F>
  void add(const Kinds& kinds, F f) {
    for (int k = 0; k < count; ++k)
      if (kinds.is[k]) f(rows[k]);
  }

  // exact: answers that took exact arithmetic; alone: the same where twice the digits, which settle
  // most, were left out, as they are in one query of four. doubles, quads: the judge's
  // certificates.
  void print() const {
    std::printf("%-22s %10s %10s %10s %9s %8s %8s | judge: %10s %9s %9s\n", "kind", "queries",
                "hits", "clears", "touching", "exact", "alone", "doubles", "quads", "planes");
    for (int k = 0; k < count; ++k) {
      const Row& r = rows[k];
      std::printf("%-22s %10ld %10ld %10ld %9ld %8ld %8ld | %17ld %9ld %9ld\n", names[k], r.queries,
                  r.hits, r.queries - r.hits, r.touching, r.exact, r.alone, r.doubles, r.quads,
                  r.planes);
    }
    std::printf("%ld pairs of bodies refused as flat\n", flat);
  }
};

// Vertices of which the hull is the body, and faces that may or may not be its own.
inline Shape shape(Random& r, Kinds& kinds) {
  const bool few = !kinds[large];
  const int rings = few ? whole(r, 2, 3) : whole(r, 5, 9),
            sides = few ? (rings == 2 ? whole(r, 3, 8) : whole(r, 3, 4)) : whole(r, 12, 20);
  const auto thin = [&] {
    return whole(r, 0, 4) ? 1 : std::pow(10, uniform(r, few ? -9 : -1.5, 0));
  };
  const double sy = thin(), sz = thin();
  if (sy < 0.1 && sz < 0.1)
    kinds[needle] = true;
  else if (sy < 0.1 || sz < 0.1)
    kinds[plate] = true;
  const double rough = few && whole(r, 0, 1) ? uniform(r, 0, 0.9) : 0;
  Shape s = sphere(rings, sides, rough, 1, sy, sz, r);
  const std::size_t n = s.v.size() / 3;
  if (kinds[grid])
    for (auto& x : s.v) x = std::round(2 * x) / 2;
  if (!few) return s;
  if (whole(r, 0, 7) == 0) {
    kinds[open] = true;
    s.f.resize(3 * std::size_t(whole(r, 1, int(s.f.size() / 3))));
  }
  const auto vertex = [&] { return s.v.begin() + 3 * whole(r, 0, int(n) - 1); };
  if (whole(r, 0, 4) == 0) kinds[doubled] = true, std::copy_n(vertex(), 3, vertex());
  if (whole(r, 0, 4) == 0) {
    kinds[coplanar] = true;
    const auto a = vertex(), b = vertex(), c = vertex();
    for (int i = 0; i < 3; ++i) c[i] = (a[i] + b[i]) / 2;
  }
  if (whole(r, 0, 5) == 0) {
    kinds[off_centre] = true;
    const double far = std::pow(10, uniform(r, 0, 6));
    const double by[3] = {far * uniform(r, -1, 1), far * uniform(r, -1, 1),
                          far * uniform(r, -1, 1)};
    for (std::size_t i = 0; i < s.v.size(); ++i)
      s.v[i] += kinds[grid] ? std::round(by[i % 3]) : by[i % 3];
  }
  return s;
}

inline ofg::Pose pose(Random& r, const Kinds& kinds, double reach, double far) {
  ofg::Pose p;
  for (auto& c : p.q) c = kinds[grid] ? whole(r, -1, 1) : uniform(r, -1, 1);
  if (ofg::largest(ofg::Vec3<double>(p.q[1], p.q[2], p.q[3])) == 0) p.q[0] = 1;
  const auto at = [&] {
    return far + (kinds[grid] ? whole(r, -4, 4) / 2.0 : reach * uniform(r, -1, 1));
  };
  p.p = {at(), at(), at()};
  return p;
}

// Boxes that lie face on face, turned together by a quaternion of whole numbers, but for one corner
// that sticks out of its box by one step of a double, or lacks one: doubles cannot tell once it is
// turned. The boxes reach |q|^2 from their centres, so that places of exact contact are whole.
template <class Overlap>
const char* corner_by_corner(Random& r, Overlap overlap) {
  const int w = whole(r, 1, 9), x = whole(r, 1, 9), y = whole(r, 1, 9), z = whole(r, 1, 9);
  const double half = w * w + x * x + y * y + z * z;
  const int columns[3][3] = {
      {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
      {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
      {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}};
  std::vector<ofg::Vec3<double>> box;
  for (int i = 0; i < 8; ++i)
    box.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  const int axis = whole(r, 0, 2), i = whole(r, 0, 7), by = whole(r, 0, 1) ? 1 : -1;
  auto odd = box;
  auto& corner = odd[std::size_t(i)];
  double& c = axis == 0 ? corner.x : axis == 1 ? corner.y : corner.z;
  const int side = c > 0 ? 2 : -2;
  c = std::nextafter(c, by * c * 2);
  const ofg::Pose p{{double(w), double(x), double(y), double(z)}, {}};
  ofg::Pose q = p;
  const int* way = columns[axis];
  q.p = {double(side * way[0]), double(side * way[1]), double(side * way[2])};
  const bool right = overlap(odd, box, p, q) == (by > 0) && overlap(box, odd, q, p) == (by > 0);
  return right ? nullptr : "a corner out by one step of a double";
}

// Two pyramids with their bases in the plane x + 2 y + 2 z = 0, of whole numbers but for one corner
// of A: it is out by what vanishes beside the body, and B as little away. In doubles, which are
// relative to a centre, A's corners are tied or in an order by chance.
template <class Overlap>
const char* tied_corners(Random& r, Overlap overlap) {
  using V = ofg::Vec3<double>;
  const V normal(1, 2, 2), e(2, -1, 0), f(0, 1, -1);
  const auto some = [&] { return whole(r, 0, 3) ? std::ldexp(1, whole(r, -120, -50)) : 0; };
  const double out = some(), clear = some();
  std::vector<V> a{normal * 5}, b{normal * -9, e * -10 - f * 10, e * 99 - f * 10, f * 999 - e * 10};
  for (int i = 0; i < 20; ++i) a.push_back(i == 0 ? normal * -out : e * i + f * i * i);
  std::shuffle(a.begin(), a.end(), r);
  const int w = whole(r, 1, 9), x = whole(r, -9, 9), y = whole(r, -9, 9), z = whole(r, -9, 9);
  const ofg::Pose p{{double(w), double(x), double(y), double(z)}, {}};
  const double square = w * w + x * x + y * y + z * z;
  ofg::Pose q = p;  // N(q) has whole numbers: B is moved by |q|^2 clear along the turned normal
  q.p = V(w * w + x * x - y * y - z * z + 4 * (x * y - w * z) + 4 * (x * z + w * y),
          2 * (x * y + w * z) + 2 * (w * w - x * x + y * y - z * z) + 4 * (y * z - w * x),
          2 * (x * z - w * y) + 4 * (y * z + w * x) + 2 * (w * w - x * x - y * y + z * z)) *
        -clear;
  const bool hit = out > clear * square;
  const bool right = overlap(a, b, p, q) == hit && overlap(b, a, q, p) == hit;
  return right ? nullptr : "corners that doubles hold to be tied";
}

}  // namespace kinds
