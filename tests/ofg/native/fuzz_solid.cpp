// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Random pairs of closed surfaces and unions through verified overlap. Surfaces are judged by
// judge_surface.hpp; solids of unit cells on a grid, whose faces mostly coincide, by their cells.
// Usage: fuzz_solid [queries] [seconds] [seed]. Prints the query and stops at the first fault; then
// the record.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "judge_surface.hpp"
#include "ofg/verified_solid.hpp"
#include "shapes.hpp"

namespace {

using Random = std::mt19937_64;
using ofg::verified::Hull;
using ofg::verified::Solid;
using V = ofg::Vec3<double>;

double uniform(Random& r, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(r);
}
int whole(Random& r, int a, int b) { return std::uniform_int_distribution<int>(a, b)(r); }

struct Tally {
  long done = 0, hits = 0, near = 0, exact = 0, inside = 0, cells = 0;
};

struct Skin {
  std::vector<V> v;
  judge::Faces f;
  double radius = 0;

  void add(const Shape& s, const V& at, double scale, bool inward) {
    const int n = int(v.size());
    for (std::size_t i = 0; i < s.v.size(); i += 3) {
      v.push_back(V(s.v[i], s.v[i + 1], s.v[i + 2]) * scale + at);
      radius = std::fmax(radius, ofg::length(v.back()));
    }
    for (std::size_t i = 0; i < s.f.size(); i += 3)
      f.push_back({n + s.f[i], n + s.f[i + (inward ? 2 : 1)], n + s.f[i + (inward ? 1 : 2)]});
  }
};

// Rough, thin, on a grid; in two shells, or with a cavity.
Skin skin(Random& r, bool grid) {
  const double size = grid || whole(r, 0, 1) ? 1 : uniform(r, 0.1, 1);
  const int rings = whole(r, 2, 6), sides = whole(r, 3, 7);
  const auto thin = [&] { return whole(r, 0, 4) || grid ? 1 : std::pow(10, uniform(r, -6, -1)); };
  const auto some = [&](double rough) {
    Shape s = sphere(rings, sides, rough, 1, thin(), thin(), r);
    if (grid)
      for (auto& x : s.v) x = std::round(3 * x);
    return s;
  };
  Skin made;
  const double rough = whole(r, 0, 2) ? uniform(r, 0, 0.5) : 0;
  made.add(some(rough), {}, size, false);
  const int shells = whole(r, 0, 3);
  if (shells == 0) made.add(some(0), {grid ? 8.0 : 2.5, 0, 0}, grid ? 1 : 0.2, false);
  if (shells == 1 && rough < 0.3 && !grid) made.add(some(0.1), {}, 0.2 * size, true);
  return made;
}

ofg::Pose pose(Random& r, bool grid, double reach, double far) {
  ofg::Pose p;
  for (auto& c : p.q) c = grid ? whole(r, -1, 1) : uniform(r, -1, 1);
  if (ofg::largest(V(p.q[1], p.q[2], p.q[3])) == 0) p.q[0] = 1;
  const auto at = [&] { return far + (grid ? whole(r, -3, 3) : reach * uniform(r, -1, 1)); };
  p.p = {at(), at(), at()};
  return p;
}

const char* answer(const Solid& a, const Solid& b, const ofg::Pose& p, const ofg::Pose& q,
                   Tally& tally, bool& hit) {
  for (const auto isa : {ofg::Isa::sse2, ofg::Isa::avx2}) {
    if (!ofg::set_isa(isa) || !ofg::set_boxes_isa(isa)) continue;
    const ofg::Answer x = ofg::verified::overlap(a, b, p, q);
    if (isa != ofg::Isa::sse2 && x.hit != hit) return "instruction sets disagree";
    hit = x.hit, tally.exact += x.counts.steps > 1;
    tally.inside += x.found == ofg::Found::inside;
    if (x.hit != (x.found != ofg::Found::nothing)) return "a hit that nothing made";
  }
  return nullptr;
}

// A goes along a direction until the two part, and a gap more or less.
void move_to_touch(Random& r, const Solid& a, const Solid& b, double reach, ofg::Pose& p,
                   const ofg::Pose& q) {
  V way(uniform(r, -1, 1), uniform(r, -1, 1), uniform(r, -1, 1));
  way = way * (1 / ofg::length(way));
  double near = 0, far = 3 * reach;
  const V from = q.p;
  for (int i = 0; i < 60; ++i) {
    const double middle = (near + far) / 2;
    p.p = from + way * middle;
    (ofg::verified::overlap(a, b, p, q).hit ? near : far) = middle;
  }
  const double gap = (whole(r, 0, 1) ? 1 : -1) * std::pow(10, uniform(r, -17, 0));
  p.p = from + way * (near + gap * reach);
}

const char* one_of_surfaces(Random& r, Tally& tally) {
  const bool grid = whole(r, 0, 3) == 0;
  const Skin s = skin(r, grid), t = skin(r, grid);
  const Solid a = Solid::closed(s.v, s.f), b = Solid::closed(t.v, t.f);
  const double reach = s.radius + t.radius;
  for (int i = 0; i < 4; ++i, ++tally.done) {
    const double far = whole(r, 0, 5) ? 0 : std::round(std::pow(10, uniform(r, 0, 5)));
    ofg::Pose p = pose(r, grid, reach / 2, far), q = pose(r, grid, reach / 2, far);
    if (whole(r, 0, 3) == 0) std::copy_n(q.q, 4, p.q);
    if (whole(r, 0, 9) == 0) p.p = q.p;
    if (!grid && whole(r, 0, 1)) move_to_touch(r, a, b, reach, p, q);
    bool hit = false, back = false;
    if (const char* f = answer(a, b, p, q, tally, hit)) return f;
    if (const char* f = answer(b, a, q, p, tally, back)) return f;
    const judge::Says says = judge::surfaces({s.v, t.v, p, q}, s.f, t.f);
    tally.hits += hit, tally.near += says == judge::Says::near;
    if (says == judge::Says::hit && !(hit && back)) return "a miss";
    if (says == judge::Says::clear && (hit || back)) return "a false alarm";
  }
  return nullptr;
}

// The sign of a determinant of points on a grid, of which some move with B, against the same with B
// moved by a little, in 113 bits.
const char* one_of_sides(Random& r) {
  static constexpr double e = 0x1p-20;
  V given[4];
  ofg::verified::Point points[4];
  judge::Point<judge::Quad> moved[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const bool moves = whole(r, 0, 1);
    const int x = whole(r, -2, 2), y = whole(r, -2, 2), z = whole(r, -1, 1);
    given[i] = V(x, y, z);
    points[i] = {given[i], &given[i], 1, moves, moves};
    const judge::Quad by = moves ? e : 0;
    moved[i] = {x + by, y + by * e, z + by * e * e};
  }
  const ofg::verified::Between at({}, 4, {}, 4, {}, {});
  ofg::verified::Sides sides({}, {}, at, true);
  const auto &a = moved[0], &b = moved[1], &c = moved[2], &d = moved[3];
  const judge::Quad det = judge::dot(judge::cross(b - a, c - a), d - a);
  const int said = sides(points[0], points[1], points[2], points[3]);
  return said == (det > 0) - (det < 0) ? nullptr : "a side of a plane";
}

// Unit cells of a grid, and the faces between those that are filled and those that are not.
struct Cells {
  std::set<std::array<int, 3>> filled;

