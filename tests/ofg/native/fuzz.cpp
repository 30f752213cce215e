// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Random queries under AddressSanitizer and UndefinedBehaviorSanitizer, on shapes with everything
// wrong that a mesh can have, each answer checked against what must hold. Usage: fuzz [queries]
// [seconds] [seed]. Prints the query and stops at the first fault.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "ofg/article.hpp"
#include "ofg/batch.hpp"
#include "ofg/brute_force.hpp"
#include "shapes.hpp"

using Random = std::mt19937_64;

static double uniform(Random& r, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(r);
}
static int whole(Random& r, int a, int b) { return std::uniform_int_distribution<int>(a, b)(r); }

// A shape and how it was spoilt.
static Shape shape(Random& r, std::string& what) {
  const double flat = whole(r, 0, 3) ? 1 : std::pow(10, uniform(r, -12, 0)),
               needle = whole(r, 0, 3) ? 1 : std::pow(10, uniform(r, -12, 0));
  const bool grid = whole(r, 0, 3) == 0;
  Shape s = sphere(whole(r, 2, 7), whole(r, 3, 8), whole(r, 0, 1) ? 0 : uniform(r, 0, 0.9), 1,
                   needle, flat * needle, r);
  const std::size_t n = s.v.size() / 3, m = s.f.size() / 3;
  if (grid)
    for (auto& x : s.v)
      x = std::round(2 * x) /
          2;  // exact touching, coplanar faces, doubled vertices, faces of no area
  switch (whole(r, 0, 7)) {
    case 0:
      what += " doubled-vertex";
      std::copy_n(s.v.begin(), 3, s.v.begin() + 3 * whole(r, 1, int(n) - 1));
      break;
    case 1:
      what += " face-of-no-area";
      s.f[3 * std::size_t(whole(r, 0, int(m) - 1))] = s.f[1];
      break;
    case 2:
      what += " point-like-faces";
      for (int i = 0; i < 3; ++i) s.f.push_back(0);
      break;
    case 3:
      what += " one-face";
      s.f.resize(3);
      break;
    case 4:
      what += " all-in-one-plane";
      for (std::size_t i = 0; i < n; ++i) s.v[3 * i + 2] = 0;
      break;
    default:
      break;
  }
  return s;
}

template <class T>
struct Pair {
  ofg::Body<T> a, b;
  ofg::Workspace<T> w;
};

struct Asked {
  ofg::Pose p, q;
  ofg::Motion m, n;
  ofg::Options o;
};

static Asked query(Random& r, double scale) {
  Asked x;
  const double far = whole(r, 0, 9) ? 0 : std::pow(10, uniform(r, 0, 9)) * scale;
  const bool grid = whole(r, 0, 2) == 0;
  for (auto* pose : {&x.p, &x.q}) {
    for (auto& c : pose->q) c = grid ? whole(r, -1, 1) : uniform(r, -1, 1);
    if (pose->q[0] == 0) pose->q[0] = 1;
    const auto at = [&] {
      return scale * (grid ? whole(r, -4, 4) / 2.0 : uniform(r, -2, 2)) + far;
    };
    pose->p = {at(), at(), at()};
  }
  for (auto* m : {&x.m, &x.n}) {
    const double fast = scale * std::pow(10, uniform(r, -3, 1));
    m->displacement = {fast * uniform(r, -1, 1), fast * uniform(r, -1, 1),
                       fast * uniform(r, -1, 1)};
    if (grid)
      m->displacement = {scale * whole(r, -4, 4), scale * whole(r, -4, 4), scale * whole(r, -4, 4)};
    m->axis = {uniform(r, -1, 1), 1, uniform(r, -1, 1)};
    m->angle = whole(r, 0, 1) ? 0 : uniform(r, -7, 7);
    const double arm = whole(r, 0, 1) ? 0 : scale * std::pow(10, uniform(r, -1, 2));
    m->about = {arm * uniform(r, -1, 1), arm * uniform(r, -1, 1), arm * uniform(r, -1, 1)};
    if (m == &x.n && whole(r, 0, 1)) *m = {};
  }
  x.o.k = whole(r, 0, 4) ? whole(r, 1, 20) : 1000000;
  x.o.toi = ofg::Toi(whole(r, 0, 3)), x.o.order = ofg::Order(whole(r, 0, 1)),
  x.o.broad = ofg::Broad(whole(r, 0, 1)), x.o.concave = ofg::Concave(whole(r, 0, 2));
  x.o.nearest = ofg::Nearest(whole(r, 0, 1)), x.o.selection_times = whole(r, 1, 3);
  x.o.end_moment = whole(r, 0, 3) == 0, x.o.piece_times = whole(r, 1, 3),
  x.o.iterations = whole(r, 1, 20);
  x.o.adaptive_k = whole(r, 0, 2) == 0, x.o.both_vertices = whole(r, 0, 1),
  x.o.edge_edge = whole(r, 0, 1);
  x.o.containment = whole(r, 0, 2) == 0, x.o.earliest = whole(r, 0, 1),
  x.o.arc_tolerance = whole(r, 0, 1) ? 0 : std::pow(10, uniform(r, -5, -1));
  return x;
}

