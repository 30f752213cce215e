// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The first contact of two moving bodies in one or more convex pieces each.
#pragma once
#include <algorithm>

#include "verified_march.hpp"
#include "verified_translation.hpp"

namespace ofg::verified {

namespace detail {

// Do the spheres about the origins of the hulls' frames pass by, where the hulls turn about these
// if at all? Nothing is rotated for it. Lengths are off by a few units of rounding.
inline bool pass_by(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb, const Motion& ma,
                    const Motion& mb, double until) {
  const auto elsewhere = [](const Motion& m) {
    return m.angle != 0 && !(m.about == Vec3<double>());
  };
  if (elsewhere(ma) || elsewhere(mb)) return false;
  const Vec3<double> p = pa.p - pb.p, d = ma.displacement - mb.displacement;
  const double sum = a.radius + length(a.centre) + b.radius + length(b.centre), square = dot(d, d),
               along = -dot(p, d);
  const double t = !(along > 0) ? 0 : along < until * square ? along / square : until;
  const Vec3<double> nearest = p + d * t;
  const double reach = sum * (1 + 1e-9) + 1e-12 * (length(p) + std::sqrt(square));
  return dot(nearest, nearest) > reach * reach;
}

}  // namespace detail

// Of two hulls over [0, until].
inline Impact sweep(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb, const Motion& ma,
                    const Motion& mb, double until = 1) {
  if (detail::pass_by(a, b, pa, pb, ma, mb, until)) {
    Impact clear;
    clear.counts.spheres = clear.counts.steps = 1;
    return clear;
  }
  if (ma.angle != 0 || mb.angle != 0) return march(a, b, pa, pb, ma, mb, until);
  return translation(a, b, pa, pb, ma.displacement, mb.displacement, until);
}

namespace detail {

// What two pairs of pieces say together: the first contact is no earlier than the earlier of their
// times, and no later than the latest time of either.
inline void join(Impact& all, const Impact& one) {
  Counts counts = all.counts;
  counts.add(one.counts);
  if (one.hit) {
    const double latest = all.hit ? std::fmin(all.latest, one.latest) : one.latest;
    if (!all.hit || one.time < all.time) all = one;
    all.latest = latest, all.proved = latest - all.time <= widest_bracket;
  }
  all.counts = counts;
}

// When the spheres of two pieces meet first; more than 1 if they never do.
inline double first_possible(const Hull& a, const Hull& b, const Track& track) {
  // About the pivots, which move straight; a hull that does not turn may have its own anywhere.
  const auto pivot = [](const Hull& hull, const Mover& mover) {
    return mover.turns() ? Vec3<double>() : mover.r * (hull.centre - mover.motion.about);
  };
  const auto reach = [](const Hull& hull, const Mover& mover) {
    return hull.radius + (mover.turns() ? mover.lever(hull.centre) : 0);
  };
  const Vec3<double> p = track.pivots(0) + pivot(a, track.a) - pivot(b, track.b),
                     d = track.a.motion.displacement - track.b.motion.displacement;
  const double sum = (reach(a, track.a) + reach(b, track.b)) * (1 + 1e-9), square = dot(d, d),
               apart = dot(p, p) - sum * sum;
  if (!(apart > 0)) return 0;
  const double along = -dot(p, d), under = along * along - square * apart;
  if (!(square > 0) || along < 0 || under < 0) return 2;
  return apart / (along + std::sqrt(under));
}

}  // namespace detail

// Of two unions of hulls: that of the pair of pieces that meets first. Pairs are asked in the order
// in which their spheres meet, each until the time at which another is proved to meet.
inline Impact sweep(const std::vector<Hull>& a, const std::vector<Hull>& b, const Pose& pa,
                    const Pose& pb, const Motion& ma, const Motion& mb) {
  const auto ask = [&](int i, int j, double until) {
    Impact one = sweep(a[std::size_t(i)], b[std::size_t(j)], pa, pb, ma, mb, until);
    one.piece_a = i, one.piece_b = j;
    return one;
  };
  if (a.size() == 1 && b.size() == 1) return ask(0, 0, 1);
  struct Pair {
    double from;
    int i, j;
  };
  std::vector<Pair> pairs;
  const Track track(pa, pb, ma, mb);
  for (int i = 0; i < int(a.size()); ++i)
    for (int j = 0; j < int(b.size()); ++j)
      pairs.push_back({detail::first_possible(a[std::size_t(i)], b[std::size_t(j)], track), i, j});
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::pair(x.from, x.i + x.j) < std::pair(y.from, y.i + y.j);
  });
  Impact all;
  all.counts.spheres = std::int64_t(pairs.size());
  for (const auto& pair : pairs) {
    const double until = all.latest < 1 ? all.latest : 1;
    // Rounding of the spheres' time is far less than this.
    if (pair.from > until + 1e-6 || until == 0) break;
    detail::join(all, ask(pair.i, pair.j, until));
  }
  if (!all.hit) all.piece_a = all.piece_b = -1;
  return all;
}

}  // namespace ofg::verified
