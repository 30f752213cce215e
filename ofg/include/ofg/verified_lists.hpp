// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The lists of a SupportMap in double precision: what makes a support proof without a look at every
// vertex of a large body.
#pragma once
#include "separation.hpp"
#include "support_map.hpp"

namespace ofg::verified {

// For each cell of a cube map of directions, every vertex that is extreme along one of them.
class ExtremeLists {
 public:
  ExtremeLists() = default;

  ExtremeLists(const Cloud<double>& cloud, const SupportMap& map) : side(map.view().side) {
    static_assert(list_unit % lanes<double> == 0);
    const int cells = 6 * side * side;
    first.assign(map.view().first, map.view().first + cells + 1);
    for (auto& f : first) f *= list_unit;
    for (const int i : map.indices()) {
      const auto k = std::size_t(i);
      points.push({cloud.x[k], cloud.y[k], cloud.z[k]});
    }
  }

  // Those that may be farthest along an axis.
  CloudView<double> along(const Vec3<double>& axis) const {
    const auto cell = std::size_t(cell_of(axis));
    const int from = first[cell];
    return {points.x.data() + from, points.y.data() + from, points.z.data() + from,
            first[cell + 1] - from};
  }

 private:
  Cloud<double> points;
  std::vector<int> first;  // point of each cell; then the end
  int side = 0;

  // Anything that is no direction falls in some cell. Lists overlap by far more than rounding.
  int cell_of(const Vec3<double>& d) const {
    const double c[3] = {d.x, d.y, d.z};
    const double s[3] = {std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    const int major = s[0] >= s[1] && s[0] >= s[2] ? 0 : s[1] >= s[2] ? 1 : 2;
    const double half = 0.5 * side / s[major];
    int cell = 2 * major + (c[major] < 0);
    for (int i = 1; i < 3; ++i) {
      const double u = (c[(major + i) % 3] + s[major]) * half;
      cell = cell * side + (u >= 0 ? u < side - 1 ? int(u) : side - 1 : 0);
    }
    return cell;
  }
};

}  // namespace ofg::verified