  explicit Cells(Random& r) {
    const int n = whole(r, 1, 10);
    std::array<int, 3> at{};
    for (int i = 0; i < n; ++i) {
      if (whole(r, 0, 3))
        at[std::size_t(whole(r, 0, 2))] += whole(r, 0, 1) ? 1 : -1;
      else
        for (int& c : at) c = whole(r, -1, 1);
      filled.insert(at);
    }
    if (whole(r, 0, 4) == 0) {  // a cavity
      for (int x = -1; x < 2; ++x)
        for (int y = -1; y < 2; ++y)
          for (int z = -1; z < 2; ++z) filled.insert({x, y, z});
      filled.erase({0, 0, 0});
    }
  }

  Solid surface() const {
    std::vector<V> v;
    judge::Faces f;
    std::map<std::array<int, 3>, int> known;
    const auto vertex = [&](std::array<int, 3> at) {
      const auto [it, fresh] = known.insert({at, int(v.size())});
      if (fresh) v.push_back({at[0] - 0.5, at[1] - 0.5, at[2] - 0.5});
      return it->second;
    };
    for (const auto& cell : filled)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
          auto next = cell;
          next[axis] += side ? 1 : -1;
          if (filled.count(next)) continue;
          int corner[4];
          for (int i = 0; i < 4; ++i) {
            auto at = cell;
            at[axis] += side;
            at[(axis + 1) % 3] += i == 1 || i == 2, at[(axis + 2) % 3] += i >= 2;
            corner[i] = vertex(at);
          }
          const int p = corner[side ? 1 : 3], q = corner[side ? 3 : 1];
          f.push_back({corner[0], p, corner[2]}), f.push_back({corner[0], corner[2], q});
        }
    return Solid::closed(v, f);
  }

