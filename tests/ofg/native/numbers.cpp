// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Identities of exact numbers, from such as fit in the object to such as do not, through copies and
// moves. Prints how many of either length were made, and fails where an identity does not hold.
#include <cstdio>
#include <random>
#include <utility>

#include "ofg/verified_number.hpp"

using ofg::verified::Number;

static bool same(const Number& a, const Number& b) { return (a - b).sign() == 0; }

// Which of two is larger, through other objects.
static int order(Number a, const Number& b) {
  Number c = a;
  c = std::move(a);
  a = c, c = b;
  return (a - c).sign();
}

int main() {
  std::mt19937_64 random(1);
  long shorter = 0, longer = 0;
  for (int i = 0; i < 20000; ++i) {
    const int spread = i % 4 == 0 ? 900 : i % 60;
    std::uniform_real_distribution<double> u(-1, 1);
    const auto draw = [&] { return std::ldexp(u(random), int(spread * u(random))); };
    const double p = draw(), q = draw(), r = i % 7 ? draw() : 0;
    const Number x(p), y(q), z(r), two(2.0);
    const Number square = x * x - y * y, cube = (x + y) * (x - y) * (x + z);
    bool right = same((x + y) * (x - y), square) && same(cube, square * (x + z)) &&
                 same((x + y) + z, x + (y + z)) && same(x * (y + z), x * y + x * z) &&
                 same(cube + cube, two * cube) && same(-(-cube), cube) && (cube - cube).sign() == 0;
    right = right && order(x, y) == (p > q) - (p < q) && order(y, z) == (q > r) - (q < r) &&
            order(cube, cube * two) == -cube.sign() &&
            cube.sign() == square.sign() * (x + z).sign() && (x * x + y * y).sign() > 0;
    if (!right) {
      std::printf("an identity does not hold of %a, %a, %a\n", p, q, r);
      return 1;
    }
    (spread == 900 ? longer : shorter) += 1;
  }
  std::printf("%ld shorter, %ld longer\n", shorter, longer);
  return 0;
}
