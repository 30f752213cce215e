// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Nanoseconds a sweep of verified OFG: medians over passes of 512 random pairs a cell whose spheres
// meet on the way, hits and misses apart. Usage: bench_sweep [passes] [isa],
// with isa 0, 1 or 2 for SSE2, AVX2 or AVX-512.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "ofg/verified_sweep.hpp"
#include "shapes.hpp"

namespace {

using Random = std::mt19937_64;
using Vec = ofg::Vec3<double>;
using ofg::verified::Hull;
using ofg::verified::Impact;

struct Query {
  const Hull *a, *b;
  ofg::Pose pose_a, pose_b;
  ofg::Motion by_a, by_b;
  Impact operator()() const { return ofg::verified::sweep(*a, *b, pose_a, pose_b, by_a, by_b); }
};

double uniform(Random& r, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(r);
}
Vec direction(Random& r) {
  std::normal_distribution<double> n;
  const Vec v(n(r), n(r), n(r));
  return v * (1 / length(v));
}

// A sphere of rings by sides, each corner moved along its ray only so little that all stay corners.
Hull body(Random& r, int rings, int sides) {
  const Shape s = sphere(rings, sides, rings > 4 ? 0.01 : 0.1, 1, 1, 1, r);
  return Hull(ofg::Mesh<double>(s.v.data(), s.v.size() / 3, s.f.data(), s.f.size() / 3, true));
}

Hull cube() {
  static constexpr int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                       {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                       {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  std::vector<Vec> v;
  for (int i = 0; i < 8; ++i) v.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  std::vector<std::array<int, 3>> f;
  for (const auto& c : faces) f.push_back({c[0], c[1], c[2]});
  return Hull(v, f);
}

// A passes B by at a distance at which their spheres meet; clear at the start.
std::vector<Query> queries(Random& r, const std::vector<Hull>& hulls, double angle, bool both,
                           bool hits) {
  std::vector<Query> all;
  while (all.size() < 512) {
    const Hull &a = hulls[r() % hulls.size()], &b = hulls[r() % hulls.size()];
    const double reach = a.radius + b.radius;
    const Vec way = direction(r), aside = direction(r);
    const Vec off = aside - way * dot(aside, way);
    Query q{&a, &b, {}, {}, {}, {}};
    for (auto* p : {&q.pose_a, &q.pose_b})
      for (auto& c : p->q) c = uniform(r, -1, 1);
    q.pose_a.p = way * (-1.05 * reach) + off * (uniform(r, 0, reach) / length(off));
    q.by_a = {way * (2.1 * reach), direction(r), angle, {}};
    if (both) q.by_b = {{}, direction(r), angle, {}};
    const Impact x = q();
    if (x.hit == hits && !(x.latest == 0)) all.push_back(q);
  }
  return all;
}

double nanoseconds(const std::vector<Query>& all, int passes) {
  std::vector<double> taken;
  double sum = 0;
  for (int i = 0; i < passes; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& q : all) sum += q().hit;
    taken.push_back(
        std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() /
        double(all.size()));
  }
  if (sum < 0) std::puts("");
  std::nth_element(taken.begin(), taken.begin() + passes / 2, taken.end());
  return taken[std::size_t(passes / 2)];
}

}  // namespace

int main(int argc, char** argv) {
  const int passes = argc > 1 ? std::atoi(argv[1]) : 15;
  if (argc > 2 && !ofg::set_isa(ofg::Isa(std::atoi(argv[2])))) return 1;
  Random random(1);
  const struct {
    const char* name;
    int rings, sides;
  } kinds[] = {{"12 cube", 0, 0},
               {"12 hull", 2, 6},
               {"80 hull", 6, 8},
               {"320 hull", 11, 16},
               {"1280 hull", 21, 32}};
  std::printf("ns, hits / misses; segments, supports of hits\n");
  for (const auto& kind : kinds) {
    std::vector<Hull> hulls;
    for (int i = 0; i < 16; ++i)
      hulls.push_back(kind.rings ? body(random, kind.rings, kind.sides) : cube());
    std::printf("%-9s", kind.name);
    for (const double angle : {0.0, 0.1, 0.5, 1.5, 6.0, -1.5}) {
      double ns[2], segments = 0, supports = 0;
      for (const bool hit : {true, false}) {
        const auto all = queries(random, hulls, angle, angle < 0, hit);
        ns[hit] = nanoseconds(all, passes);
        for (const auto& q : all) {
          const Impact x = q();
          if (hit) segments += double(x.counts.steps) - 1, supports += double(x.counts.full_tests);
        }
      }
      std::printf(" | %s%g: %5.0f / %5.0f (%.1f, %.1f)", angle < 0 ? "both " : "", std::abs(angle),
                  ns[1], ns[0], segments / 512, supports / 512);
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  return 0;
}
