// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// How deep two solids are in each other: estimates.
#pragma once
#include "cover.hpp"

namespace truth {

class Depths : public Covers {
 public:
  using Covers::Covers;

  // Depth at t, an estimate: of the deepest of the overlapping pieces. With a mesh: the diameter of
  // the largest ball found inside both, growing from the common point.
  double depth_at(double t, const Common& common) {
    if (A_.mesh || B_.mesh) return ball(t, common);
    double deepest = 0;
    deepen(0, 0, t, deepest);
    return deepest;
  }

 private:
  // The largest ball inside both, from a common point: away from the nearer surface to half way
  // between the two, and some luck.
  double ball(double t, const Common& c) {
    vec<dd> x = unwide(c.point);
    vec<double> away_a, away_b;
    const auto turn_a = sd_.a.at(t) * sd_.RA, turn_b = sd_.b.at(t) * sd_.RB;
    auto room = [&](vec<dd> y, double& ra, double& rb) {
      effort_.done += 200;
      ra = A_.room(in_a(y, t), away_a), rb = B_.room(in_b(y, t), away_b);
      away_a = turn_a * away_a, away_b = turn_b * away_b;
      return std::min(ra, rb);
    };
    unsigned long long seed = 11;
    auto draw = [&] {
      return double((seed = seed * 6364136223846793005ULL + 1442695040888963407ULL) >> 33) /
                 2147483648.0 -
             0.5;
    };
    double ra, rb, r = room(x, ra, rb), step = r;
    vec<double> to_a = away_a, to_b = away_b;
    for (int i = 0; i < 20 && step > 3e-2 * r && !effort_.spent(); ++i) {
      vec<double> u;
      if (i % 3 == 0)
        u = (to_a + to_b) * (std::min(step, 0.9 * r) / std::max(norm(to_a + to_b), 1e-3));
      else if (i % 3 == 1)
        u = ra < rb ? to_a * std::min(0.5 * (rb - ra) + 0.1 * step, 0.9 * r)
                    : to_b * std::min(0.5 * (ra - rb) + 0.1 * step, 0.9 * r);
      else {
        u = {draw(), draw(), draw()};
        u = u * (std::min(step, 0.9 * r) /
                 std::max(norm(u), 1e-3));  // never out of the ball: the next centre is inside too
      }
      vec<dd> y = x + vec<dd>{dd(u.x), dd(u.y), dd(u.z)};
      double qa, qb, q = room(y, qa, qb);
      if (q > r)
        x = y, r = q, ra = qa, rb = qb, to_a = away_a, to_b = away_b, step = std::min(2 * step, r);
      else if (i % 3 == 2)
        step *= 0.6;
    }
    return 2 * r;
  }
  void deepen(int na, int nb, double t, double& deepest) {
    if (effort_.spent() || 1e3 * blur_ - sphere_gap(na, nb, t) <= deepest) return;
    auto P = quick(na, nb);
    const auto &x = P.a(t), &y = P.b(t);
    effort_.done += double(P.size());
    if (leaf_pair(na, nb)) {
      double d = depth(x, y, P.reach, effort_);
      if (d < 1e-9 * P.reach) {
        Near near(*this, na, nb, t);
        if (near.placed) d = depth(near.placed->a(t), near.placed->b(t), P.reach, effort_);
        if (!(d > 0)) {
          Exact e(*this, na, nb);
          d = depth(e.placed.a(t), e.placed.b(t), P.reach, effort_);
        }
      }
      deepest = std::max(deepest, d);
      return;
    }
    if (gjk<double>(x, y, y[0] - x[0], P.reach, 1e-3).status == Status::Apart) return;
    auto [c1, c2] = children(na, nb, t);
    deepen(c1.first, c1.second, t, deepest);
    deepen(c2.first, c2.second, t, deepest);
  }
};

}  // namespace truth
