// bench CELLS ROUNDS [ISA|-] [PLUGIN...]: times every method on every cell, interleaved, and prints "cell,method,round,nanoseconds,hits" a line.
// CELLS is what experiments/bench_ofg.py writes: per cell a line with its name and sizes, then the numbers.
#include "bench.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "ofg/batch.hpp"
#include "ofg/brute_force.hpp"

namespace {

Hull read_hull(std::istream& in) {
  std::size_t n, m;
  in >> n >> m;
  Hull h{std::vector<double>(3 * n), std::vector<std::int32_t>(3 * m)};
  for (auto& x : h.v) in >> x;
  for (auto& i : h.f) in >> i;
  return h;
}

template <class T>
ofg::Body<T> convex(const Hull& h) {
  ofg::Body<T> body;
  body.whole = ofg::Mesh<T>(h.v.data(), h.v.size() / 3, h.f.data(), h.f.size() / 3, true);
  body.close();
  return body;
}

template <class T>
struct Bodies {
  ofg::Body<T> a, b;
  ofg::Workspace<T> w;
  std::vector<ofg::Pose> poses_a, poses_b;
  std::vector<ofg::Answer> answers;
  explicit Bodies(const Cell& c) : a(convex<T>(c.a)), b(convex<T>(c.b)), answers(c.size()) {
    w.reserve(a, b);
    for (const double* p = c.poses.data(); p < c.poses.data() + c.poses.size(); p += 14) {
      poses_a.push_back({{p[0], p[1], p[2], p[3]}, {p[4], p[5], p[6]}});
      poses_b.push_back({{p[7], p[8], p[9], p[10]}, {p[11], p[12], p[13]}});
    }
  }
};

template <int Last, class T>
Timed ofg_method(const std::string& name, const std::shared_ptr<Bodies<T>>& bodies, const ofg::Options& o) {
  return {name, [=](const Cell& c) {
            long hits = 0;
            for (std::size_t i = 0; i < c.size(); ++i)
              hits +=
                  ofg::overlap<Last>(bodies->a.whole, bodies->b.whole, {bodies->poses_a[i], bodies->poses_b[i]}, o, bodies->w).hit;
            return hits;
          }};
}

// The same questions in one call.
template <class T>
Timed batched(const std::string& name, const std::shared_ptr<Bodies<T>>& bodies, const ofg::Options& o) {
  return {name, [=](const Cell& c) {
            ofg::overlap_many(bodies->a, bodies->b, bodies->poses_a.data(), bodies->poses_b.data(), c.size(), o, bodies->w,
                              bodies->answers.data());
            long hits = 0;
            for (const auto& answer : bodies->answers) hits += answer.hit;
            return hits;
          }};
}

template <class T>
void ofg_methods(const Cell& c, const std::string& precision, std::vector<Timed>& out) {
  const auto bodies = std::make_shared<Bodies<T>>(c);
  for (int k : {4, 8, 16}) {
    ofg::Options o;
    o.k = k;
    const std::string name = "OFG " + precision + " k=" + std::to_string(k);
    out.push_back(ofg_method<1, T>(name + " to step 1", bodies, o));
    out.push_back(ofg_method<3, T>(name + " to step 3", bodies, o));
    out.push_back(ofg_method<6, T>(name + " to step 6", bodies, o));
    out.push_back(ofg_method<8, T>(name, bodies, o));
    o.screen = true;
    out.push_back(ofg_method<8, T>(name + " screened", bodies, o));
    out.push_back(batched<T>(name + " screened in batch", bodies, o));
  }
  ofg::Options all;
  all.k = 1 << 30;
  if (c.a.f.size() <= 3 * 320) out.push_back(ofg_method<8, T>("OFG " + precision + " k=all", bodies, all));
  ofg::Options repaired;
  repaired.adaptive_k = repaired.containment = true, repaired.nearest = ofg::Nearest::triangle;
  out.push_back(ofg_method<8, T>("OFG " + precision + " repaired", bodies, repaired));
  repaired.screen = true;
  out.push_back(batched<T>("OFG " + precision + " repaired screened in batch", bodies, repaired));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: bench CELLS ROUNDS [sse2|avx2|avx512|-] [PLUGIN...]\n"), 2;
  if (argc > 3 && argv[3] != std::string("-")) {
    const std::string isa = argv[3];
    if (!ofg::set_isa(isa == "sse2" ? ofg::Isa::sse2 : isa == "avx2" ? ofg::Isa::avx2 : ofg::Isa::avx512))
      return std::fprintf(stderr, "this machine lacks %s\n", argv[3]), 2;
  }
  const std::vector<const char*> plugins(argv + std::min(argc, 4), argv + argc);
  std::ifstream in(argv[1]);
  const int rounds = std::atoi(argv[2]);
  std::printf("cell,method,round,nanoseconds,hits\n");
  std::size_t pairs;
  for (Cell cell; in >> cell.name >> pairs;) {
    cell.a = read_hull(in), cell.b = read_hull(in);
    cell.poses.resize(14 * pairs);
    for (auto& x : cell.poses) in >> x;
    std::vector<Timed> methods;
    ofg_methods<double>(cell, "double", methods);
    ofg_methods<float>(cell, "float", methods);
    const auto add = [&](std::vector<Timed> more) { methods.insert(methods.end(), more.begin(), more.end()); };
#ifdef HAS_FCL
    add(fcl_methods(cell));
#endif
#ifdef HAS_BULLET
    add(bullet_methods(cell));
#endif
#ifdef HAS_MUJOCO
    add(mujoco_methods(cell));
#endif
    add(lane_methods(cell, plugins));
    for (int round = -1; round < rounds; ++round)  // the first warms up
      for (const auto& method : methods) {
        const auto from = std::chrono::steady_clock::now();
        const long hits = method.ask_all(cell);
        const double ns =
            std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - from).count() / double(cell.size());
        if (round >= 0) std::printf("%s,%s,%d,%.1f,%ld\n", cell.name.c_str(), method.name.c_str(), round, ns, hits);
      }
    std::fflush(stdout);
  }
}
