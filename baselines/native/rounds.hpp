// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The protocol of timing: interleaved rounds, in an order that is drawn anew for each.
#pragma once
#include <numeric>
#include <random>

#include "contestant.hpp"

namespace lane {

constexpr auto long_turn = std::chrono::milliseconds(500);  // from which on a contestant is slow

inline void ask_block(Contestant& c, std::size_t first, std::size_t block, Verdict* to) {
  if (c.mode == Mode::batch)
    c.engine->ask_many(first, block, to);
  else
    for (std::size_t i = 0; i < block; ++i) to[i] = c.engine->ask(first + i);
}

// Calls that are not timed: they meet caches full of another contestant. Cold, its code comes in by
// one of them; else its bodies do, by blocks from the last on, for some milliseconds at most.
inline void warm_up(Contestant& c, std::size_t block) {
  c.engine->turn();
  c.engine->forget();
  if (c.mode == Mode::cold) {
    c.engine->ask(c.blocks.back() + block - 1);
    return;
  }
  std::vector<Verdict> nowhere(block);
  const auto start = Clock::now();
  for (auto first = c.blocks.rbegin(); first != c.blocks.rend(); ++first) {
    c.engine->forget();
    ask_block(c, *first, block, nowhere.data());
    if (Clock::now() - start > std::chrono::milliseconds(3)) return;
  }
}

// took: where the nanoseconds of its blocks are to stand.
inline void take_turn(Contestant& c, std::size_t block, long long* took) {
  const auto begin = Clock::now();
  warm_up(c, block);
  Verdict* to = c.verdicts.data();
  for (const std::size_t first : c.blocks) {
    c.engine->forget();
    const auto start = Clock::now();
    ask_block(c, first, block, to);
    const auto end = Clock::now();
    to += block;
    *took++ = std::chrono::nanoseconds(end - start).count();
  }
  c.slow = Clock::now() - begin > long_turn;
}

// Rounds below 0 warm up, and are not kept.
inline void take_rounds(std::vector<Contestant>& all, std::size_t block, int warmup, int rounds) {
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(0);
  for (Contestant& c : all) c.times.assign(std::size_t(rounds) * c.blocks.size(), -1);
  for (int round = -warmup; round < rounds; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t turn : order) {
      Contestant& c = all[turn];
      const bool needed = round == 0 || round == rounds / 2 || round == rounds - 1;
      if (c.slow && !needed) continue;
      std::vector<long long> nowhere(c.blocks.size());
      const std::size_t place = std::size_t(std::max(round, 0)) * c.blocks.size();
      take_turn(c, block, round < 0 ? nowhere.data() : &c.times[place]);
    }
  }
}

}  // namespace lane
