// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// When do the interiors of two convex bodies meet first, while they translate? A ray is shot at
// M = A - B: seen along the displacement M is a plane figure, in which a portal finds the triangle
// that the ray enters by, or a line that proves that it passes by.
#pragma once
#include "verified.hpp"
#include "verified_impact.hpp"
#include "verified_motion.hpp"

namespace ofg::verified {
namespace detail {

// Where the origin, as M moves by t d, is still in front of a plane across n it is apart from M,
// and so at every time before that, if it is at the start: the gap is linear in t.
struct Shot {
  const Hull &a, &b;
  const Pose &pose_a, &pose_b;
  const Vec3<double>&way_a, &way_b;  // displacements, in the world
  Posed at;                          // at the start; slack covers the displacement too
  Vec3<double> d;                    // of A relative to B in B's axes, in units of `at`
  double until;                      // what comes later is not asked about
  Impact& impact;
  Counts& counts = impact.counts;
  double sure = -1;     // proved clear until then, if not negative
  Vec3<double> inside;  // of M, at the start
  Mat3<double> back;    // from B's axes to A's
  const ExtremeLists *lists_a, *lists_b;

  Shot(const Hull& a_, const Hull& b_, const Pose& pa, const Pose& pb, const Vec3<double>& da,
       const Vec3<double>& db, double until_, Impact& into)
      : a(a_),
        b(b_),
        pose_a(pa),
        pose_b(pb),
        way_a(da),
        way_b(db),
        at(a_, b_, pa, pb),
        until(until_),
        impact(into) {
    const Vec3<double> relative = da - db;
    d = rotation(pb.q).transposed() * relative * at.unit;
    // Rounding d: 1 unit from the difference, 30 from the matrix, 6 from the sums; t d added: 2.
    at.slack += 256 * unit_roundoff * length(d);
    at.sure &= at.slack < 1e100;
    inside = at.between + beside(a, b, 0) * at.unit;
    back = at.r.transposed();
    lists_a = a.extreme_lists(), lists_b = b.extreme_lists();
  }

  // The support along n, and what its plane proves. True where that is a clear of the whole step.
  bool passes(const Vec3<double>& n, Support& s) {
    const Vec3<double> turned = back * n;
    const Ends ends = least_apart(a, lists_a, -turned, b, lists_b, -n);
    s.a = ends.a, s.b = ends.b;
    s.point = (at.r * s.a - s.b) * at.unit + at.between;
    s.height = (dot(turned, s.a) - dot(n, s.b)) * at.unit + dot(n, at.between);
    counts.distances += a.size() + b.size();
    ++counts.full_tests;
    const double gap = -s.height - at.slack * length(n), speed = dot(n, d);
    if (!(gap > 0)) return false;
    // The speed is off by 43 units of |n| |d|, for which slack has room, the quotient by a few
    // units of itself.
    sure = std::fmax(sure, speed > gap ? gap / speed * (1 - 8 * unit_roundoff) : 1.0);
    return sure >= until;
  }

  // v without its component along the displacement.
  Vec3<double> across(const Vec3<double>& v) const { return v - d * (dot(v, d) / dot(d, d)); }

  // Of the figure: the corners of an edge with the origin between it and the inside, seen along d.
  // unsure: the origin is on the outline, as far as doubles can tell.
  Verdict aim(Support (&v)[3]) {
    const Vec3<double> c = across(inside);
    Vec3<double> n = -c;
    if (!(dot(c, c) > 1e-24 * dot(inside, inside)))
      n = std::abs(d.x) < std::abs(d.y) ? cross(d, {1, 0, 0}) : cross(d, {0, 1, 0});
    if (passes(n, v[0])) return Verdict::apart;
    // n: across the line from inside through v[0], on the origin's side.
    const auto beyond = [&](const Vec3<double>& corner) {
      const Vec3<double> m = cross(d, corner - inside);
      return dot(m, c) > 0 ? -m : m;
    };
    for (int step = 0;; ++step) {
      if (step == most_steps) return Verdict::unsure;
      n = beyond(v[0].point);
      if (!(dot(n, n) > 1e-120)) return Verdict::unsure;
      if (passes(n, v[1])) return Verdict::apart;
      const Vec3<double> m = cross(d, v[1].point - inside);
      if (dot(m, v[0].point - inside) * dot(m, -c) >= 0) break;  // the wedge holds the origin
      v[0] = v[1];
    }
    for (int step = 0; step < most_steps; ++step) {
      n = cross(d, v[1].point - v[0].point);
      if (dot(n, v[0].point - inside) < 0) n = -n;
      if (dot(n, v[0].point) >= 0) return Verdict::meeting;
      if (!(dot(n, n) > 1e-120)) return Verdict::unsure;
      if (passes(n, v[2])) return Verdict::apart;
      if (!(dot(n, v[2].point - v[0].point) > at.slack * length(n))) return Verdict::unsure;
      const Vec3<double> m = cross(d, v[2].point - inside);
      v[dot(m, v[0].point - inside) * dot(m, -c) >= 0 ? 1 : 0] = v[2];
    }
    return Verdict::unsure;
  }

