// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The units that suit an engine, as baselines/units.py chooses them: powers of two, B's position as
// the origin.
#pragma once
#include <map>

#include "lane.hpp"

namespace lane {

class Units {
 public:
  std::vector<Body> bodies;
  std::vector<Case> cases;

  // length: the radius that the smaller body of a pair gets, within a factor of sqrt(2).
  Units(const std::vector<Body>& all, const std::vector<Case>& asked, double length) {
    for (Case c : asked) {
      const double least = std::min(all[c.a].radius, all[c.b].radius);
      const double unit = std::exp2(std::nearbyint(std::log2(length / least)));
      for (int i = 0; i < 3; ++i) {
        c.pose_a.p[i] = unit * (c.pose_a.p[i] - c.pose_b.p[i]);
        c.displacement[i] *= unit;
      }
      c.pose_b.p = {0, 0, 0};
      c.a = scaled(all, c.a, unit), c.b = scaled(all, c.b, unit);
      cases.push_back(c);
    }
  }

 private:
  std::map<std::pair<std::uint32_t, double>, std::uint32_t> made_;

  std::uint32_t scaled(const std::vector<Body>& all, std::uint32_t body, double unit) {
    const auto [at, fresh] = made_.try_emplace({body, unit}, std::uint32_t(bodies.size()));
    if (fresh) {
      bodies.push_back(all[body]);
      for (double& x : bodies.back().vertices) x *= unit;
      bodies.back().radius *= unit;
    }
    return at->second;
  }
};

}  // namespace lane
