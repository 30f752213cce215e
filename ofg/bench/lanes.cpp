// Engines of the native lane (baselines/native) as methods of this bench: Coal and parry have no other program.
#include <dlfcn.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bench.hpp"
#include "lane.hpp"

namespace {

lane::Body body(const Hull& h) { return {h.v, h.f}; }

lane::Pose pose(const double* p) {
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
  return {{p[0] / length, p[1] / length, p[2] / length, p[3] / length}, {p[4], p[5], p[6]}};
}

std::vector<lane::Case> cases_of(const Cell& cell) {
  std::vector<lane::Case> cases;
  for (const double* p = cell.poses.data(); p < cell.poses.data() + cell.poses.size(); p += 14)
    cases.push_back({0, 1, lane::Question::overlap, pose(p), pose(p + 7), {}, {}, 0});
  return cases;
}

lane::Engines opened(const char* path) {
  lane::Engines engines;
  void* plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  auto* make = plugin ? reinterpret_cast<decltype(&lane_engines)>(dlsym(plugin, "lane_engines")) : nullptr;
  if (!make) std::fprintf(stderr, "bench: plugin %s does not open: %s\n", path, dlerror()), std::exit(2);
  make(engines);
  return engines;
}

}  // namespace

std::vector<Timed> lane_methods(const Cell& cell, const std::vector<const char*>& plugins) {
  std::vector<Timed> out;
  for (const char* path : plugins)
    for (auto& made : opened(path)) {
      const std::shared_ptr<lane::Engine> engine = std::move(made);
      if (!engine->answers(lane::Question::overlap) || engine->name.ends_with("-mesh")) continue;
      engine->build({body(cell.a), body(cell.b)}, cases_of(cell));
      out.push_back({engine->name, [engine](const Cell& c) {
                       long hits = 0;
                       for (std::size_t i = 0; i < c.size(); ++i) hits += engine->ask(i).hit;
                       return hits;
                     }});
    }
  return out;
}
