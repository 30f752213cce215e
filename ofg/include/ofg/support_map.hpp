// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The support function of a set of points by table: for every cell of a cube map of directions, the
// points that are extreme along some direction of the cell. The list is complete, so the best point
// of a cell's list is the best of all.
#pragma once
#include <cmath>
#include <vector>

#include "simd/kernels.hpp"

namespace ofg {

// Points are stored relative to `centre` in units of `radius`, in single precision: users must
// allow for its rounding.
class SupportMap {
 public:
  SupportMap() = default;

  // x, y, z: n coordinates each; radius: at least the distance of any point from the centre (0 is
  // taken as 1).
  template <class T>
  SupportMap(const T* x, const T* y, const T* z, int n, const Vec3<T>& centre, T radius) {
    const double unit = radius > 0 ? 1 / double(radius) : 1;
    std::vector<Vec3<double>> all;
    for (int i = 0; i < n; ++i)
      all.push_back((Vec3<double>(Vec3<T>(x[i], y[i], z[i])) - Vec3<double>(centre)) * unit);
    std::vector<int> everyone;
    for (int i = 0; i < n; ++i) everyone.push_back(i);
    // A dozen points per cell if they are spread evenly: a list is read sixteen at a time.
    side = 1;
    if (n > list_unit)
      while (side < 32 && side < 0.5 * std::sqrt(double(n))) side *= 2;
    std::vector<std::vector<int>> lists(std::size_t(6 * side * side),
                                        n > list_unit ? std::vector<int>() : everyone);
    if (n > list_unit)
      for (int face = 0; face < 6; ++face) divide(all, everyone, face, 0, 0, 1, lists);
    first.push_back(0);
    for (const auto& list : lists) add(all, list);
  }

  SupportView view() const { return {points.data(), first.data(), side}; }

  // Of the points in the lists, list after list.
  const std::vector<int>& indices() const { return ids; }

 private:
  std::vector<float> points;  // lists of x, y, z in turn, list_unit of each
  std::vector<int> ids;       // list_unit of each list
  std::vector<int> first;     // of each cell, in units of lists; then the end
  int side = 0;

  static Vec3<double> direction(int face, double u, double v) {
    const double major = face % 2 ? -1 : 1;
    const double at[3] = {major, u, v};
    const int axis = face / 2;
    const Vec3<double> d{at[(3 - axis) % 3], at[(4 - axis) % 3], at[(5 - axis) % 3]};
    return d * (1 / length(d));
  }

  // The points of a list that are extreme somewhere in cell i, j of `cells` x `cells`; then
  // recursively for its quarters.
  void divide(const std::vector<Vec3<double>>& all, const std::vector<int>& list, int face, int i,
              int j, int cells, std::vector<std::vector<int>>& lists) const {
    std::vector<int> here = extreme(all, list, face, i, j, cells);
    if (cells == side) {
      lists[std::size_t((face * side + i) * side + j)] = std::move(here);
      return;
    }
    for (const int k : {0, 1})
      for (const int l : {0, 1}) divide(all, here, face, 2 * i + k, 2 * j + l, 2 * cells, lists);
  }

  // A point p is no better than q along any direction within `reach` of c (both of unit length) if
  // c . (q - p) > reach |q - p|.
  static std::vector<int> extreme(const std::vector<Vec3<double>>& all,
                                  const std::vector<int>& list, int face, int i, int j, int cells) {
    const auto at = [&](double k) { return 2 * k / cells - 1; };
    const Vec3<double> c = direction(face, at(i + 0.5), at(j + 0.5));
    double reach = 0;
    for (const int k : {0, 1})
      for (const int l : {0, 1})
        reach = std::fmax(reach, length(direction(face, at(i + k), at(j + l)) - c));
    reach += 1e-4;  // cells are looked up in single precision
    Vec3<double> best = all[std::size_t(list[0])];
    for (const int k : list)
      if (dot(c, best) < dot(c, all[std::size_t(k)])) best = all[std::size_t(k)];
    std::vector<int> kept;
    kept.reserve(list.size());
    for (const int k : list) {
      const Vec3<double> less = best - all[std::size_t(k)];
      const double behind = dot(c, less);
      if (!(behind > 0 && behind * behind > reach * reach * dot(less, less))) kept.push_back(k);
    }
    return kept;
  }

  void add(const std::vector<Vec3<double>>& all, const std::vector<int>& list) {
    const std::size_t lists = (list.size() + list_unit - 1) / list_unit;
    for (std::size_t i = 0; i < lists * list_unit; ++i)
      ids.push_back(list[i < list.size() ? i : 0]);
    for (std::size_t k = 0; k < lists; ++k)
      for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = k * list_unit; i < (k + 1) * list_unit; ++i) {
          const Vec3<double>& p = all[std::size_t(list[i < list.size() ? i : 0])];
          points.push_back(float(axis == 0 ? p.x : axis == 1 ? p.y : p.z));
        }
    first.push_back(first.back() + int(lists));
  }
};

}  // namespace ofg