  // Moves the triangle towards the ray's start until it is on M's surface. The time at which the
  // ray meets it; NaN where doubles do not settle that.
  double enter(Support (&v)[3], Vec3<double>& n) {
    v[2].point = inside, v[2].a = v[2].b = {};
    if (triple(v[0].point, v[1].point, d) < 0) std::swap(v[0], v[1]);
    for (int step = 0; step < most_steps; ++step) {
      n = cross(v[1].point - v[0].point, v[2].point - v[0].point);
      if (dot(n, d) < 0) n = -n;
      const double speed = dot(n, d), size = length(n);
      if (!(speed > 1e-14 * size * length(d)) || !(size > 1e-100)) break;
      const double time = -dot(n, v[0].point) / speed;
      Support s;
      if (passes(n, s)) return time;
      const double gained = dot(n, s.point - v[0].point);
      if (!(gained > 2 * at.slack * size) || gained < 0.05 * widest_bracket * speed) return time;
      // The ray goes through one of three triangles at s.
      const double side[3] = {triple(s.point, v[0].point, d), triple(s.point, v[1].point, d),
                              triple(s.point, v[2].point, d)};
      int gone = 2;
      for (int i = 0; i < 3; ++i)
        if (side[i] >= 0 && side[(i + 1) % 3] <= 0) gone = (i + 2) % 3;
      v[gone] = s;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  // At time t, by the tetrahedron of the triangle and a point inside, or by any other portal.
  bool meets(double t, const Support (&v)[3]) {
    Posed then = at;
    then.between = at.between + d * t;
    then.slack *= std::fmax(1.0, std::abs(t));  // it counts d once, and `over` asks about the past
    const Vec3<double> c[4] = {inside + d * t, v[0].point + d * t, v[1].point + d * t,
                               v[2].point + d * t};
    ++counts.face_pairs;
    if (holds_origin(c, then.slack + then.away)) return true;
    const int starts = a.inner + b.inner > 0 ? most_starts : 1;
    for (int i = 0; i < starts; ++i) {
      Proof proof;
      Search{a, b, then, counts, proof}.run(i);
      if (proof.verdict != Verdict::unsure) return proof.verdict == Verdict::meeting;
    }
    return false;
  }

  bool meets_exactly_until(double t) {
    Vec3<double> axis;
    ++counts.steps;
    const Vector way = (Vector(way_a) - Vector(way_b)) * Number(t);
    return meets_exactly(a, b, pose_a, pose_b, Portal(), axis, way);
  }

  // By exact arithmetic alone. The bracket is halved until it is narrow enough.
  void exactly(double from, double guess) {
    double to = guess;
    if (!meets_exactly_until(to)) {
      from = to, to = until;
      if (guess >= until || !meets_exactly_until(to)) return;
    }
    while (to - from > 0.9 * widest_bracket) {
      const double middle = 0.5 * (from + to);
      (meets_exactly_until(middle) ? to : from) = middle;
    }
    impact.set(from, to);
  }

  // Which features the triangle has.
  void name(const Support (&v)[3], const Vec3<double>& n) {
    const auto kinds = [&](auto point) {
      return 1 + !(point(v[1]) == point(v[0])) +
             !(point(v[2]) == point(v[0]) || point(v[2]) == point(v[1]));
    };
    const int of_a = kinds([](const Support& s) { return s.a; }),
              of_b = kinds([](const Support& s) { return s.b; });
    impact.found = of_a == 1   ? Found::edge_face
                   : of_b == 1 ? Found::face_edge
                   : of_a == 2 ? Found::edge_edge
                               : Found::within;
    impact.face_a = a.opposing.face(at.r.transposed() * n);
    impact.face_b = b.opposing.face(-n);
  }

  void run() {
    Support v[3];
    Vec3<double> n;
    double time = std::numeric_limits<double>::quiet_NaN();
    if (at.sure && dot(d, d) > 0) {
      ++counts.spheres;
      if (by_spheres(a, b, pose_a, pose_b) == Verdict::meeting && start()) return;
      if (passes(-at.between, v[0])) return;
      const Verdict said = aim(v);
      if (said == Verdict::apart) return;
      if (said == Verdict::meeting) time = enter(v, n);
      if (sure >= until) return;
    }
    if (!(sure > 0) && (start() || over(time, v))) return;
    const double from = std::fmax(sure, 0.0), to = std::fmin(from + 0.9 * widest_bracket, until);
    if (to >= time && meets(to, v))
      impact.set(from, to);
    else
      exactly(from, std::fmin(std::fmax(to, time + 0.1 * widest_bracket), until));
    if (!impact.hit) return;
    impact.found = Found::within;
    if (time == time) name(v, n);
  }

  // Do they meet at the start?
  bool start() {
    const Answer at_start = overlap(a, b, pose_a, pose_b);
    Counts all = counts;
    all.add(at_start.counts);
    if (at_start.hit) impact = Impact::at_start(at_start);
    impact.counts = all;
    return at_start.hit;
  }

  // The times at which two convex bodies meet are an interval. Where it holds a time before the
  // start and not the start, it is over.
  bool over(double time, const Support (&v)[3]) { return time < 0 && meets(0.98 * time, v); }
};

}  // namespace detail

// When the interiors of two hulls meet first as A moves by way_a and B by way_b, in the world, over
// the step [0, 1]; in a bracket that is proved to hold that time. A clear is one of [0, until].
// Every answer is proved. Hulls that are flat have no interior; do not ask.
inline Impact translation(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb,
                          const Vec3<double>& way_a, const Vec3<double>& way_b, double until = 1) {
  Impact impact;
  impact.counts.steps = 1;
  detail::Shot(a, b, pa, pb, way_a, way_b, until, impact).run();
  return impact;
}

}  // namespace ofg::verified
