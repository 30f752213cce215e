// lane CASES RESULTS WARMUP ROUNDS PLUGIN... : time every engine on every case.
//
// Rounds, as in the Python lane: in each, every engine is asked all its cases one after the other, so that poses are cycled and each engine
// finds its own code in the caches, after a call that is not timed; their order is shuffled anew each round. RESULTS is CSV: engine, case, hit, time, the build's nanoseconds
// (of the engine, all cases), and the nanoseconds of each round.
#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <numeric>
#include <random>

#include "lane.hpp"

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const std::string& what) {
  std::cerr << "lane: " << what << "\n";
  std::exit(2);
}

struct Reader {
  std::ifstream in;
  template <class T>
  T one() {
    T x;
    many(&x, 1);
    return x;
  }
  template <class T>
  void many(T* to, std::size_t n) {
    if (!in.read(reinterpret_cast<char*>(to), std::streamsize(n * sizeof(T)))) fail("the case file ends too early; write it anew.");
  }
};

lane::Pose read_pose(Reader& r) {
  lane::Pose pose;
  r.many(pose.q.data(), 4);
  r.many(pose.p.data(), 3);
  const auto [w, x, y, z] = pose.q;
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  for (double& c : pose.q) c /= length;
  return pose;
}

void read_cases(const char* path, std::vector<lane::Body>& bodies, std::vector<lane::Case>& cases) {
  Reader r{std::ifstream(path, std::ios::binary)};
  if (!r.in) fail(std::string("case file ") + path + " cannot be read.");
  char magic[8];
  r.many(magic, 8);
  if (std::string(magic, 8) != "OFGLANE1") fail(std::string(path) + " is no case file of the native lane; baselines.native writes them.");
  bodies.resize(r.one<std::uint32_t>());
  cases.resize(r.one<std::uint32_t>());
  for (auto& body : bodies) {
    body.vertices.resize(3 * std::size_t(r.one<std::uint32_t>()));
    body.faces.resize(3 * std::size_t(r.one<std::uint32_t>()));
    r.many(body.vertices.data(), body.vertices.size());
    r.many(body.faces.data(), body.faces.size());
  }
  for (auto& c : cases) {
    c.a = r.one<std::uint32_t>(), c.b = r.one<std::uint32_t>();
    c.question = lane::Question(r.one<std::uint32_t>());
    if (c.a >= bodies.size() || c.b >= bodies.size()) fail("a case names a body that is not in the file; write it anew.");
    c.pose_a = read_pose(r), c.pose_b = read_pose(r);
    r.many(c.displacement.data(), 3);
    r.many(c.axis.data(), 3);
    c.angle = r.one<double>();
    const auto [x, y, z] = c.axis;
    if (const double length = std::sqrt(x * x + y * y + z * z); length > 0)
      for (double& k : c.axis) k /= length;
  }
}

// What a call through the interface and two looks at the clock cost: to be subtracted from every other engine.
struct Floor final : lane::Engine {
  Floor() : Engine("(floor)") {}
  bool answers(lane::Question) const override { return true; }
  void build(const std::vector<lane::Body>&, const std::vector<lane::Case>&) override {}
  lane::Verdict ask(std::size_t) override { return {false}; }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) fail("give CASES RESULTS WARMUP ROUNDS and the plugins.");
  std::vector<lane::Body> bodies;
  std::vector<lane::Case> cases;
  read_cases(argv[1], bodies, cases);
  const int warmup = std::atoi(argv[3]), rounds = std::atoi(argv[4]);

  lane::Engines engines;
  engines.push_back(std::make_unique<Floor>());
  for (int i = 5; i < argc; ++i) {
    void* plugin = dlopen(argv[i], RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
    auto* make = plugin ? reinterpret_cast<decltype(&lane_engines)>(dlsym(plugin, "lane_engines")) : nullptr;
    if (!make) fail(std::string("plugin ") + argv[i] + " does not open: " + dlerror());
    make(engines);
  }

  struct Lane {
    lane::Engine* engine;
    std::vector<std::size_t> mine;  // cases it answers
    long long build;
    std::vector<lane::Verdict> verdicts;
    std::vector<long long> times;  // round by round
  };
  std::vector<Lane> lanes;
  for (auto& engine : engines) {
    Lane one{engine.get(), {}, 0, {}, {}};
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (engine->answers(cases[i].question)) one.mine.push_back(i);
    const auto start = Clock::now();
    engine->build(bodies, cases);
    one.build = std::chrono::nanoseconds(Clock::now() - start).count();
    one.verdicts.resize(one.mine.size());
    one.times.reserve(one.mine.size() * rounds);
    lanes.push_back(std::move(one));
  }
  std::vector<std::size_t> order(lanes.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(0);
  for (int round = 0; round < warmup + rounds; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t turn : order) {
      Lane& lane = lanes[turn];
      if (!lane.mine.empty()) lane.engine->ask(lane.mine.back());
      for (std::size_t i = 0; i < lane.mine.size(); ++i) {
        const auto start = Clock::now();
        const lane::Verdict verdict = lane.engine->ask(lane.mine[i]);
        const auto end = Clock::now();
        lane.verdicts[i] = verdict;
        if (round >= warmup) lane.times.push_back(std::chrono::nanoseconds(end - start).count());
      }
    }
  }

  std::FILE* out = std::fopen(argv[2], "w");
  if (!out) fail(std::string("results file ") + argv[2] + " cannot be written.");
  std::fprintf(out, "engine,case,hit,time,build");
  for (int r = 0; r < rounds; ++r) std::fprintf(out, ",round%d", r);
  for (const Lane& lane : lanes)
    for (std::size_t i = 0; i < lane.mine.size(); ++i) {
      std::fprintf(out, "\n%s,%zu,%d,%.17g,%lld", lane.engine->name.c_str(), lane.mine[i], int(lane.verdicts[i].hit), lane.verdicts[i].time, lane.build);
      for (int r = 0; r < rounds; ++r) std::fprintf(out, ",%lld", lane.times[r * lane.mine.size() + i]);
    }
  std::fprintf(out, "\n");
  std::fclose(out);
}
