// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Penetration depth of two overlapping convex point sets: an expanding polytope (van den Bergen
// 2001). An estimate from above.
#pragma once
#include "convex.hpp"

namespace truth {

// The least width |max n.a - min n.b| over the directions the polytope has tried; 0 if the sets do
// not overlap as far as T sees. thin: gets the unit direction in which B is moved off A the
// soonest, reversed.
template <class T>
double depth(const Points<T>& A, const Points<T>& B, double reach, Effort& effort,
             vec<T>* thin = nullptr, int rounds = 96) {
  struct Facet {
    int v[3];
    vec<T> n;
    T far;
    bool live;
  };
  auto g = gjk<T>(A, B, B[0] - A[0], reach, 1e-3);
  if (g.status == Status::Unknown) {  // symmetric poses put the origin on a simplex: move B off by
                                      // less than matters
    Points<T> moved(B);
    vec<T> off{T(0.6), T(-0.5), T(0.7)};
    for (auto& v : moved) v = v + off * T(1e6 * resolution<T>() * reach);
    g = gjk<T>(A, moved, moved[0] - A[0], reach, 1e-3);
  }
  if (g.status != Status::Meet) return 0;
  std::vector<vec<T>> p;
  for (auto& s : g.s) p.push_back(s.c);
  std::vector<Facet> facets;
  double least = 1e300;
  auto add = [&](int a, int b, int c) {
    auto n = cross(p[b] - p[a], p[c] - p[a]);
    T l = norm(n);
    if (!(l > T(0))) return;
    n = n * (T(1) / l);
    facets.push_back({{a, b, c}, n, dot(n, p[a]), true});
  };
  bool out = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) < T(0);
  static const int corner[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  for (auto& c : corner) out ? add(c[0], c[1], c[2]) : add(c[0], c[2], c[1]);
  std::vector<std::pair<int, int>> rim;
  for (int round = 0; round < rounds && !effort.spent(); ++round) {
    int best = -1;
    for (int i = 0; i < int(facets.size()); ++i)
      if (facets[i].live && (best < 0 || facets[i].far < facets[best].far)) best = i;
    if (best < 0) break;
    auto n = facets[best].n;
    effort.done += double(A.size() + B.size()) * (std::is_same_v<T, double> ? 1 : 20);
    auto w = B[support(B, n)] - A[support(A, -n)];
    double width = double(dot(n, w));
    if (width < least && thin) *thin = -n;
    least = std::min(least, width);
    if (width - double(facets[best].far) <= 1e-3 * std::abs(width) ||
        double(facets[best].far) >= least)
      break;
    int id = int(p.size());
    p.push_back(w);
    rim.clear();
    for (auto& f : facets) {
      if (!f.live || !(dot(f.n, w) - f.far > T(resolution<T>() * reach))) continue;
      f.live = false;
      for (int i = 0; i < 3; ++i) {
        std::pair<int, int> e{f.v[i], f.v[(i + 1) % 3]};
        auto twin = std::find(rim.begin(), rim.end(), std::pair{e.second, e.first});
        if (twin == rim.end())
          rim.push_back(e);
        else
          rim.erase(twin);
      }
    }
    if (rim.empty()) break;
    for (auto& e : rim) add(e.first, e.second, id);
  }
  return least < 1e300 ? std::max(least, 0.0) : 0;
}

}  // namespace truth
