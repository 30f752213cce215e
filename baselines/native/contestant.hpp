// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// An engine in a mode, with the blocks of cases that it answers, built of them alone.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>

#include "case_file.hpp"
#include "units.hpp"

namespace lane {

using Clock = std::chrono::steady_clock;

struct Contestant {
  Engine* engine;
  Mode mode;
  std::vector<std::size_t> blocks;  // first cases of those it answers
  long long build;                  // nanoseconds, all bodies and cases
  std::size_t bodies;               // that it was built of
  std::vector<Verdict> verdicts;
  std::vector<long long> times;  // round by round, block by block; -1 where it took no part
  bool slow = false;             // takes part in the first, the middle and the last round alone
};

// The blocks of which the engine answers every case.
inline std::vector<std::size_t> blocks_of(const Engine& engine, const CaseFile& file) {
  const auto takes = [&](const Case& c) {
    const Body &a = file.bodies[c.a], &b = file.bodies[c.b];
    const bool taken = a.convex && b.convex                   ? engine.takes_hulls()
                       : a.pieces.empty() && b.pieces.empty() ? engine.takes_meshes()
                                                              : engine.takes_unions();
    return engine.answers(c.question) && taken;
  };
  std::vector<std::size_t> blocks;
  for (std::size_t i = 0; i < file.cases.size(); i += file.block) {
    const auto first = file.cases.begin() + std::ptrdiff_t(i);
    if (std::all_of(first, first + file.block, takes)) blocks.push_back(i);
  }
  return blocks;
}

struct Built {
  long long ns = -1;
  std::size_t bodies = 0;
};

// Builds an engine of its cases alone: others may be of bodies that it refuses.
inline Built built(Engine& engine, const CaseFile& file, const std::vector<std::size_t>& blocks) {
  std::vector<Case> cases = file.cases;
  std::vector<bool> mine(cases.size());
  for (const std::size_t first : blocks)
    for (std::size_t i = 0; i < file.block; ++i) mine[first + i] = true;
  const Case& stand_in = cases[blocks.front()];
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (!mine[i]) cases[i] = stand_in;
  // Bodies that no case of its own names are not for it to build.
  std::vector<Body> bodies;
  std::vector<std::uint32_t> place(file.bodies.size(), std::uint32_t(-1));
  for (auto& c : cases)
    for (auto* body : {&c.a, &c.b}) {
      if (place[*body] == std::uint32_t(-1)) {
        place[*body] = std::uint32_t(bodies.size());
        bodies.push_back(file.bodies[*body]);
      }
      *body = place[*body];
    }
  const auto known = file.lengths.find(engine.asked_as());
  engine.length = known == file.lengths.end() ? 0 : known->second;
  const auto start = Clock::now();
  if (engine.length > 0) {
    const Units units(bodies, cases, engine.length);
    engine.build(units.bodies, units.cases);
  } else {
    engine.build(bodies, cases);
  }
  return {std::chrono::nanoseconds(Clock::now() - start).count(), bodies.size()};
}

inline std::vector<Contestant> contestants_of(const Engines& engines, const CaseFile& file,
                                              const std::vector<Mode>& modes) {
  std::vector<Contestant> all;
  for (const auto& engine : engines) {
    auto blocks = blocks_of(*engine, file);
    Built build;
    for (const Mode mode : modes) {
      if (blocks.empty() || !engine->stands(mode)) continue;
      if (build.ns < 0) {
        build = built(*engine, file, blocks);
        std::erase_if(blocks, [&](std::size_t first) {
          for (std::size_t i = 0; i < file.block; ++i)
            if (engine->refuses(first + i)) return true;
          return false;
        });
        if (blocks.empty()) break;
      }
      Contestant one{engine.get(), mode, blocks, build.ns, build.bodies, {}, {}};
      one.verdicts.resize(blocks.size() * file.block);
      all.push_back(std::move(one));
    }
  }
  return all;
}

}  // namespace lane
