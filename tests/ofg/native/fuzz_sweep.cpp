// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Random sweeps of convex bodies through verified OFG, each compared with verified overlap at many
// times of the step. Usage: fuzz_sweep [queries] [seconds] [seed]. Prints the query and stops at
// the first fault; then the record.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "bends.hpp"
#include "moved.hpp"
#include "ofg/verified_sweep.hpp"
#include "shapes.hpp"

namespace {

using Random = std::mt19937_64;
using Vec = ofg::Vec3<double>;
using ofg::verified::Hull;
using ofg::verified::Impact;

double uniform(Random& r, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(r);
}
int whole(Random& r, int a, int b) { return std::uniform_int_distribution<int>(a, b)(r); }
double power(Random& r, double a, double b) { return std::pow(10, uniform(r, a, b)); }
Vec some(Random& r, double most) {
  return {most * uniform(r, -1, 1), most * uniform(r, -1, 1), most * uniform(r, -1, 1)};
}

struct Tally {
  long done = 0, hits = 0, starts = 0, both = 0, straight = 0, unproved = 0, unchecked = 0,
       steps = 0, most = 0;
};

// A round, long or flat body, or a box.
Shape shape(Random& r) {
  if (whole(r, 0, 4) == 0) {
    Shape s;
    const double x = 1, y = whole(r, 0, 1) ? 1 : power(r, -2, 0), z = whole(r, 0, 1) ? 1 : 0.1;
    for (int i = 0; i < 8; ++i)
      s.v.insert(s.v.end(), {i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
    s.f = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
           2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return s;
  }
  const bool large = whole(r, 0, 5) == 0;
  const int rings = large ? whole(r, 4, 12) : whole(r, 2, 3), sides = whole(r, 3, large ? 14 : 6);
  const double sx = whole(r, 0, 3) ? 1 : power(r, -3, 0), sy = whole(r, 0, 3) ? 1 : sx;
  const double sz = whole(r, 0, 3) ? 1 : power(r, -2.5, 1);
  return sphere(rings, sides, large ? 0 : uniform(r, 0, 0.3), sx, sy, sz, r);
}

// The body grown about its centre by a share of itself.
Hull grown(const Hull& hull, double share) {
  std::vector<Vec> vertices;
  for (int i = 0; i < hull.size(); ++i)
    vertices.push_back(hull.centre + hull.point(i) * (1 + share));
  return Hull(vertices, {});
}

struct Pair {
  Hull a, b;
  double size;
};

struct Sweep {
  ofg::Pose a, b;
  ofg::Motion by_a, by_b;

  bool meets(const Hull& x, const Hull& y, double t) const {
    const moved::Poses at = moved::poses(a, b, by_a, by_b, t);
    return ofg::verified::overlap(x, y, at.a, at.b).hit;
  }
};

Vec on_grid(const Vec& v) { return {std::round(v.x), std::round(v.y), std::round(v.z)}; }

ofg::Motion motion(Random& r, double size, bool turns, bool grid) {
  ofg::Motion m;
  m.axis = grid ? on_grid(some(r, 1.4)) : some(r, 1);
  if (dot(m.axis, m.axis) == 0) m.axis = {0, 0, 1};
  static constexpr double full = 6.283185307179586;
  const double angles[] = {power(r, -4, 0),  0.1, 0.5, 1.5, 6, full, full * whole(r, 1, 9),
                           uniform(r, 0, 60)};
  if (turns) m.angle = angles[whole(r, 0, 7)] * (whole(r, 0, 1) ? 1 : -1);
  if (whole(r, 0, 3) == 0) m.about = some(r, whole(r, 0, 1) ? size : 10 * size);
  m.displacement = some(r, size * power(r, -4, 1));
  if (grid) m.displacement = on_grid(some(r, 4)) * size;
  const Vec k = m.axis * (1 / ofg::length(m.axis));
  if (turns && whole(r, 0, 4) == 0) m.displacement = k * (size * power(r, -2, 1));  // a screw
  if (turns && whole(r, 0, 4) == 0)                                                 // rolling
    m.displacement = cross(k, some(r, size)) * m.angle;
  if (turns && whole(r, 0, 5) == 0) m.displacement = {};
  return m;
}

ofg::Pose pose(Random& r, double far, bool grid) {
  ofg::Pose p;
  for (auto& c : p.q) c = grid ? whole(r, -1, 1) : uniform(r, -1, 1);
  if (p.q[1] == 0 && p.q[2] == 0 && p.q[3] == 0) p.q[0] = 1;
  p.p = Vec(far, -far, far);
  return p;
}

// A sweep that touches at some time, and a gap more or less, from where A is near B's centre.
Sweep sweep(Random& r, const Pair& pair, Tally& tally) {
  const double far = whole(r, 0, 3) ? 0 : power(r, 0, 5);
  const bool grid = whole(r, 0, 3) == 0;  // faces and edges are parallel, and stay so
  Sweep s{pose(r, far, grid), pose(r, far, grid), {}, {}};
  const int turning = whole(r, 0, 7);  // neither, A, B, or both
  s.by_a = motion(r, pair.size, turning == 1 || turning > 2, grid);
  s.by_b = motion(r, pair.size, turning == 2 || turning > 4, grid);
  if (turning == 1 || turning == 3 || turning == 4) s.by_b = {};
  tally.both += s.by_a.angle != 0 && s.by_b.angle != 0, tally.straight += turning == 0;
  const double t = whole(r, 0, 3) && turning != 0 ? uniform(r, 0, 1) : whole(r, 0, 1);
  const moved::Poses at = moved::poses(s.a, s.b, s.by_a, s.by_b, t);
  const Vec between = at.a.p + ofg::rotation(at.a.q) * pair.a.centre - at.b.p -
                      ofg::rotation(at.b.q) * pair.b.centre;
  const double aside = grid && whole(r, 0, 1) ? 0 : 0.1;
  Vec way = some(r, 1) * pair.size;
  if (aside == 0) way = Vec(1, 0, 0) * pair.size;
  const Vec start = s.a.p - between + some(r, aside * std::fmin(pair.a.inner, pair.b.inner));
  // To within rounding in a third of the cases: that prices margins, and exact arithmetic.
  const double least = whole(r, 0, 2) ? 1e-11 : 1e-17, gap = power(r, std::log10(least), 0);
  double along = 0;
  for (double step = 4 / ofg::length(way) * pair.size; step > least; step /= 2) {
    s.a.p = start + way * (along + step);
    if (s.meets(pair.a, pair.b, t)) along += step;
  }
  s.a.p = start + way * (along + gap * whole(r, -1, 1));
  return s;
}

// What is wrong with an answer; how far poses at a time are off is allowed for by a body that is
// smaller or larger by that.
const char* fault(Random& r, const Pair& pair, const Sweep& s, const Impact& x, Tally& tally) {
  const bool start = ofg::verified::overlap(pair.a, pair.b, s.a, s.b).hit;
  if (start != (x.hit && x.latest == 0)) return "overlap at the start";
  if (start) return nullptr;
  if (x.hit && !(x.time >= 0 && x.time <= 1)) return "a time outside the step";
  if (x.hit && x.proved && !(x.latest > x.time - 1e-15 && x.latest - x.time <= 1.0001e-9))
    return "a bracket that is none";
  if (!x.hit && !x.proved) return "a clear that is not proved";
  const double size = pair.a.radius + pair.b.radius,
               share = moved::rounding(s.a, s.b, s.by_a, s.by_b, size) / pair.a.inner;
  if (!(share < 1e-3)) return ++tally.unchecked, nullptr;
  if (!x.proved && !s.meets(grown(pair.a, share + 1e-6 * size / pair.a.inner), pair.b, x.time))
    return "given up far from contact";
  const Hull less = grown(pair.a, -share);
  const double until = x.hit ? x.time : 1;
  for (int i = 0; i <= 24; ++i)
    if (s.meets(less, pair.b, until * (i + uniform(r, 0, 1) * (i < 24 && i > 0)) / 24))
      return x.hit ? "late" : "a miss";
  for (double before = 0.1; before > 1e-10; before *= 0.3)
    if (before < until && s.meets(less, pair.b, until - before)) return x.hit ? "late" : "a miss";
  if (x.latest == x.latest && !s.meets(grown(pair.a, share), pair.b, x.latest))
    return "a false alarm";
  return nullptr;
}

const char* one(Random& r, const Pair& pair, Sweep& s, Tally& tally) {
  s = sweep(r, pair, tally);
  for (int i = whole(r, 0, 4); i > 0 && s.meets(pair.a, pair.b, 0); --i) s = sweep(r, pair, tally);
  const Impact x = ofg::verified::sweep(pair.a, pair.b, s.a, s.b, s.by_a, s.by_b);
  tally.hits += x.hit, tally.starts += x.hit && x.latest == 0, tally.unproved += !x.proved;
  tally.steps += x.counts.steps, tally.most = std::max(tally.most, long(x.counts.steps));
  if (const char* f = fault(r, pair, s, x, tally)) return f;
  const Impact y = ofg::verified::sweep(pair.b, pair.a, s.b, s.a, s.by_b, s.by_a);
  if (const char* f = fault(r, {pair.b, pair.a, pair.size}, {s.b, s.a, s.by_b, s.by_a}, y, tally))
    return f;
  if (x.hit != y.hit && x.proved && y.proved) return "exchanged, another answer";
  if (x.hit && y.hit && (x.time > y.latest || y.time > x.latest)) return "exchanged, another time";
  return nullptr;
}

void print(const Sweep& s) {
  const auto side = [](const ofg::Pose& p, const ofg::Motion& m) {
    std::printf(
        "pose %.17g %.17g %.17g %.17g, %.17g %.17g %.17g; by %.17g %.17g %.17g, axis %.17g "
        "%.17g %.17g, angle %.17g, about %.17g %.17g %.17g\n",
        p.q[0], p.q[1], p.q[2], p.q[3], p.p.x, p.p.y, p.p.z, m.displacement.x, m.displacement.y,
        m.displacement.z, m.axis.x, m.axis.y, m.axis.z, m.angle, m.about.x, m.about.y, m.about.z);
  };
  side(s.a, s.by_a), side(s.b, s.by_b);
}

}  // namespace

int main(int argc, char** argv) {
  const long queries = argc > 1 ? std::atol(argv[1]) : 1000000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1e9;
  const unsigned long long seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  Random random(seed);
  const auto begin = std::chrono::steady_clock::now();
  const auto gone = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Tally tally;
  double shares[4];
  bends::shares(random, 20000, shares);
  for (const double share : shares)
    if (share > 1 + 1e-6) {
      std::printf("a second derivative is %g times its bound\n", share);
      return 1;
    }
  while (tally.done < queries && gone() < seconds) {
    Shape s = shape(random), t = shape(random);
    const double ratio = whole(random, 0, 3) ? 1 : power(random, -6, 0);
    for (auto& c : s.v) c *= ratio;
    const auto mesh = [](const Shape& x) {
      return ofg::Mesh<double>(x.v.data(), x.v.size() / 3, x.f.data(), x.f.size() / 3, true);
    };
    Pair pair{Hull(mesh(s)), Hull(mesh(t)), 0};
    if (pair.a.flat || pair.b.flat || !(pair.a.inner > 0) || !(pair.b.inner > 0)) continue;
    pair.size = whole(random, 0, 1) ? pair.a.radius : pair.b.radius;
    for (int i = 0; i < 20 && tally.done < queries; ++i, ++tally.done) {
      Sweep asked;
      if (const char* f = one(random, pair, asked, tally)) {
        std::printf("query %ld of seed %llu: %s (vertices %d, %d; ratio %g)\n", tally.done, seed, f,
                    pair.a.size(), pair.b.size(), ratio);
        print(asked);
        return 1;
      }
    }
  }
  std::printf(
      "%ld sweeps of seed %llu, and exchanged, in %.0f s: no fault. %ld hits, %ld at the "
      "start, %ld of two turning bodies, %ld translations, %ld answers not proved, %ld "
      "sides not compared; segments %.1f on average, %ld at most\n",
      tally.done, seed, gone(), tally.hits, tally.starts, tally.both, tally.straight,
      tally.unproved, tally.unchecked, double(tally.steps) / double(tally.done), tally.most);
  return 0;
}
