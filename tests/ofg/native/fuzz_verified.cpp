// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Random pairs of convex bodies through verified overlap, each answer compared with one that is not
// its own: a certificate of other origin (certificate.hpp); where there is none, and for a sample,
// all planes (judge.hpp) or, of larger bodies, brute force over the faces.
//
// Usage: fuzz_verified [queries] [seconds] [seed] [from]. Every pair of bodies is drawn from the
// seed and its own number alone: a run goes on where an earlier one ended with `from`, and runs of
// different seeds add up. Prints the query and stops at the first fault; then the record.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "certificate.hpp"
#include "kinds.hpp"
#include "ofg/brute_force.hpp"
#include "ofg/verified_batch.hpp"

namespace {

using judge::Says;
using kinds::Kinds, kinds::Random, kinds::Row, kinds::Tally, kinds::uniform, kinds::whole;
using ofg::Pose;
using ofg::verified::Hull;

constexpr int of_a_pair = 24;  // queries about one pair of bodies

// The faces of bodies that are convex up to rounding. Within a billionth of both bodies' size of
// touching they say nothing: then growing or shrinking A changes what brute force says.
struct Faces {
  ofg::Body<double> a[2], b;

  // ratio: of B's size to A's
  Faces(const Shape& s, const Shape& t, double ratio) : b(body<double>(t, true)) {
    const double some = 1e-9 * (1 + ratio);
    for (int i = 0; i < 2; ++i) {
      Shape u = s;
      for (auto& x : u.v) x *= i == 0 ? 1 + some : 1 - some;
      a[i] = body<double>(u, true);
    }
  }

  Says operator()(const Pose& p, const Pose& q) const {
    const ofg::Track track(p, q);
    bool said[2];
    for (int i = 0; i < 2; ++i)
      said[i] = ofg::brute_force::overlap(a[i], b, track).hit ||
                ofg::one_inside_other(a[i].whole, b.whole, track.at(0));
    return said[0] != said[1] ? Says::near : said[0] ? Says::hit : Says::clear;
  }
};

struct Query {
  Pose p, q;
  Kinds kinds;
  bool hit = false, exact = false, alone = false;
};

// Do 113 bits hold every product of three coordinates? Grids of quarters up to 1e6 take 90.
bool on_the_grid(const Query& query) {
  const auto& p = query.p.p;
  for (const double c : {p.x, p.y, p.z})
    if (std::floor(2 * c) != 2 * c || std::abs(c) > 0x1p22) return false;
  return query.kinds[kinds::grid];
}

// One pair of bodies and what is asked about it.
struct Block {
  Random r;
  Kinds kinds;
  Shape s, t;
  Hull a, b;
  double reach = 0;
  std::optional<Faces> faces;
  std::vector<Query> queries;
  Tally& tally;

  Block(unsigned long long seed, long number, Tally& all) : tally(all) {
    std::seed_seq both{unsigned(seed), unsigned(seed >> 32), unsigned(number),
                       unsigned(number >> 32)};
    r.seed(both);
    kinds[kinds::large] = whole(r, 0, 7) == 0;
    kinds[kinds::grid] = whole(r, 0, 3) == 0 && !kinds[kinds::large];
    s = kinds::shape(r, kinds), t = kinds::shape(r, kinds);
    const double scale = whole(r, 0, 3) || kinds[kinds::grid] ? 1 : std::pow(10, uniform(r, -6, 6));
    kinds[kinds::size_ratio] = scale < 0.1 || scale > 10;
    for (auto& c : s.v) c *= scale;
    a = hull(s), b = hull(t);
    reach = a.radius + b.radius + ofg::length(a.centre) * 1e-3;
  }

  static Hull hull(const Shape& x) {
    return Hull(ofg::Mesh<double>(x.v.data(), x.v.size() / 3, x.f.data(), x.f.size() / 3, true));
  }

  judge::Question question(const Pose& p, const Pose& q) const {
    return {a.vertices, b.vertices, p, q};
  }