static bool same(const ofg::Answer& a, const ofg::Answer& b) {
  return a.hit == b.hit && (a.time == b.time || (a.time != a.time && b.time != b.time)) &&
         a.found == b.found && a.face_a == b.face_a && a.face_b == b.face_b &&
         a.counts.face_pairs == b.counts.face_pairs && a.counts.evaluated == b.counts.evaluated;
}

// A screen may change what it costs, and nothing else; nor may asking several poses at once. (What
// is "inside" a mesh that bounds no solid, as many do here, is anything: a plane between the two
// may well contradict it.)
static bool same_but_for_cost(const ofg::Answer& a, const ofg::Answer& b) {
  if (a.found == ofg::Found::inside) return true;
  return a.hit == b.hit && (a.time == b.time || (a.time != a.time && b.time != b.time)) &&
         a.found == b.found && a.face_a == b.face_a && a.face_b == b.face_b &&
         a.piece_a == b.piece_a && a.piece_b == b.piece_b;
}

// The article's plain steps, and the same with accelerations: one answer, and his counts.
template <class T>
const char* unlike_the_article(Pair<T>& pair, const ofg::Track& still, const ofg::Track& moving,
                               const ofg::Options& asked) {
  ofg::Options o;
  o.k = asked.k, o.order = asked.order, o.broad = asked.broad, o.iterations = asked.iterations;
  o.toi = asked.toi == ofg::Toi::bisection ? ofg::Toi::halving : asked.toi;
  // In float a virtual edge may seem to pass a sliver, whose normal is mostly rounding, where a
  // plane proves that it does not.
  const auto sliver = [&](const ofg::Answer& a) {
    if (a.found != ofg::Found::edge_face) return false;
    const ofg::Mesh<T>& m = a.piece_b < 0 ? pair.b.whole : pair.b.pieces[std::size_t(a.piece_b)];
    return std::is_same_v<T, float> && ofg::detail::sliver(m.triangle(a.face_b));
  };
  const auto unlike = [&](const ofg::Answer& a, const ofg::Answer& b) {
    if (sliver(a)) return false;
    return !same_but_for_cost(a, b) || a.counts.face_pairs != b.counts.face_pairs ||
           a.counts.edge_faces != b.counts.edge_faces || a.counts.distances != b.counts.distances;
  };
  if (unlike(ofg::article::overlap(pair.a, pair.b, still, o, pair.w),
             ofg::overlap(pair.a, pair.b, still, o, pair.w)))
    return "an acceleration changed an overlap of the article";
  if (unlike(ofg::article::sweep(pair.a, pair.b, moving, o, pair.w),
             ofg::sweep(pair.a, pair.b, moving, o, pair.w)))
    return "an acceleration changed a sweep of the article";
  return nullptr;
}

