// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The first contact of two moving bodies, between two times that are both proved.
#pragma once
#include "answer.hpp"

namespace ofg::verified {

constexpr double widest_bracket = 1e-9;  // of the step, where contact is not approached too slowly

// hit: the interiors meet within the step. `time` is the last time until which they are proved not
// to: never later than the first contact. `latest`: a time at which they are proved to meet; NaN
// without a hit, and where `proved` is false because no such time is known.
// proved: `hit` is proved, and the bracket no wider than widest_bracket. A clear always is.
struct Impact : Answer {
  double latest = std::numeric_limits<double>::quiet_NaN();
  bool proved = true;

  void set(double from, double to) {
    hit = true, time = from, latest = to;
    proved = to - from <= widest_bracket;
  }

  // Of an overlap at the start of the step.
  static Impact at_start(const Answer& overlap) {
    Impact impact;
    static_cast<Answer&>(impact) = overlap;
    impact.found = Found::start, impact.time = impact.latest = 0;
    return impact;
  }
};

}  // namespace ofg::verified
