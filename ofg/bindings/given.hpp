// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// What Python may give the core, checked where it enters.
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cmath>
#include <string>

namespace given {

namespace nb = nanobind;

using Doubles = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Ints = nb::ndarray<const std::int32_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

// Rows of arrays: quaternion and position; displacement, axis, angle and the point turned about.
constexpr std::size_t pose_columns = 7, motion_columns = 10;

// What enters native code is checked here too: a wrong index or width would read what is not there,
// and numbers that are none, or whose products are none, break the order that sorting relies on.
// The limits are those of ofg/checks.py.
constexpr double longest = 1e60, longest_float = 1e10, smallest_float = 1e-10, largest_angle = 1e9;
constexpr double least_component = 1e-300, most_component = 1e300;
constexpr std::size_t most_rows = 100'000'000;  // times three, an index of 32 bits still

inline void require(bool fact, const std::string& words) {
  if (!fact) throw nb::value_error(words.c_str());
}
inline void check_width(const Doubles& rows, std::size_t columns, const char* what) {
  require(rows.shape(1) == columns,
          std::string(what) + " must have " + std::to_string(columns) + " columns");
}
inline void check_finite(const Doubles& rows, const char* what) {
  double sum = 0;  // x - x is 0, or no number
  for (std::size_t i = 0; i < rows.size(); ++i) sum += rows.data()[i] - rows.data()[i];
  require(sum == 0, std::string(what) + " holds a number that is not finite");
}
inline double largest(const double* x, std::size_t n) {
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) most = std::fmax(most, std::abs(x[i]));
  return most;
}
inline bool points_somewhere(const double* x, std::size_t n) {
  const double most = largest(x, n);
  return least_component <= most && most <= most_component;
}
inline void check_rows(const Doubles& rows, std::size_t n, std::size_t columns, const char* what) {
  check_width(rows, columns, what);
  require(rows.shape(0) == n, std::string(what) + " must have " + std::to_string(n) + " rows");
  check_finite(rows, what);
}
inline void check_poses(const Doubles& rows, std::size_t n, const char* what) {
  check_rows(rows, n, pose_columns, what);
  bool fine = true;
  for (std::size_t i = 0; i < n; ++i) {
    const double* p = rows.data() + pose_columns * i;
    fine &= points_somewhere(p, 4) && largest(p + 4, 3) <= longest;
  }
  require(fine, std::string(what) + " holds a quaternion or a position that is out of range");
}
inline void check_motions(const Doubles& rows, std::size_t n, const char* what) {
  check_rows(rows, n, motion_columns, what);
  bool fine = true;
  for (std::size_t i = 0; i < n; ++i) {
    const double* m = rows.data() + motion_columns * i;
    fine &= largest(m, 3) <= longest && largest(m + 7, 3) <= longest;
    fine &= std::abs(m[6]) <= largest_angle && (m[6] == 0 || points_somewhere(m + 3, 3));
  }
  require(fine, std::string(what) + " holds a length, an axis or an angle that is out of range");
}
// What single precision is given is relative; beyond its range it would be infinite.
inline void check_float(const double* pa, const double* pb, const double* ma, const double* mb,
                        std::size_t n) {
  bool fine = true;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 4; j < pose_columns; ++j)
      fine &= std::abs(pa[pose_columns * i + j] - pb[pose_columns * i + j]) <= longest_float;
    const double *m = ma + motion_columns * i, *o = mb + motion_columns * i;
    for (std::size_t j = 0; j < 3; ++j) fine &= std::abs(m[j] - o[j]) <= longest_float;
    fine &= largest(m + 7, 3) <= longest_float && largest(o + 7, 3) <= longest_float;
  }
  require(fine,
          "a relative position, a displacement or a point turned about is out of the range of "
          "single precision");
}
inline void check_mesh(const Doubles& v, const Ints& f) {
  check_width(v, 3, "vertices");
  check_finite(v, "vertices");
  require(f.shape(1) == 3, "faces must have 3 columns");
  require(v.shape(0) > 0 && f.shape(0) > 0, "a body needs a vertex and a face");
  require(v.shape(0) <= most_rows && f.shape(0) <= most_rows,
          "a body has too many vertices or faces");
  require(largest(v.data(), v.size()) <= longest,
          "vertices hold a coordinate that is out of range");
  bool there = true;
  for (std::size_t i = 0; i < f.size(); ++i)
    there &= f.data()[i] >= 0 && std::size_t(f.data()[i]) < v.shape(0);
  require(there, "faces name a vertex that is not there");
}

}  // namespace given