template <class T>
const char* fault(Pair<T>& pair, const Asked& x) {
  const ofg::Track still(x.p, x.q), moving(x.p, x.q, x.m, x.n);
  ofg::Answer first[2];
  for (int isa = 0; isa <= int(ofg::widest_isa()); ++isa) {
    ofg::set_isa(ofg::Isa(isa));
    const ofg::Answer now[2] = {ofg::overlap(pair.a, pair.b, still, x.o, pair.w),
                                ofg::sweep(pair.a, pair.b, moving, x.o, pair.w)};
    for (int i = 0; i < 2; ++i) {
      if (isa == 0) first[i] = now[i];
      if (!same(first[i], now[i])) return "instruction sets disagree";
    }
    ofg::Options o = x.o;
    o.screen = true;
    if (!same_but_for_cost(first[0], ofg::overlap(pair.a, pair.b, still, o, pair.w)))
      return "a screen changed an overlap";
    if (!same_but_for_cost(first[1], ofg::sweep(pair.a, pair.b, moving, o, pair.w)))
      return "a screen changed a sweep";
    const ofg::Pose p[2] = {x.q, x.p}, q[2] = {x.p, x.q};
    ofg::Answer two[2];
    ofg::overlap_many(pair.a, pair.b, p, q, 2, o, pair.w, two);
    if (!same_but_for_cost(first[0], two[1])) return "a batch changed an overlap";
  }
  for (const auto& a : first) {
    if (a.time == a.time && !(a.time >= 0 && a.time <= 1)) return "a time outside the step";
    if (a.hit != (a.found != ofg::Found::nothing)) return "a hit that nothing made";
    if (!a.hit && (a.face_a != -1 || a.time == a.time))
      return "a clear answer with faces or a time";
    const int na = pair.a.whole.size(), nb = pair.b.whole.size();
    if (a.face_a >= na || a.face_b >= nb) return "a face that is not there";
  }
  const bool all = ofg::brute_force::overlap(pair.a, pair.b, still).hit;
  if (first[0].hit && first[0].found == ofg::Found::start && !all)
    return "faces met that do not meet";
  if (!first[0].hit && all && (x.o.k == 1000000 || x.o.adaptive_k))
    return "all faces were asked, and a hit was missed";
  return unlike_the_article(pair, still, moving, x.o);
}

int main(int argc, char** argv) {
  const long queries = argc > 1 ? std::atol(argv[1]) : 1000000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1e9;
  Random random(argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
  const auto begin = std::chrono::steady_clock::now();
  const auto gone = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  long done = 0, hits = 0;
  while (done < queries && gone() < seconds) {
    std::string what;
    const Shape s = shape(random, what), t = shape(random, what);
    const double scale = whole(random, 0, 3) ? 1 : std::pow(2, whole(random, -20, 20));
    Shape u = s, v = t;
    for (auto* z : {&u, &v})
      for (auto& c : z->v) c *= scale;
    Pair<double> fine{
        body<double>(u, whole(random, 0, 1)), body<double>(v, whole(random, 0, 1)), {}};
    Pair<float> coarse{
        body<float>(u, whole(random, 0, 1)), body<float>(v, whole(random, 0, 1)), {}};
    fine.w.reserve(fine.a, fine.b), coarse.w.reserve(coarse.a, coarse.b);
    for (int i = 0; i < 25 && done < queries; ++i, ++done) {
      const Asked x = query(random, scale);
      const char* f = fault(fine, x);
      if (!f) f = fault(coarse, x);
      hits += f == nullptr && ofg::overlap(fine.a, fine.b, {x.p, x.q}, x.o, fine.w).hit;
      if (f) {
        std::printf("query %ld: %s (shapes:%s; scale %g; k %d; faces %d, %d)\n", done, f,
                    what.c_str(), scale, x.o.k, fine.a.whole.size(), fine.b.whole.size());
        return 1;
      }
    }
  }
  std::printf(
      "%ld queries in both precisions and all instruction sets, %ld of them overlaps: no fault\n",
      done, hits);
  return 0;
}