  Solid pieces() const {
    std::vector<Hull> all;
    for (const auto& cell : filled) {
      std::vector<V> v;
      for (int i = 0; i < 8; ++i)
        v.push_back({cell[0] + (i & 1 ? 0.5 : -0.5), cell[1] + (i & 2 ? 0.5 : -0.5),
                     cell[2] + (i & 4 ? 0.5 : -0.5)});
      all.emplace_back(v, judge::Faces{});
    }
    return Solid(std::move(all));
  }

  // Twice the middles of the cells.
  std::vector<V> placed(const ofg::Pose& p) const {
    std::vector<V> all;
    for (const auto& c : filled)
      all.push_back((ofg::rotation(p.q) * V(c[0], c[1], c[2]) + p.p) * 2);
    return all;
  }
};

// Right-angled turns and half steps: doubles hold all of it.
ofg::Pose grid_pose(Random& r) {
  static constexpr double turns[6][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, -1, 0},
                                         {1, 1, 1, 1}, {0, 1, 1, 0}, {0, 0, 0, 1}};
  ofg::Pose p;
  std::copy_n(turns[whole(r, 0, 5)], 4, p.q);
  p.p = {whole(r, -5, 5) / 2.0, whole(r, -5, 5) / 2.0, whole(r, -5, 5) / 2.0};
  return p;
}

const char* one_of_cells(Random& r, Tally& tally) {
  const Cells s(r), t(r);
  const Solid a[2] = {s.surface(), s.pieces()}, b[2] = {t.surface(), t.pieces()};
  for (int i = 0; i < 4; ++i, ++tally.done, ++tally.cells) {
    const ofg::Pose p = grid_pose(r), q = whole(r, 0, 5) ? grid_pose(r) : p;
    double least = INFINITY;
    for (const V& x : s.placed(p))
      for (const V& y : t.placed(q)) least = std::fmin(least, ofg::largest(x - y));
    for (int k = 0; k < 4; ++k) {
      const bool touching = least == 2 && k == 0;  // of two surfaces either may be said
      bool hit = false, back = false;
      if (const char* f = answer(a[k / 2], b[k % 2], p, q, tally, hit)) return f;
      if (const char* f = answer(b[k % 2], a[k / 2], q, p, tally, back)) return f;
      tally.hits += hit, tally.near += touching;
      if (least < 2 && !(hit && back)) return "a miss of cells";
      if (least >= 2 && !touching && (hit || back)) return "a false alarm of cells";
    }
  }
  return nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  const long queries = argc > 1 ? std::atol(argv[1]) : 100000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1e9;
  const unsigned long long seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  Random random(seed);
  const auto begin = std::chrono::steady_clock::now();
  const auto gone = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Tally tally;
  for (int i = 0; i < 2000; ++i)
    if (const char* f = one_of_sides(random)) {
      std::printf("%s\n", f);
      return 1;
    }
  while (tally.done < queries && gone() < seconds) {
    const bool cells = whole(random, 0, 1);
    if (const char* f = cells ? one_of_cells(random, tally) : one_of_surfaces(random, tally)) {
      std::printf("query %ld of seed %llu: %s\n", tally.done, seed, f);
      return 1;
    }
  }
  std::printf(
      "%ld queries of seed %llu on every instruction set and exchanged, in %.0f s: no fault. %ld "
      "of "
      "cells, %ld overlaps, %ld by containment, %ld by exact arithmetic, %ld that touch or as good "
      "as\n",
      tally.done, seed, gone(), tally.cells, tally.hits, tally.inside, tally.exact, tally.near);
  return 0;
}
