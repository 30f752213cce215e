// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Exact arithmetic on doubles: sums, differences and products without rounding. For the few
// questions that doubles cannot settle.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "vector.hpp"

namespace ofg::verified {

// As much of a vector of limbs as Number needs. So many have their place in the object that a call
// of the allocator is rare; where they are too many for it, all are in the vector.
class Limbs {
 public:
  Limbs() = default;
  Limbs(const Limbs& o) : count(o.count), far(o.far) { std::copy_n(o.near, o.nearby(), near); }
  Limbs(Limbs&& o) noexcept : count(o.count), far(std::move(o.far)) {
    std::copy_n(o.near, nearby(), near);
    o.count = 0, o.far.clear();
  }
  Limbs& operator=(const Limbs& o) {
    count = o.count, far = o.far;
    std::copy_n(o.near, o.nearby(), near);
    return *this;
  }
  Limbs& operator=(Limbs&& o) noexcept {
    count = o.count, far = std::move(o.far);
    std::copy_n(o.near, nearby(), near);
    return *this;
  }

  std::size_t size() const { return count; }
  bool empty() const { return count == 0; }
  const std::uint64_t* data() const { return far.empty() ? near : far.data(); }
  std::uint64_t* data() { return far.empty() ? near : far.data(); }
  std::uint64_t operator[](std::size_t i) const { return data()[i]; }
  std::uint64_t& operator[](std::size_t i) { return data()[i]; }
  std::uint64_t back() const { return data()[count - 1]; }
  void pop_back() { --count; }
  // So many zeros, in place of what was there.
  void zeros(std::size_t n) {
    count = n, far.clear();
    if (n > most)
      far.assign(n, 0);
    else
      std::fill_n(near, n, 0);
  }

 private:
  static constexpr std::size_t most = 20;
  std::size_t count = 0;
  std::uint64_t near[most];
  std::vector<std::uint64_t> far;

  std::size_t nearby() const { return far.empty() ? count : 0; }
};

// A number m 2^e with whole m of any length and e of any size: every finite double is one, and so
// is every polynomial of doubles.
class Number {
 public:
  Number() = default;

  explicit Number(double x) {
    if (x == 0) return;
    int e;
    const double m = std::frexp(std::abs(x), &e);  // exact also of subnormal numbers
    negative = x < 0;
    limbs.zeros(1), limbs[0] = std::uint64_t(std::ldexp(m, 53));
    exponent = e - 53;
  }

  int sign() const { return limbs.empty() ? 0 : negative ? -1 : 1; }

  // |x| < 2^bits(), and no less than half of that. Not of zero.
  long bits() const { return exponent + 64 * long(limbs.size()) - std::countl_zero(limbs.back()); }

  // x 2^-shift, rounded: within 2^-52 of itself, or of 2^-1000 where it is smaller than that.
  double rounded(long shift) const {
    if (limbs.empty()) return 0;
    double m = double(limbs.back());  // the limb below it adds what this one may lack
    long e = exponent + 64 * long(limbs.size() - 1) - shift;
    if (limbs.size() > 1) m = m * 0x1p64 + double(limbs[limbs.size() - 2]), e -= 64;
    if (e < -1200) return 0;
    return std::ldexp(negative ? -m : m, int(e));
  }

  Number operator-() const {
    Number n = *this;
    n.negative = !negative;
    return n;
  }

  Number operator+(const Number& o) const {
    if (limbs.empty()) return o;
    if (o.limbs.empty()) return *this;
    const bool first = exponent > o.exponent;  // to be written in units of the other's
    const Number wide = (first ? *this : o).in_units(first ? o.exponent : exponent);
    const Number& one = first ? wide : *this;
    const Number& two = first ? o : wide;
    Number sum;
    sum.exponent = one.exponent;
    if (one.negative == two.negative) {
      sum.negative = one.negative;
      added(one.limbs, two.limbs, sum.limbs);
    } else {
      const bool more = larger(one.limbs, two.limbs);
      sum.negative = more ? one.negative : two.negative;
      subtracted(more ? one.limbs : two.limbs, more ? two.limbs : one.limbs, sum.limbs);
    }
    return sum;
  }

  Number operator-(const Number& o) const { return *this + -o; }

