// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The faces of a convex body that oppose a direction, by table: for each cell of a cube map, the
// sixteen vertices of the faces that lie farthest that way, and the face in front.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <vector>

#include "separation.hpp"

namespace ofg::verified {

constexpr int patch_size = 16;  // vertices of a selection: a register of the widest set, in float

// A choice and no proof: what it selects are vertices of the body, and that is all that is relied
// on.
class OpposingTable {
 public:
  OpposingTable() = default;

  // cloud: n vertices relative to the centre, which the table keeps in units of `unit`.
  OpposingTable(const Cloud<double>& cloud, int n, const std::vector<std::array<int, 3>>& faces,
                double unit)
      : whole(n <= patch_size) {
    side = 1;  // two cells a face or so, where there are many
    while (side < 16 && 3 * side * side < int(faces.size())) side *= 2;
    const auto at = [&](int i) {
      const auto k = std::size_t(i);
      return Vec3<double>(cloud.x[k], cloud.y[k], cloud.z[k]);
    };
    std::vector<std::vector<int>> near(static_cast<std::size_t>(n)), of(near);
    for (int f = 0; f < int(faces.size()); ++f)
      for (const int i : faces[std::size_t(f)]) {
        of[std::size_t(i)].push_back(f);
        for (const int j : faces[std::size_t(f)])
          if (i != j) near[std::size_t(i)].push_back(j);
      }
    std::vector<int> seen(std::size_t(n), -1);
    int top = 0;
    for (int cell = 0; cell < cells(); ++cell) {
      const Vec3<double> d = direction(cell);
      const auto along = [&](int i) { return dot(at(i), d); };
      // Uphill from the last cell's vertex, then the best of the neighbours of those taken.
      for (bool climbs = true; climbs;) {
        climbs = false;
        for (const int j : near[std::size_t(top)])
          if (along(j) > along(top)) top = j, climbs = true;
      }
      std::priority_queue<std::pair<double, int>> front;
      front.push({along(top), -top});
      seen[std::size_t(top)] = cell;
      std::vector<int> taken;
      while (!front.empty() && int(taken.size()) < patch_size) {
        const int i = -front.top().second;
        front.pop(), taken.push_back(i);
        for (const int j : near[std::size_t(i)])
          if (seen[std::size_t(j)] != cell) seen[std::size_t(j)] = cell, front.push({along(j), -j});
      }
      for (int i = 0; i < n && whole && int(taken.size()) < n; ++i)  // those that no face names
        if (seen[std::size_t(i)] != cell) taken.push_back(i);
      for (int axis = 0; axis < 3 && (!whole || cell == 0); ++axis)
        for (int i = 0; i < patch_size; ++i) {
          const Vec3<double> p = at(taken[std::size_t(i < int(taken.size()) ? i : 0)]) * (1 / unit);
          points.push_back(float(axis == 0 ? p.x : axis == 1 ? p.y : p.z));
        }
      front_face.push_back(in_front(of[std::size_t(top)], faces, at, d));
    }
  }

  // x, y, z of patch_size points each, in units of `unit`. A body of no more vertices has one
  // patch.
  const float* patch(const Vec3<double>& d) const {
    return whole ? points.data() : points.data() + 3 * patch_size * std::size_t(cell_of(d));
  }
  // The face that opposes a direction.
  int face(const Vec3<double>& d) const { return front_face[std::size_t(cell_of(d))]; }
  // Every patch holds every vertex.
  bool complete() const { return whole; }
  std::size_t bytes() const { return points.size() * sizeof(float) + front_face.size() * 4; }

 private:
  std::vector<float> points;
  std::vector<std::int32_t> front_face;
  int side = 0;
  bool whole = false;

  int cells() const { return 6 * side * side; }

  Vec3<double> direction(int cell) const {
    const int face = cell / (side * side), i = cell / side % side, j = cell % side;
    const double u = (2 * i + 1.0) / side - 1, v = (2 * j + 1.0) / side - 1,
                 major = face % 2 ? -1 : 1;
    const Vec3<double> d = face / 2 == 0   ? Vec3<double>(major, u, v)
                           : face / 2 == 1 ? Vec3<double>(v, major, u)
                                           : Vec3<double>(u, v, major);
    return d * (1 / length(d));
  }

  // Anything that is no direction falls in some cell.
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

  // Of some faces, the one whose normal is nearest to a direction.
  template <class At>
  static int in_front(const std::vector<int>& some, const std::vector<std::array<int, 3>>& faces,
                      At at, const Vec3<double>& d) {
    int best = some.empty() ? 0 : some[0];
    double most = -2;
    for (const int f : some) {
      const auto& c = faces[std::size_t(f)];
      const Vec3<double> n = cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
      const double size = length(n), along = size > 0 ? dot(n, d) / size : -2;
      if (along > most) most = along, best = f;
    }
    return best;
  }
};

}  // namespace ofg::verified
