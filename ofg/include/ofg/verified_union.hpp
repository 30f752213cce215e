// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Verified overlap of bodies in several convex pieces, and of one pair of bodies at many poses.
#pragma once
#include <algorithm>

#include "verified.hpp"

namespace ofg::verified {

using Hulls = std::vector<Hull>;

// Do the interiors of two unions of hulls meet? They do where those of two pieces meet. Every pair
// of pieces is excluded by its bounding spheres or asked, until one meets. cache: used where each
// body is one piece.
inline Answer overlap(const Hulls& a, const Hulls& b, const Pose& pa, const Pose& pb,
                      Cache* cache = nullptr, const Parts& parts = {}) {
  const bool single = a.size() == 1 && b.size() == 1;
  Answer all;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      Answer one = overlap(a[i], b[j], pa, pb, single ? cache : nullptr, parts);
      one.counts.add(all.counts);
      all = one;
      if (single || all.hit) all.piece_a = int(i), all.piece_b = int(j);
      if (all.hit) return all;
    }
  return all;
}

}  // namespace ofg::verified