  Number operator*(const Number& o) const {
    Number p;
    if (limbs.empty() || o.limbs.empty()) return p;
    p.negative = negative != o.negative, p.exponent = exponent + o.exponent;
    p.limbs.zeros(limbs.size() + o.limbs.size());
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < o.limbs.size(); ++j) {
        const Wide t = Wide(limbs[i]) * o.limbs[j] + p.limbs[i + j] + carry;
        p.limbs[i + j] = std::uint64_t(t), carry = std::uint64_t(t >> 64);
      }
      p.limbs[i + o.limbs.size()] = carry;
    }
    trim(p.limbs);
    return p;
  }

 private:
  __extension__ typedef unsigned __int128 Wide;

  Limbs limbs;  // of |m|, the least first, the last not zero; none of zero
  long exponent = 0;
  bool negative = false;

  static void trim(Limbs& x) {
    while (!x.empty() && x.back() == 0) x.pop_back();
  }

  // The same number with this exponent, no more than its own.
  Number in_units(long e) const {
    const std::size_t whole = std::size_t(exponent - e) / 64;
    const int part = int((exponent - e) % 64);
    Number n;
    n.negative = negative, n.exponent = e;
    n.limbs.zeros(whole + limbs.size() + 1);
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      const std::uint64_t x = limbs[i];
      n.limbs[whole + i] = part ? x << part | carry : x;
      carry = part ? x >> (64 - part) : 0;
    }
    n.limbs[whole + limbs.size()] = carry;
    trim(n.limbs);
    return n;
  }

  static bool larger(const Limbs& x, const Limbs& y) {
    if (x.size() != y.size()) return x.size() > y.size();
    for (std::size_t i = x.size(); i-- > 0;)
      if (x[i] != y[i]) return x[i] > y[i];
    return false;
  }

  static void added(const Limbs& x, const Limbs& y, Limbs& sum) {
    const Limbs &more = x.size() < y.size() ? y : x, &less = x.size() < y.size() ? x : y;
    std::uint64_t carry = 0;
    sum.zeros(more.size() + 1);
    for (std::size_t i = 0; i < more.size(); ++i) {
      const Wide t = Wide(more[i]) + (i < less.size() ? less[i] : 0) + carry;
      sum[i] = std::uint64_t(t), carry = std::uint64_t(t >> 64);
    }
    sum[more.size()] = carry;
    trim(sum);
  }

  // x is no less than y.
  static void subtracted(const Limbs& x, const Limbs& y, Limbs& rest) {
    std::uint64_t borrow = 0;
    rest.zeros(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Wide t = Wide(x[i]) - (i < y.size() ? y[i] : 0) - borrow;
      rest[i] = std::uint64_t(t), borrow = std::uint64_t(t >> 64) & 1;
    }
    trim(rest);
  }
};

struct Vector {
  Number x, y, z;
  Vector() = default;
  Vector(Number x_, Number y_, Number z_) : x(std::move(x_)), y(std::move(y_)), z(std::move(z_)) {}
  explicit Vector(const Vec3<double>& v) : x(v.x), y(v.y), z(v.z) {}
  Vector operator+(const Vector& v) const { return {x + v.x, y + v.y, z + v.z}; }
  Vector operator-(const Vector& v) const { return {x - v.x, y - v.y, z - v.z}; }
  Vector operator-() const { return {-x, -y, -z}; }
  Vector operator*(const Number& s) const { return {x * s, y * s, z * s}; }
  bool zero() const { return !x.sign() && !y.sign() && !z.sign(); }

  // A direction near its own, of a length that doubles hold: each component is within 2^-51 of the
  // largest. Not of zero.
  Vec3<double> rounded() const {
    long most = 0;
    bool first = true;
    for (const Number* c : {&x, &y, &z})
      if (c->sign() && (first || c->bits() > most)) most = c->bits(), first = false;
    return {x.rounded(most), y.rounded(most), z.rounded(most)};
  }
};

inline Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// N(q), the rotation times |q|^2, by rows.
inline void turning(const double (&q)[4], Vector (&rows)[3]) {
  const Number w(q[0]), x(q[1]), y(q[2]), z(q[3]), v(2 * q[0]), s(2 * q[1]), t(2 * q[2]);
  const Number ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const Number xy = s * y, xz = s * z, yz = t * z, wx = v * x, wy = v * y, wz = v * z;
  rows[0] = {ww + xx - yy - zz, xy - wz, xz + wy};
  rows[1] = {xy + wz, ww - xx + yy - zz, yz - wx};
  rows[2] = {xz - wy, yz + wx, ww - xx - yy + zz};
}

}  // namespace ofg::verified
