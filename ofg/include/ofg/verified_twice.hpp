// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Numbers of twice the digits of a double: the unevaluated sum of two doubles, the second within
// half a unit in the last place of the first. After Joldes, Muller and Popescu, Tight and rigorous
// error bounds for basic building blocks of double-word arithmetic, ACM TOMS 44(2), 2017.
#pragma once
#include "vector.hpp"

namespace ofg::verified {

// No operation below is off by more than this share of its result, while nothing leaves the range
// of doubles: 3 u^2 of a sum, 5 u^2 of a product and 15 u^2 of a quotient, u = 2^-53, and what
// their higher powers add.
constexpr double twice_roundoff = 0x1p-102;

struct Twice {
  double high = 0, low = 0;
  constexpr Twice() = default;
  constexpr Twice(double x) : high(x) {}
  constexpr Twice(double h, double l) : high(h), low(l) {}
  constexpr explicit operator double() const { return high; }
  constexpr Twice operator-() const { return {-high, -low}; }
  constexpr bool operator==(const Twice&) const = default;
};

// |a| is no less than |b|, or a is 0.
constexpr Twice ordered_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
constexpr Twice exact_sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}
// Dekker, A floating-point technique for extending the available precision, 1971: without a fused
// multiply-add, which not every machine has.
constexpr Twice exact_product(double a, double b) {
  constexpr double split = 0x1p27 + 1;
  const double p = a * b, x = split * a, y = split * b;
  const double ah = x - (x - a), al = a - ah, bh = y - (y - b), bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

constexpr Twice operator+(const Twice& x, const Twice& y) {
  const Twice s = exact_sum(x.high, y.high), t = exact_sum(x.low, y.low);
  const Twice v = ordered_sum(s.high, s.low + t.high);
  return ordered_sum(v.high, t.low + v.low);
}
constexpr Twice operator-(const Twice& x, const Twice& y) { return x + -y; }
constexpr Twice operator*(const Twice& x, const Twice& y) {
  const Twice p = exact_product(x.high, y.high);
  return ordered_sum(p.high, p.low + (x.high * y.low + x.low * y.high));
}
constexpr Twice operator/(const Twice& x, const Twice& y) {
  const double t = x.high / y.high;
  const Twice r = y * Twice(t);
  return ordered_sum(t, ((x.high - r.high) + (x.low - r.low)) / y.high);
}

using Vec3Twice = Vec3<Twice>;

constexpr Vec3Twice exact_difference(const Vec3<double>& a, const Vec3<double>& b) {
  return {exact_sum(a.x, -b.x), exact_sum(a.y, -b.y), exact_sum(a.z, -b.z)};
}
// s is a power of two, so that nothing is rounded.
constexpr Vec3Twice scaled(const Vec3Twice& v, double s) {
  const auto times = [s](const Twice& x) { return Twice(x.high * s, x.low * s); };
  return {times(v.x), times(v.y), times(v.z)};
}
// No less than the length, but for three units in the last place.
constexpr double wide(const Vec3Twice& v) {
  const auto plus = [](double x) { return x < 0 ? -x : x; };
  return plus(v.x.high) + plus(v.y.high) + plus(v.z.high);
}

// N(q), the rotation times |q|^2.
inline Mat3<Twice> turning(const double (&q)[4]) {
  Twice ww = exact_product(q[0], q[0]), xx = exact_product(q[1], q[1]),
        yy = exact_product(q[2], q[2]), zz = exact_product(q[3], q[3]);
  const double two[4] = {2 * q[0], 2 * q[1], 2 * q[2], 2 * q[3]};
  const Twice xy = exact_product(two[1], q[2]), xz = exact_product(two[1], q[3]),
              yz = exact_product(two[2], q[3]), wx = exact_product(two[0], q[1]),
              wy = exact_product(two[0], q[2]), wz = exact_product(two[0], q[3]);
  Mat3<Twice> m;
  m.row[0] = {ww + xx - yy - zz, xy - wz, xz + wy};
  m.row[1] = {xy + wz, ww - xx + yy - zz, yz - wx};
  m.row[2] = {xz - wy, yz + wx, ww - xx - yy + zz};
  return m;
}
inline Twice square_of(const double (&q)[4]) {
  return exact_product(q[0], q[0]) + exact_product(q[1], q[1]) +
         (exact_product(q[2], q[2]) + exact_product(q[3], q[3]));
}

}  // namespace ofg::verified
