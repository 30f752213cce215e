// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Random pairs of convex bodies through verified overlap, each answer compared with the judge's
// (judge.hpp) or, of larger bodies, with brute force over the faces. Usage: fuzz_verified [queries]
// [seconds] [seed]. Prints the query and stops at the first fault; then the record.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "judge.hpp"
#include "ofg/brute_force.hpp"
#include "ofg/verified_batch.hpp"
#include "shapes.hpp"

namespace {

using Random = std::mt19937_64;
using ofg::verified::Hull;

double uniform(Random& r, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(r);
}
int whole(Random& r, int a, int b) { return std::uniform_int_distribution<int>(a, b)(r); }

struct Kind {
  bool grid, small, plain;
  std::string words;
};

// Vertices of which the hull is the body, and faces that may or may not be its own.
Shape shape(Random& r, Kind& kind) {
  const bool few = kind.small;
  const int rings = few ? whole(r, 2, 3) : whole(r, 3, 9),
            sides = few ? (rings == 2 ? whole(r, 3, 8) : whole(r, 3, 4)) : whole(r, 4, 14);
  const bool bent = !kind.plain;
  const auto thin = [&] {
    return whole(r, 0, 4) ? 1 : std::pow(10, uniform(r, bent ? -9 : -1.5, 0));
  };
  const double sy = thin(), sz = thin();
  const double rough = bent && few && whole(r, 0, 1) ? uniform(r, 0, 0.9) : 0;
  Shape s = sphere(rings, sides, rough, 1, sy, sz, r);
  const std::size_t n = s.v.size() / 3;
  if (kind.grid)
    for (auto& x : s.v) x = std::round(2 * x) / 2;
  if (!bent) return s;
  if (whole(r, 0, 7) == 0) {
    kind.words += " open";
    s.f.resize(3 * std::size_t(whole(r, 1, int(s.f.size() / 3))));
  }
  const auto vertex = [&] { return s.v.begin() + 3 * whole(r, 0, int(n) - 1); };
  if (whole(r, 0, 4) == 0) kind.words += " doubled", std::copy_n(vertex(), 3, vertex());
  if (whole(r, 0, 4) == 0) {
    kind.words += " coplanar";
    const auto a = vertex(), b = vertex(), c = vertex();
    for (int i = 0; i < 3; ++i) c[i] = (a[i] + b[i]) / 2;
  }
  if (whole(r, 0, 5) == 0) {
    kind.words += " off-centre";
    const double far = std::pow(10, uniform(r, 0, 6));
    const double by[3] = {far * uniform(r, -1, 1), far * uniform(r, -1, 1),
                          far * uniform(r, -1, 1)};
    for (std::size_t i = 0; i < s.v.size(); ++i)
      s.v[i] += kind.grid ? std::round(by[i % 3]) : by[i % 3];
  }
  return s;
}

struct Tally {
  long done = 0, hits = 0, near = 0, flat = 0, exact = 0, closest = 0, large = 0;
};

ofg::Pose pose(Random& r, const Kind& kind, double reach, double far) {
  ofg::Pose p;
  for (auto& c : p.q) c = kind.grid ? whole(r, -1, 1) : uniform(r, -1, 1);
  if (ofg::largest(ofg::Vec3<double>(p.q[1], p.q[2], p.q[3])) == 0) p.q[0] = 1;
  const auto at = [&] {
    return far + (kind.grid ? whole(r, -4, 4) / 2.0 : reach * uniform(r, -1, 1));
  };
  p.p = {at(), at(), at()};
  return p;
}

// The answer, which every instruction set gives, and a cache of any past, and the exchanged pair.
const char* answer(const Hull& a, const Hull& b, const ofg::Pose& p, const ofg::Pose& q,
                   ofg::verified::Cache& cache, Tally& tally, bool& hit) {
  for (int isa = 0; isa <= int(ofg::widest_isa()); ++isa) {
    ofg::set_isa(ofg::Isa(isa));
    const ofg::Answer x = ofg::verified::overlap(a, b, p, q);
    if (isa == 0) hit = x.hit, tally.exact += x.counts.steps > 1;
    if (x.hit != hit) return "instruction sets disagree";
    if (x.hit != (x.found != ofg::Found::nothing)) return "a hit that nothing made";
    if (x.hit != (x.face_a >= 0) && x.found != ofg::Found::inside)
      return "faces that are not there";
    const ofg::Pose ps[3] = {p, q, p}, qs[3] = {q, p, q};
    ofg::Answer many[3];
    ofg::verified::overlap_many(a, b, ps, qs, 3, many);
    if (many[0].hit != hit || many[2].hit != hit) return "a batch changed an answer";
    if (ofg::verified::overlap(a, b, p, q, &cache).hit != hit) return "a cache changed an answer";
    if (ofg::verified::overlap(b, a, q, p, &cache).hit != hit) return "exchanged, another answer";
  }
  return nullptr;
}

// What another way says: hit, clear, or that nobody can be blamed.
judge::Says judged(const Hull& a, const Hull& b, const ofg::Pose& p, const ofg::Pose& q) {
  return judge::overlap({judge::posed(a.vertices, p, q.p), judge::posed(b.vertices, q, q.p)});
}

// The faces of bodies that are convex up to rounding. Within 1e-9 of touching they say nothing:
// then growing or shrinking A changes what brute force says.
struct Faces {
  ofg::Body<double> a[2], b;

