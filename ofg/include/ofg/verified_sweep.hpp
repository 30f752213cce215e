// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The first contact of two moving bodies in one or more convex pieces each.
#pragma once
#include <algorithm>

#include "verified_march.hpp"
#include "verified_translation.hpp"

namespace ofg::verified {

// Of two hulls over [0, until].
inline Impact sweep(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb, const Motion& ma,
                    const Motion& mb, double until = 1) {
  if (ma.angle != 0 || mb.angle != 0) return march(a, b, pa, pb, ma, mb, until);
  return translation(a, b, pa, pb, ma.displacement, mb.displacement, until);
}

// Of two unions of hulls: that of the pair of pieces that meets first. A later pair is asked until
// the earliest time found alone.
inline Impact sweep(const std::vector<Hull>& a, const std::vector<Hull>& b, const Pose& pa,
                    const Pose& pb, const Motion& ma, const Motion& mb) {
  const bool single = a.size() == 1 && b.size() == 1;
  Impact all;
  double until = 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      Impact one = sweep(a[i], b[j], pa, pb, ma, mb, until);
      one.counts.add(all.counts);
      if (single || one.hit) one.piece_a = int(i), one.piece_b = int(j);
      if (!one.hit && all.hit) {
        all.counts = one.counts;
        continue;
      }
      // The pair found before meets by its latest time too.
      if (all.hit && all.proved && all.latest < one.latest) one.latest = all.latest;
      all = one;
      if (all.hit) until = all.time;
      if (until == 0) return all;
    }
  return all;
}

}  // namespace ofg::verified
