// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Three-component vectors and 3 x 3 matrices, limited to the needs of the algorithm.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace ofg {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};
  constexpr Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  template <class U>
  explicit constexpr Vec3(const Vec3<U>& v) : x(T(v.x)), y(T(v.y)), z(T(v.z)) {}
  constexpr Vec3 operator+(const Vec3& v) const { return {x + v.x, y + v.y, z + v.z}; }
  constexpr Vec3 operator-(const Vec3& v) const { return {x - v.x, y - v.y, z - v.z}; }
  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  constexpr Vec3 operator*(T s) const { return {x * s, y * s, z * s}; }
  constexpr bool operator==(const Vec3&) const = default;
};

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
constexpr T triple(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
  return dot(cross(a, b), c);
}

template <class T>
inline T length(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}

template <class T>
constexpr T largest(const Vec3<T>& a) {
  const T x = a.x < 0 ? -a.x : a.x, y = a.y < 0 ? -a.y : a.y, z = a.z < 0 ? -a.z : a.z;
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

// 2^-e for a positive number in [2^e, 2^(e+1)): its product with a number is exact, and with this
// one lies in [1, 2).
template <class T>
constexpr T unit_of(T x) {
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  constexpr int mantissa = sizeof(T) == 8 ? 52 : 23;
  constexpr Bits twice_bias = sizeof(T) == 8 ? 2046 : 254;
  const Bits exponent = std::bit_cast<Bits>(x) >> mantissa;
  return std::bit_cast<T>((twice_bias - exponent) << mantissa);
}

// The unit of length for tests of coordinates up to `scale`. The tests multiply up to eight lengths
// together, which overflows at realistic sizes: in float from 2^15 on. In double, ordinary lengths
// are unchanged.
template <class T>
constexpr T unit_for(T scale) {
  if (sizeof(T) == 8 && scale > T(1e-6) && scale < T(1e6)) return 1;
  return unit_of(scale);
}

template <class T>
struct Mat3 {
  Vec3<T> row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr Vec3<T> operator*(const Vec3<T>& v) const {
    return {dot(row[0], v), dot(row[1], v), dot(row[2], v)};
  }
  constexpr Mat3 transposed() const {
    Mat3 m;
    m.row[0] = {row[0].x, row[1].x, row[2].x};
    m.row[1] = {row[0].y, row[1].y, row[2].y};
    m.row[2] = {row[0].z, row[1].z, row[2].z};
    return m;
  }
  constexpr Mat3 operator*(const Mat3& m) const {
    const Mat3 c = m.transposed();
    Mat3 r;
    for (int i = 0; i < 3; ++i)
      r.row[i] = {dot(row[i], c.row[0]), dot(row[i], c.row[1]), dot(row[i], c.row[2])};
    return r;
  }
};

}  // namespace ofg