  void draw() {
    while (int(queries.size()) < of_a_pair) {
      Query query;
      query.kinds = kinds;
      const double far = whole(r, 0, 5) ? 0 : std::round(std::pow(10, uniform(r, 0, 6)));
      query.kinds[kinds::far_away] = far > 100;
      query.p = kinds::pose(r, kinds, reach, far), query.q = kinds::pose(r, kinds, reach, far);
      if (whole(r, 0, 3) == 0) std::copy_n(query.q.q, 4, query.p.q);  // faces, edges are parallel
      if (whole(r, 0, 3))
        move_to_touch(query);
      else
        queries.push_back(query);
    }
  }

  // As good as touching: from centre near centre A goes along a direction until they part, and a
  // gap more or less; gaps of several sizes for each direction.
  void move_to_touch(Query query) {
    using V = ofg::Vec3<double>;
    const auto some = [&](double most) { return most * uniform(r, -1, 1); };
    const Pose &p = query.p, &q = query.q;
    const V between = ofg::rotation(q.q) * (ofg::Track(p, q).at(0)(a.centre) - b.centre),
            way(some(1), some(1), some(1));
    Pose from = p;
    from.p = p.p - between + V(some(0.1), some(0.1), some(0.1)) * std::fmin(a.inner, b.inner);
    const double along = parting(from, q, way);
    for (int i = 0; i < 4; ++i) {
      const double gap = (whole(r, 0, 1) ? 1 : -1) * std::pow(10, uniform(r, -16, -1));
      const double there = along + gap * reach;
      if (!(std::abs(there) < 100 * reach + 1e7)) return;
      query.p.p = from.p + way * there;
      query.kinds[kinds::near_touching] = std::abs(gap) < 1e-6;
      if (kinds[kinds::grid] && whole(r, 0, 1)) {
        auto& c = query.p.p;
        c = {std::round(2 * c.x) / 2, std::round(2 * c.y) / 2, std::round(2 * c.z) / 2};
      }
      queries.push_back(query);
    }
  }

  // Of larger bodies to where doubles have no certificate of either, and sometimes on in 64 bits.
  double parting(const Pose& from, const Pose& q, const ofg::Vec3<double>& way) {
    if (!kinds[kinds::large]) return judge::reach(question(from, q), {way.x, way.y, way.z});
    const bool finely = whole(r, 0, 3) == 0;
    double along = 0;
    for (double step = 2 * reach / ofg::length(way); step > 1e-16 * reach; step /= 2) {
      Pose there = from;
      there.p = from.p + way * (along + step);
      const judge::Question asked = question(there, q);
      Says says = judge::by_certificate(judge::Posed<double>(asked));
      if (says == Says::near && finely)
        says = judge::by_certificate(judge::Posed<long double>(asked));
      if (says != Says::clear) along += step;
    }
    return along;
  }

  // The answer, which every instruction set gives, and a cache of any past, and the exchanged pair.
  const char* ask(Query& query, int turn, ofg::verified::Cache& cache) const {
    const Pose &p = query.p, &q = query.q;
    for (int isa = 0; isa <= int(ofg::widest_isa()); ++isa) {
      ofg::set_isa(ofg::Isa(isa));
      const ofg::Answer x = ofg::verified::overlap(a, b, p, q);
      if (isa == 0) query.hit = x.hit, query.exact = x.counts.steps > 1;
      if (x.hit != query.hit) return "instruction sets disagree";
      if (x.hit != (x.found != ofg::Found::nothing)) return "a hit that nothing made";
      if (x.hit != (x.face_a >= 0) && x.found != ofg::Found::inside)
        return "faces that are not there";
      const bool exchanged = (turn + isa) % 2;
      const ofg::Answer y = exchanged ? ofg::verified::overlap(b, a, q, p, &cache)
                                      : ofg::verified::overlap(a, b, p, q, &cache);
      if (y.hit != x.hit) return exchanged ? "exchanged, another answer" : "a cache changed it";
    }
    if (turn % 4) return nullptr;
    ofg::verified::Parts parts;
    parts.twice = false;
    const ofg::Answer z = ofg::verified::overlap(a, b, p, q, nullptr, parts);
    query.alone = z.counts.steps > 1;
    return z.hit == query.hit ? nullptr : "exact arithmetic alone says otherwise";
  }