  Faces(const Shape& s, const Shape& t) : b(body<double>(t, true)) {
    for (int i = 0; i < 2; ++i) {
      Shape u = s;
      for (auto& x : u.v) x *= i == 0 ? 1 + 1e-9 : 1 - 1e-9;
      a[i] = body<double>(u, true);
    }
  }

  judge::Says operator()(const ofg::Pose& p, const ofg::Pose& q) const {
    const ofg::Track track(p, q);
    bool said[2];
    for (int i = 0; i < 2; ++i)
      said[i] = ofg::brute_force::overlap(a[i], b, track).hit ||
                ofg::one_inside_other(a[i].whole, b.whole, track.at(0));
    return said[0] != said[1] ? judge::Says::near : said[0] ? judge::Says::hit : judge::Says::clear;
  }
};

// As good as touching: from centre near centre A goes along a direction until they part, and a gap
// more or less.
void move_to_touch(Random& r, const Hull& a, const Hull& b, const Kind& kind, double reach,
                   ofg::Pose& p, const ofg::Pose& q, Tally& tally) {
  using V = ofg::Vec3<double>;
  const auto some = [&](double most) { return most * uniform(r, -1, 1); };
  const V between = ofg::rotation(q.q) * (ofg::Track(p, q).at(0)(a.centre) - b.centre),
          way(some(1), some(1), some(1));
  ofg::Pose from = p;
  from.p = p.p - between + V(some(0.1), some(0.1), some(0.1)) * std::fmin(a.inner, b.inner);
  const double gap =
      (whole(r, 0, 1) ? 1 : -1) * std::pow(10, uniform(r, kind.small ? -16 : -8, -1));
  double along = 0;
  if (kind.small) {
    along = judge::reach({judge::posed(a.vertices, from, q.p), judge::posed(b.vertices, q, q.p)},
                         {way.x, way.y, way.z});
  } else {
    // Where they part is found by what is tested; whether they do there is not.
    for (double step = 2 * reach / ofg::length(way); step > 1e-10 * reach; step /= 2) {
      ofg::Pose there = from;
      there.p = from.p + way * (along + step);
      if (ofg::verified::overlap(a, b, there, q).hit) along += step;
    }
  }
  along += gap * reach;
  if (!(std::abs(along) < 100 * reach + 1e7)) return;
  p.p = from.p + way * along;
  ++tally.closest;
}

const char* one(Random& r, const Hull& a, const Hull& b, const Faces* faces, const Kind& kind,
                double reach, ofg::verified::Cache& cache, Tally& tally) {
  const double far = whole(r, 0, 5) ? 0 : std::round(std::pow(10, uniform(r, 0, 6)));
  ofg::Pose p = pose(r, kind, reach, far), q = pose(r, kind, reach, far);
  if (whole(r, 0, 3) == 0) std::copy_n(q.q, 4, p.q);  // whose faces and edges are parallel
  if (whole(r, 0, 2)) move_to_touch(r, a, b, kind, reach, p, q, tally);
  bool hit = false;
  if (const char* f = answer(a, b, p, q, cache, tally, hit)) return f;
  const judge::Says says = faces ? (*faces)(p, q) : judged(a, b, p, q);
  tally.hits += hit, tally.near += says == judge::Says::near, tally.large += !kind.small;
  if (says == judge::Says::hit && !hit) return "a miss";
  if (says == judge::Says::clear && hit) return "a false alarm";
  return nullptr;
}

// Boxes that lie face on face, turned together by a quaternion of whole numbers, but for one corner
// that sticks out of its box by one step of a double, or lacks one: doubles cannot tell once it is
// turned. The boxes reach |q|^2 from their centres, so that places of exact contact are whole.
const char* corner_by_corner(Random& r) {
  for (int turns = 0; turns < 60; ++turns) {
    const int w = whole(r, 1, 9), x = whole(r, 1, 9), y = whole(r, 1, 9), z = whole(r, 1, 9);
    const double half = w * w + x * x + y * y + z * z;
    const int columns[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
        {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
        {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}};
    std::vector<ofg::Vec3<double>> box;
    for (int i = 0; i < 8; ++i)
      box.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
    const Hull plain(box, {});
    const int axis = whole(r, 0, 2), i = whole(r, 0, 7), by = whole(r, 0, 1) ? 1 : -1;
    auto odd = box;
    auto& corner = odd[std::size_t(i)];
    double& c = axis == 0 ? corner.x : axis == 1 ? corner.y : corner.z;
    const int side = c > 0 ? 2 : -2;
    c = std::nextafter(c, by * c * 2);
    const ofg::Pose p{{double(w), double(x), double(y), double(z)}, {}};
    ofg::Pose q = p;
    const int* way = columns[axis];
    q.p = {double(side * way[0]), double(side * way[1]), double(side * way[2])};
    const Hull other(odd, {});
    if (ofg::verified::overlap(other, plain, p, q).hit != (by > 0) ||
        ofg::verified::overlap(plain, other, q, p).hit != (by > 0))
      return "a corner out by one step of a double";
  }
  return nullptr;
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
  if (const char* f = corner_by_corner(random)) {
    std::printf("%s\n", f);
    return 1;
  }
  while (tally.done < queries && gone() < seconds) {
    Kind kind{whole(random, 0, 3) == 0, whole(random, 0, 4) > 0, false, ""};
    if (!kind.small) kind.plain = true, kind.grid = false;
    Shape s = shape(random, kind), t = shape(random, kind);
    const double scale =
        whole(random, 0, 3) || kind.grid ? 1 : std::pow(10, uniform(random, -6, 6));
    for (auto& c : s.v) c *= scale;
    const auto mesh = [](const Shape& x) {
      return ofg::Mesh<double>(x.v.data(), x.v.size() / 3, x.f.data(), x.f.size() / 3, true);
    };
    const ofg::Mesh<double> ma = mesh(s), mb = mesh(t);
    const Hull a(ma), b(mb);
    if (a.flat || b.flat) {
      ++tally.flat;
      continue;
    }
    const auto faces = kind.small ? nullptr : std::make_unique<const Faces>(s, t);
    ofg::verified::Cache cache;
    const double reach = a.radius + b.radius + ofg::length(a.centre) * 1e-3;
    for (int i = 0; i < 20 && tally.done < queries; ++i, ++tally.done) {
      if (const char* f = one(random, a, b, faces.get(), kind, reach, cache, tally)) {
        std::printf("query %ld of seed %llu: %s (bodies:%s%s; scale %g; vertices %d, %d)\n",
                    tally.done, seed, f, kind.grid ? " on a grid" : "", kind.words.c_str(), scale,
                    a.size(), b.size());
        return 1;
      }
    }
  }
  std::printf(
      "%ld queries of seed %llu on every instruction set, exchanged and with a cache, in %.0f s: "
      "no "
      "fault. %ld overlaps, %ld moved to within 0.1 and 1e-16 of touching, %ld by exact "
      "arithmetic, "
      "%ld that touch or as good as, %ld of larger bodies, %ld flat pairs refused\n",
      tally.done, seed, gone(), tally.hits, tally.closest, tally.exact, tally.near, tally.large,
      tally.flat);
  return 0;
}
