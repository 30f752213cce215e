// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The bounds on second derivatives that verified sweeps rely on, against second differences of the
// gaps themselves, of random tetrahedra in random motions.
#pragma once
#include <random>

#include "ofg/verified_plane.hpp"

namespace bends {

using Random = std::mt19937_64;
using Vec = ofg::Vec3<double>;
using ofg::verified::Frame;
using ofg::verified::Hull;
using ofg::verified::Moving;
using ofg::verified::Plane;

inline Vec some(Random& r, double most) {
  std::uniform_real_distribution<double> u(-most, most);
  return {u(r), u(r), u(r)};
}

inline Hull tetrahedron(Random& r) {
  std::vector<Vec> v;
  const double long_way = r() % 2 ? 1 : 0.05;  // a rod swings as far as it reaches
  for (int i = 0; i < 4; ++i) {
    const Vec p = some(r, 1);
    v.push_back({p.x, p.y * long_way, p.z * long_way});
  }
  return Hull(v, {});
}

inline Plane plane(Random& r) {
  Plane p;
  p.frame = Frame(r() % 4);
  const auto unit = [&](double most) {
    const Vec v = some(r, most);
    return v * (1 / length(v));
  };
  p.n = unit(1), p.ea = unit(1), p.eb = unit(1);
  return p;
}

// The second difference of each pair's gap at a time, as a share of the bound; the largest.
inline double largest_share(const Moving& m, const Plane& p, double t, double bound) {
  const double h = 1e-4 / (1 + std::abs(m.of_a.angle) + std::abs(m.of_b.angle));
  const ofg::verified::Instant at[3] = {m.at(t - h), m.at(t), m.at(t + h)};
  double most = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      double f[3];
      for (int k = 0; k < 3; ++k)
        f[k] = dot(p.normal(at[k]),
                   (at[k].a * m.a.point(i) - at[k].b * m.b.point(j)) * m.unit + at[k].between);
      // Second differences are off by rounding, some 1e-15 / h^2.
      const double bent = std::abs(f[0] - 2 * f[1] + f[2]) / (h * h), off = 1e-14 / (h * h);
      most = std::fmax(most, (bent - off) / bound);
    }
  return most;
}

// The largest share of its bound that a second derivative takes, by kind of plane.
inline void shares(Random& r, int tries, double (&most)[4]) {
  std::uniform_real_distribution<double> time(0, 1), angle(-7, 7);
  for (auto& x : most) x = 0;
  for (int i = 0; i < tries; ++i) {
    const Hull a = tetrahedron(r), b = tetrahedron(r);
    if (a.flat || b.flat) continue;
    const auto motion = [&] {
      ofg::Motion m{some(r, r() % 2 ? 3 : 0), some(r, 1), r() % 3 ? angle(r) : 0, some(r, r() % 2)};
      return m;
    };
    const ofg::Pose at_a{{1, 0, 0, 0}, some(r, r() % 2 ? 3 : 0)}, at_b;
    const Moving m(a, b, at_a, at_b, motion(), motion());
    double s = time(r), e = time(r);
    if (e < s) std::swap(s, e);
    const double t = r() % 2 ? s : e;
    const Plane p = plane(r);
    const double bound = p.bound(m, s, e, m.at(s));
    if (bound > 1e-3) {
      double& kind = most[int(p.frame)];
      kind = std::fmax(kind, largest_share(m, p, t, bound));
    }
  }
}

}  // namespace bends
