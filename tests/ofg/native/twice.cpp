// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// How far sums, differences, products and quotients of twice the digits are off, at most, in
// shares of the bound that verified_twice.hpp states: against 113 bits. Prints each, and fails
// where one exceeds the bound.
#include <cstdio>
#include <random>

#include "ofg/verified_twice.hpp"

__extension__ typedef __float128 Quad;
using ofg::verified::Twice;

static Quad value(const Twice& x) { return Quad(x.high) + Quad(x.low); }

static double share(const Twice& got, Quad wanted) {
  const Quad off = value(got) - wanted;
  if (off == 0) return 0;
  const double part = double(off / wanted);
  return (part < 0 ? -part : part) / ofg::verified::twice_roundoff;
}

int main() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  // The second part within 6 bits of the most it can be, so that 113 bits hold both.
  const auto draw = [&](int exponent) {
    const double high = std::ldexp(u(random), exponent);
    const double last = std::ldexp(1, std::ilogb(high) - 53);
    return ofg::verified::exact_sum(high, last * u(random));
  };
  double worst[4] = {};
  for (int i = 0; i < 2000000; ++i) {
    const Twice x = draw(i % 40 - 20);
    // Of like size and opposite sign too, so that sums cancel.
    Twice y = i % 3 ? draw(i % 7 - 3) : Twice(-x.high * (1 + std::ldexp(u(random), -(i % 50))));
    if (y.high == 0 || x.high == 0) continue;
    const Quad a = value(x), b = value(y);
    const double off[4] = {share(x + y, a + b), share(x - y, a - b), share(x * y, a * b),
                           share(x / y, a / b)};
    for (int k = 0; k < 4; ++k) worst[k] = off[k] > worst[k] ? off[k] : worst[k];
  }
  std::printf("sum %.3f difference %.3f product %.3f quotient %.3f of the bound\n", worst[0],
              worst[1], worst[2], worst[3]);
  for (const double w : worst)
    if (!(w < 1)) return 1;
  return 0;
}
