// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// lane CASES FOLDER MODES WARMUP ROUNDS PLUGIN... : time every engine on every case.
//
// MODES: names of lane::Mode with commas between them. In a round every contestant (an engine in a
// mode) is asked all its cases, after calls that are not timed, so that poses are cycled and each
// finds its own code in the caches; their order is shuffled anew each round, and one that takes
// long for its turn takes part in three. What is timed together is a block of cases. FOLDER gets
// three CSV files: contestants, answers and times.
#include <dlfcn.h>

#include <algorithm>
#include <sstream>

#include "rounds.hpp"
#include "spheres.hpp"

namespace {

using lane::fail;

// What a call through the interface and two looks at the clock cost: to be subtracted from others.
struct Floor final : lane::Engine {
  Floor() : Engine("(floor)") { isa = build_of = ""; }
  bool answers(lane::Question) const override { return true; }
  bool stands(lane::Mode) const override { return true; }
  bool takes_meshes() const override { return true; }
  bool takes_unions() const override { return true; }
  void build(const std::vector<lane::Body>&, const std::vector<lane::Case>&) override {}
  lane::Verdict ask(std::size_t) override { return {false}; }
};

// The same arithmetic every time: how much its time varies is how much the machine was disturbed.
struct Probe final : lane::Engine {
  volatile double kept = 1;
  Probe() : Engine("(noise probe)") { isa = build_of = ""; }
  bool answers(lane::Question) const override { return true; }
  bool takes_meshes() const override { return true; }
  bool takes_unions() const override { return true; }
  void build(const std::vector<lane::Body>&, const std::vector<lane::Case>&) override {}
  lane::Verdict ask(std::size_t) override {
    double x = kept;
    for (int i = 0; i < 500; ++i) x = 0.999 * x + 1e-3;  // each waits for the one before
    kept = x;
    return {false};
  }
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
    const auto make = reinterpret_cast<decltype(&lane_engines)>(made);
    make(engines);
    lane::Engines again;  // of their own, as each is built of its cases
    make(again);
    for (auto& engine : again)
      if (lane::gets_spheres(engine->name))
        engines.push_back(std::make_unique<lane::Spheres>(std::move(engine)));
  }
  return engines;
}

std::FILE* csv(const std::string& folder, const char* name) {
  std::FILE* out = std::fopen((folder + "/" + name + ".csv").c_str(), "w");
  if (!out) fail(folder + "/" + name + ".csv cannot be written.");
  return out;
}

void write(const std::string& folder, const std::vector<lane::Contestant>& all, std::size_t block,
           int rounds) {
  std::FILE *who = csv(folder, "contestants"), *said = csv(folder, "answers"),
            *took = csv(folder, "times");
  std::fprintf(who, "id,engine,isa,build,mode,build_ns,built,bytes\n");
  std::fprintf(said, "id,case,hit,time\n");
  std::fprintf(took, "id,block,queries");
  for (int r = 0; r < rounds; ++r) std::fprintf(took, ",round%d", r);
  for (std::size_t id = 0; id < all.size(); ++id) {
    const lane::Contestant& c = all[id];
    std::fprintf(who, "%zu,\"%s\",%s,\"%s\",%s,%lld,%zu,%lld\n", id, c.engine->name.c_str(),
                 c.engine->isa.c_str(), c.engine->build_of.c_str(), names[int(c.mode)], c.build,
                 c.bodies, c.engine->bytes());
    for (std::size_t i = 0; i < c.verdicts.size(); ++i)
      std::fprintf(said, "%zu,%zu,%d,%.17g\n", id, c.blocks[i / block] + i % block,
                   int(c.verdicts[i].hit), c.verdicts[i].time);
    for (std::size_t i = 0; i < c.blocks.size(); ++i) {
      std::fprintf(took, "\n%zu,%zu,%zu", id, c.blocks[i], block);
      for (int r = 0; r < rounds; ++r) {
        const long long ns = c.times[std::size_t(r) * c.blocks.size() + i];
        ns < 0 ? std::fprintf(took, ",") : std::fprintf(took, ",%lld", ns);
      }
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
  std::vector<lane::Contestant> all = lane::contestants_of(engines, file, modes_of(argv[3]));
  lane::take_rounds(all, file.block, warmup, rounds);
  write(argv[2], all, file.block, rounds);
}
