// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A box about points, in the axes in which it is smaller: those of the body, or those in which the
// points spread, the last of which is across a surface (Gottschalk, Lin and Manocha, OBBTree,
// 1996).
#pragma once
#include <cmath>
#include <vector>

#include "vector.hpp"

namespace ofg::verified {

struct Box {
  Vec3<double> axis[3], centre, extent;

  const Vec3<double>& longest() const {
    return axis[extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2];
  }
  double area() const { return extent.x * (extent.y + extent.z) + extent.y * extent.z; }
};

// Of the bounding box along the axes of the body.
inline Vec3<double> middle_of(const std::vector<Vec3<double>>& points) {
  Vec3<double> lo = points[0], hi = points[0];
  for (const auto& v : points) {
    lo = {std::fmin(lo.x, v.x), std::fmin(lo.y, v.y), std::fmin(lo.z, v.z)};
    hi = {std::fmax(hi.x, v.x), std::fmax(hi.y, v.y), std::fmax(hi.z, v.z)};
  }
  return (lo + hi) * 0.5;
}

namespace detail {

template <class Points>
Box box_along(const Points& points, const Vec3<double> (&axis)[3]) {
  double lo[3], hi[3];
  for (int k = 0; k < 3; ++k) lo[k] = INFINITY, hi[k] = -INFINITY;
  points([&](const Vec3<double>& p) {
    for (int k = 0; k < 3; ++k) {
      const double x = dot(axis[k], p);
      lo[k] = std::fmin(lo[k], x), hi[k] = std::fmax(hi[k], x);
    }
  });
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.axis[k] = axis[k];
    box.centre = box.centre + axis[k] * ((lo[k] + hi[k]) / 2);
  }
  box.extent = {(hi[0] - lo[0]) / 2, (hi[1] - lo[1]) / 2, (hi[2] - lo[2]) / 2};
  return box;
}

// A unit vector at right angles to one.
inline Vec3<double> beside(const Vec3<double>& v) {
  const Vec3<double> w = std::abs(v.x) < 0.6 ? Vec3<double>(1, 0, 0) : Vec3<double>(0, 1, 0);
  const Vec3<double> n = cross(v, w);
  return n * (1 / length(n));
}

// The direction in which points spread most, of those at right angles to `to` (0: of all): the
// power method, of which a few steps are enough to leave a thin direction.
inline Vec3<double> spread(const Mat3<double>& covariance, const Vec3<double>& to) {
  const auto free = [&](Vec3<double> v) {
    v = v - to * dot(to, v);
    v = v - to * dot(to, v);
    const double size = length(v);
    return size > 1e-30 ? v * (1 / size) : Vec3<double>();
  };
  Vec3<double> best;
  for (const auto& row : covariance.row) {
    const Vec3<double> v = row - to * dot(to, row);
    if (dot(v, v) > dot(best, best)) best = v;
  }
  best = free(best);
  for (int i = 0; i < 6; ++i) best = free(covariance * best);
  return best;
}

}  // namespace detail

// points: calls what it is given with each point; none farther than 1 from the origin.
template <class Points>
Box box_of(const Points& points) {
  const Vec3<double> own[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Box plain = detail::box_along(points, own);
  Mat3<double> c;
  for (auto& row : c.row) row = {};
  points([&](const Vec3<double>& p) {
    const Vec3<double> d = p - plain.centre;
    c.row[0] = c.row[0] + d * d.x, c.row[1] = c.row[1] + d * d.y, c.row[2] = c.row[2] + d * d.z;
  });
  Vec3<double> axis[3] = {detail::spread(c, {})};
  if (!(dot(axis[0], axis[0]) > 0.5)) return plain;
  axis[1] = detail::spread(c, axis[0]);
  if (!(dot(axis[1], axis[1]) > 0.5)) axis[1] = detail::beside(axis[0]);
  axis[2] = cross(axis[0], axis[1]);
  const Box turned = detail::box_along(points, axis);
  return turned.area() < plain.area() ? turned : plain;
}

}  // namespace ofg::verified
