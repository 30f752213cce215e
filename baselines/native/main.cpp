// lane CASES FOLDER MODES WARMUP ROUNDS PLUGIN... : time every engine on every case.
//
// MODES: names of lane::Mode with commas between them. In a round every contestant (an engine in a
// mode) is asked all its cases, after calls that are not timed, so that poses are cycled and each
// finds its own code in the caches; their order is shuffled anew each round. What is timed together
// is a block of cases. FOLDER gets three CSV files: contestants, answers and times.
#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <random>
#include <sstream>

#include "case_file.hpp"
#include "units.hpp"

namespace {

using lane::fail;
using Clock = std::chrono::steady_clock;

// What a call through the interface and two looks at the clock cost: to be subtracted from others.
struct Floor final : lane::Engine {
  Floor() : Engine("(floor)") { isa = build_of = ""; }
  bool answers(lane::Question) const override { return true; }
  bool stands(lane::Mode) const override { return true; }
  bool takes_meshes() const override { return true; }
  void build(const std::vector<lane::Body>&, const std::vector<lane::Case>&) override {}
  lane::Verdict ask(std::size_t) override { return {false}; }
};

// The same arithmetic every time: how much its time varies is how much the machine was disturbed.
struct Probe final : lane::Engine {
  volatile double kept = 1;
  Probe() : Engine("(noise probe)") { isa = build_of = ""; }
  bool answers(lane::Question) const override { return true; }
  bool takes_meshes() const override { return true; }
  void build(const std::vector<lane::Body>&, const std::vector<lane::Case>&) override {}
  lane::Verdict ask(std::size_t) override {
    double x = kept;
    for (int i = 0; i < 500; ++i) x = 0.999 * x + 1e-3;  // each waits for the one before
    kept = x;
    return {false};
  }
};

struct Contestant {
  lane::Engine* engine;
  lane::Mode mode;
  std::vector<std::size_t> blocks;  // first cases of those it answers
  long long build;                  // nanoseconds, all cases
  std::vector<lane::Verdict> verdicts;
  std::vector<long long> times;     // round by round
};

const char* const names[] = {"cold", "warm", "batch", "coherent"};

std::vector<lane::Mode> modes_of(const std::string& words) {
  std::vector<lane::Mode> modes;
  std::istringstream in(words);
  for (std::string word; std::getline(in, word, ',');) {
    const auto* found = std::find(std::begin(names), std::end(names), word);
    if (found == std::end(names)) fail("there is no mode " + word + ".");
    modes.push_back(lane::Mode(found - names));
  }
  return modes;
}

lane::Engines opened(int n, char** plugins) {
  lane::Engines engines;
  engines.push_back(std::make_unique<Floor>());
  engines.push_back(std::make_unique<Probe>());
  for (int i = 0; i < n; ++i) {
    void* plugin = dlopen(plugins[i], RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
    void* made = plugin ? dlsym(plugin, "lane_engines") : nullptr;
    if (!made) fail(std::string("plugin ") + plugins[i] + " does not open: " + dlerror());
    reinterpret_cast<decltype(&lane_engines)>(made)(engines);
  }
  return engines;
}

// The blocks of which the engine answers every case.
std::vector<std::size_t> blocks_of(const lane::Engine& engine, const lane::CaseFile& file) {
  const auto takes = [&](const lane::Case& c) {
    const bool hulls = file.bodies[c.a].convex && file.bodies[c.b].convex;
    return engine.answers(c.question) && (hulls || engine.takes_meshes());
  };
  std::vector<std::size_t> blocks;
  for (std::size_t i = 0; i < file.cases.size(); i += file.block) {
    const auto first = file.cases.begin() + std::ptrdiff_t(i);
    if (std::all_of(first, first + file.block, takes)) blocks.push_back(i);
  }
  return blocks;
}

// Builds an engine of its cases alone: others may be of bodies that it refuses.
long long built(lane::Engine& engine, const lane::CaseFile& file,
                const std::vector<std::size_t>& blocks) {
  std::vector<lane::Case> cases = file.cases;
  std::vector<bool> mine(cases.size());
  for (const std::size_t first : blocks)
    for (std::size_t i = 0; i < file.block; ++i) mine[first + i] = true;
  const lane::Case& stand_in = cases[blocks.front()];
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (!mine[i]) cases[i] = stand_in;
  // Bodies that no case of its own names are not for it to build.
  std::vector<lane::Body> bodies;
  std::vector<std::uint32_t> place(file.bodies.size(), std::uint32_t(-1));
  for (auto& c : cases)
    for (auto* body : {&c.a, &c.b}) {
      if (place[*body] == std::uint32_t(-1)) {
        place[*body] = std::uint32_t(bodies.size());
        bodies.push_back(file.bodies[*body]);
      }
      *body = place[*body];
    }
  const auto known = file.lengths.find(engine.name.substr(0, engine.name.find(' ')));
  engine.length = known == file.lengths.end() ? 0 : known->second;
  const auto start = Clock::now();
  if (engine.length > 0) {
    const lane::Units units(bodies, cases, engine.length);
    engine.build(units.bodies, units.cases);
  } else {
    engine.build(bodies, cases);
  }
  return std::chrono::nanoseconds(Clock::now() - start).count();
}

std::vector<Contestant> contestants_of(const lane::Engines& engines, const lane::CaseFile& file,
                                       const std::vector<lane::Mode>& modes) {
  std::vector<Contestant> all;
  for (const auto& engine : engines) {
    auto blocks = blocks_of(*engine, file);
    long long build = -1;
    for (const lane::Mode mode : modes) {
      if (blocks.empty() || !engine->stands(mode)) continue;
      if (build < 0) {
        build = built(*engine, file, blocks);
        std::erase_if(blocks, [&](std::size_t first) {
          for (std::size_t i = 0; i < file.block; ++i)
            if (engine->refuses(first + i)) return true;
          return false;
        });
        if (blocks.empty()) break;
      }
      Contestant one{engine.get(), mode, blocks, build, {}, {}};
      one.verdicts.resize(blocks.size() * file.block);
      all.push_back(std::move(one));
    }
  }
  return all;
}

void ask_block(Contestant& c, std::size_t first, std::size_t block, lane::Verdict* to) {
  if (c.mode == lane::Mode::batch)
    c.engine->ask_many(first, block, to);
  else
    for (std::size_t i = 0; i < block; ++i) to[i] = c.engine->ask(first + i);
}

// Calls that are not timed: they meet caches full of another contestant. Cold, its code comes in by
// one of them; else its bodies do, by blocks from the last on, for some milliseconds at most.
void warm_up(Contestant& c, std::size_t block) {
  c.engine->turn();
  c.engine->forget();
  if (c.mode == lane::Mode::cold) {
    c.engine->ask(c.blocks.back() + block - 1);
    return;
  }
  std::vector<lane::Verdict> nowhere(block);
  const auto start = Clock::now();
  for (auto first = c.blocks.rbegin(); first != c.blocks.rend(); ++first) {
    c.engine->forget();
    ask_block(c, *first, block, nowhere.data());
    if (Clock::now() - start > std::chrono::milliseconds(3)) return;
  }
}

void take_turn(Contestant& c, std::size_t block, bool timed) {
  warm_up(c, block);
  lane::Verdict* to = c.verdicts.data();
  for (const std::size_t first : c.blocks) {
    c.engine->forget();
    const auto start = Clock::now();
    ask_block(c, first, block, to);
    const auto end = Clock::now();
    to += block;
    if (timed) c.times.push_back(std::chrono::nanoseconds(end - start).count());
  }
}

std::FILE* csv(const std::string& folder, const char* name) {
  std::FILE* out = std::fopen((folder + "/" + name + ".csv").c_str(), "w");
  if (!out) fail(folder + "/" + name + ".csv cannot be written.");
  return out;
}

void write(const std::string& folder, const std::vector<Contestant>& all, std::size_t block,
           int rounds) {
  std::FILE *who = csv(folder, "contestants"), *said = csv(folder, "answers"),
            *took = csv(folder, "times");
  std::fprintf(who, "id,engine,isa,build,mode,build_ns\n");
  std::fprintf(said, "id,case,hit,time\n");
  std::fprintf(took, "id,block,queries");
  for (int r = 0; r < rounds; ++r) std::fprintf(took, ",round%d", r);
  for (std::size_t id = 0; id < all.size(); ++id) {
    const Contestant& c = all[id];
    std::fprintf(who, "%zu,\"%s\",%s,\"%s\",%s,%lld\n", id, c.engine->name.c_str(),
                 c.engine->isa.c_str(), c.engine->build_of.c_str(), names[int(c.mode)], c.build);
    for (std::size_t i = 0; i < c.verdicts.size(); ++i)
      std::fprintf(said, "%zu,%zu,%d,%.17g\n", id, c.blocks[i / block] + i % block,
                   int(c.verdicts[i].hit), c.verdicts[i].time);
    for (std::size_t i = 0; i < c.blocks.size(); ++i) {
      std::fprintf(took, "\n%zu,%zu,%zu", id, c.blocks[i], block);
      for (int r = 0; r < rounds; ++r)
        std::fprintf(took, ",%lld", c.times[std::size_t(r) * c.blocks.size() + i]);
    }
  }
  std::fprintf(took, "\n");
  for (std::FILE* file : {who, said, took}) std::fclose(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) fail("give CASES FOLDER MODES WARMUP ROUNDS and the plugins.");
  const lane::CaseFile file = lane::read_case_file(argv[1]);
  const int warmup = std::atoi(argv[4]), rounds = std::atoi(argv[5]);
  const lane::Engines engines = opened(argc - 6, argv + 6);
  std::vector<Contestant> all = contestants_of(engines, file, modes_of(argv[3]));
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(0);
  for (int round = 0; round < warmup + rounds; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t turn : order) take_turn(all[turn], file.block, round >= warmup);
  }
  write(argv[2], all, file.block, rounds);
}