  const char* ask_many() const {
    std::vector<Pose> p, q;
    for (const auto& query : queries) p.push_back(query.p), q.push_back(query.q);
    std::vector<ofg::Answer> many(queries.size());
    for (int isa = 0; isa <= int(ofg::widest_isa()); ++isa) {
      ofg::set_isa(ofg::Isa(isa));
      if (isa % 2)
        ofg::verified::overlap_many(b, a, q.data(), p.data(), p.size(), many.data());
      else
        ofg::verified::overlap_many(a, b, p.data(), q.data(), p.size(), many.data());
      for (std::size_t i = 0; i < many.size(); ++i)
        if (many[i].hit != queries[i].hit) return "a batch changed an answer";
    }
    return nullptr;
  }

  Says slowly(const Query& query) {
    if (!kinds[kinds::large])
      return judge::by_all_planes(question(query.p, query.q), on_the_grid(query));
    if (!faces) faces.emplace(s, t, b.radius / a.radius);
    return (*faces)(query.p, query.q);
  }

  const char* compare(const Query& query) {
    const judge::Question asked = question(query.p, query.q);
    const bool sampled = whole(r, 0, 31) == 0;
    Says says = judge::by_certificate(judge::Posed<double>(asked));
    const bool doubles = says != Says::near;
    if (!doubles) says = judge::by_certificate(judge::Posed<long double>(asked));
    if (says == Says::near) says = judge::by_certificate(judge::Posed<judge::Quad>(asked));
    const bool quads = !doubles && says != Says::near, slow = sampled || says == Says::near;
    if (slow) {
      const Says other = slowly(query);
      if (other != Says::near && says != Says::near && other != says)
        return "the judge contradicts itself";
      if (says == Says::near) says = other;
    }
    tally.add(query.kinds, [&](Row& row) {
      ++row.queries, row.hits += query.hit, row.touching += says == Says::near;
      row.exact += query.exact, row.alone += query.alone, row.doubles += doubles,
          row.quads += quads, row.planes += slow;
    });
    if (says == Says::hit && !query.hit) return "a miss";
    if (says == Says::clear && query.hit) return "a false alarm";
    return nullptr;
  }

  const char* run() {
    if (a.flat || b.flat) return ++tally.flat, nullptr;
    draw();
    ofg::verified::Cache cache;
    int turn = 0;
    for (auto& query : queries) {
      if (const char* f = ask(query, turn++, cache)) return f;
      if (const char* f = compare(query)) return f;
    }
    return ask_many();
  }
};

const char* crafted(Random r, int times) {
  const auto overlap = [](const auto& a, const auto& b, const Pose& p, const Pose& q) {
    return ofg::verified::overlap(Hull(a, {}), Hull(b, {}), p, q).hit;
  };
  for (int i = 0; i < times; ++i) {
    if (const char* f = kinds::corner_by_corner(r, overlap)) return f;
    if (const char* f = kinds::tied_corners(r, overlap)) return f;
  }
  return nullptr;
}

struct Clock {
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  double next = 30;
  double gone() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  void report(long done, long queries, double seconds) {
    const double now = gone();
    if (now < next) return;
    next = now + 30;
    const double rate = double(done) / now,
                 left = std::fmin(double(queries - done) / rate, seconds - now);
    std::printf("%ld of %ld queries, %.0f a second, %.0f min left\n", done, queries, rate,
                left / 60);
    std::fflush(stdout);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const long queries = argc > 1 ? std::atol(argv[1]) : 1000000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1e9;
  const unsigned long long seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  long pair = argc > 4 ? std::atol(argv[4]) : 0;
  Tally tally;
  Clock clock;
  if (const char* f = crafted(Random(seed), 150)) return std::printf("%s\n", f), 1;
  const long from = pair;
  const long& done = tally.rows[kinds::any].queries;
  for (; done < queries && clock.gone() < seconds; ++pair) {
    Block block(seed, pair, tally);
    const char* f = pair % 8 == 0 ? crafted(block.r, 1) : nullptr;
    if (!f) f = block.run();
    if (f) {
      std::printf("pair %ld of seed %llu, to be had by `fuzz_verified 1 9 %llu %ld`: %s\n", pair,
                  seed, seed, pair, f);
      return 1;
    }
    clock.report(done, queries, seconds);
  }
  tally.print();
  std::printf("%ld queries about pairs %ld to %ld of seed %llu in %.0f s: no fault\n", done, from,
              pair - 1, seed, clock.gone());
  return 0;
}
