// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// When do the interiors of two convex bodies meet first, while they translate and rotate? Plane
// after plane carries the proof that they are apart from one time to a later one, until a portal
// proves that they meet.
#pragma once
#include "verified.hpp"
#include "verified_impact.hpp"
#include "verified_plane.hpp"

namespace ofg::verified {
namespace detail {

constexpr int most_segments = 4000;

struct March {
  const Moving& m;
  const Pose &pose_a, &pose_b;
  Impact& impact;
  Counts& counts = impact.counts;
  double from = 0, end;  // clear until the one; after the other too
  bool hit_at_end = false, done = false;
  Simplex simplex{};
  Vec3<double> axis{};  // the first to try

  // Gaps of planes of every kind are worth something above it.
  double touch() const { return 3 * m.slack; }

  // The times at which the spheres about the pivots meet. False where there are none.
  bool window() {
    ++counts.spheres;
    const double sum = m.of_a.reach + m.of_b.reach + m.slack, square = dot(m.d, m.d);
    if (!(square > 0)) return !(dot(m.p, m.p) > sum * sum);
    const double nearest = -dot(m.p, m.d) / square;
    const double apart = length(m.pivots(std::fmin(std::fmax(nearest, 0.0), end)));
    if (apart > sum) return false;
    const Vec3<double> closest = m.pivots(nearest);
    const double room = sum * sum - dot(closest, closest);
    if (!(room > 0)) return true;
    const double half = std::sqrt(room / square) * (1 + 1e-9) + 1e-12 * (1 + std::abs(nearest));
    from = std::fmax(from, nearest - half), end = std::fmin(end, nearest + half);
    return from <= end;
  }

  // One plane, normal to the line of centres where the pivots are nearest: until when it keeps them
  // apart. Where inscribed spheres meet then, they meet by then. True where the answer is clear.
  bool passes() {
    const double square = dot(m.d, m.d), nearest = square > 0 ? -dot(m.p, m.d) / square : 0;
    const Instant middle = m.at(std::fmin(std::fmax(nearest, from), end));
    const double size = length(middle.between);
    axis = middle.between;
    if (size + m.slack + m.away < (m.a.inner + m.b.inner) * m.unit) {
      end = middle.t, hit_at_end = true;
      return false;
    }
    if (!(size > 0)) return false;
    const Plane plane = Plane::fixed(Frame::world, middle.between * (1 / size), middle);
    const Gap first = height(plane, m.at(from));
    simplex.add(first);
    const double at_from = first.along - m.slack;
    if (!(at_from > 0)) return false;
    const double at_end = height(plane, m.at(end)).along - m.slack, h = end - from;
    const double share = sure_share(at_from, at_end, plane.bound(m, from, end, middle), h);
    from += share * h;
    return share == 1;
  }

  Gap height(const Plane& plane, const Instant& now) {
    counts.distances += m.a.size() + m.b.size(), ++counts.full_tests;
    return gap(m, now, plane.normal(now));
  }

  // The edges of the two that are nearest, and the plane normal to both where it separates well.
  bool edges(const Instant& now, const Apart& apart, Plane& plane, Gap& g) {
    const auto edge = [&](auto of) {
      for (int i = 1; i < simplex.n; ++i)
        if (!(of(simplex.p[i]) == of(simplex.p[0]))) return of(simplex.p[i]) - of(simplex.p[0]);
      return Vec3<double>();
    };
    const Vec3<double> ea = edge([](const Gap& x) { return x.a; }),
                       eb = edge([](const Gap& x) { return x.b; });
    plane.frame = Frame::edges;
    plane.ea = ea * (1 / length(ea)), plane.eb = eb * (1 / length(eb));
    if (dot(plane.normal(now), apart.axis) < 0) plane.ea = -plane.ea;
    const double size = length(plane.normal(now));
    if (!(size > 1e-6)) return false;
    g = height(plane, now);
    return g.along > 0.5 * apart.gap.along * size && g.along > touch();
  }

  Plane choose(const Instant& now, const Apart& apart, int segment, Gap& g) {
    const auto of_a = [](const Gap& x) { return x.a; };
    const auto of_b = [](const Gap& x) { return x.b; };
    const int in_a = simplex.kinds(of_a), in_b = simplex.kinds(of_b);
    Plane plane;
    if (in_a == 2 && in_b == 2 && segment % 3 != 2 && edges(now, apart, plane, g)) return plane;
    g = apart.gap;
    bool with_a = in_b == 1, with_b = !with_a && in_a == 1;
    if (!with_a && !with_b) {
      const auto span = [&](auto of) {
        double most = 0;
        for (int i = 1; i < simplex.n; ++i) {
          const Vec3<double> e = of(simplex.p[i]) - of(simplex.p[0]);
          most = std::fmax(most, dot(e, e));
        }
        return most;
      };
      with_a = span(of_a) > 4 * span(of_b), with_b = !with_a;
    }
    if (segment >= 16 && segment % 3 == 0) std::swap(with_a, with_b);
    const Frame frame = with_a && m.of_a.turns()   ? Frame::with_a
                        : with_b && m.of_b.turns() ? Frame::with_b
                                                   : Frame::world;
    return Plane::fixed(frame, apart.axis, now);
  }

  // How far to try.
  double reach(double f, double slope, double bound, int segment) const {
    if (!(bound > 0)) return slope < 0 ? f / -slope + 0.3 * widest_bracket : 1;
    const double q = slope * slope / (2 * bound * f);
    if (slope < 0 && q > (segment < 8 ? 0.25 : 1.3)) return f / -slope + 0.3 * widest_bracket;
    return (slope < 0 ? 0.7 : 0.75) * std::sqrt(8 * f / bound);
  }

  // Do the nearest features, carried on to a time at which they have passed each other, and a point
  // inside hold the origin? Of two edges both halves of the parallelogram that they span are tried.
  bool passed(const Instant& now) {
    if (simplex.n < 2) return false;
    const double margin = m.slack + m.away;
    const Vec3<double> v0 = now.between + beside(m.a, m.b, 0) * m.unit;
    const auto between = [&](const Gap& of_a, const Gap& of_b) {
      return (now.a * of_a.a - now.b * of_b.b) * m.unit + now.between;
    };
    const auto holds = [&](const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& r) {
      ++counts.face_pairs;
      const Vec3<double> v[4] = {v0, p, q, r};
      return holds_origin(v, margin);
    };
    const Gap(&s)[4] = simplex.p;
    if (simplex.n == 3 && holds(between(s[0], s[0]), between(s[1], s[1]), between(s[2], s[2])))
      return true;
    const Gap *a = nullptr, *b = nullptr;  // the other ends of the edges from the first corner
    for (int i = 1; i < simplex.n; ++i) {
      if (!a && !(s[i].a == s[0].a)) a = &s[i];
      if (!b && !(s[i].b == s[0].b)) b = &s[i];
    }
    if (!a || !b) return false;
    const Vec3<double> p = between(s[0], s[0]), q = between(*a, s[0]), r = between(*a, *b),
                       t = between(s[0], *b);
    return holds(p, q, r) || holds(p, r, t);
  }

  bool meets(const Instant& now) {
    if (passed(now)) return true;
    const Posed at = m.posed(now);
    const int starts = m.a.inner + m.b.inner > 0 ? most_starts : 1;
    for (int i = 0; i < starts; ++i) {
      Proof proof;
      Search{m.a, m.b, at, counts, proof}.run(i);
      if (proof.verdict != Verdict::unsure) return proof.verdict == Verdict::meeting;
    }
    return false;
  }

  void name(const Instant& now, const Vec3<double>& n) {
    const int in_a = simplex.kinds([](const Gap& x) { return x.a; }),
              in_b = simplex.kinds([](const Gap& x) { return x.b; });
    impact.found = in_a == 1   ? Found::edge_face
                   : in_b == 1 ? Found::face_edge
                   : in_a == 2 ? Found::edge_edge
                               : Found::within;
    impact.face_a = m.a.opposing.face(now.a.transposed() * -n);
    impact.face_b = m.b.opposing.face(now.b.transposed() * n);
  }

  // Apart until `from`, and there too near to tell: the next time at which they are proved to meet,
  // or none. True where they part again.
  bool touching() {
    if (from == 0 && (at_start() || (from = parting()) > 0)) return !impact.hit;
    for (double after = 0.9 * widest_bracket; from < end; after *= 2) {
      const Instant then = m.at(std::fmin(from + after, end));
      if (meets(then)) {
        impact.set(from, then.t), name(then, axis);
        return false;
      }
      if (then.t == end) break;
    }
    unproved();
    return false;
  }

  // Hulls that touch at the start, clear as exact arithmetic says by a plane: until when their
  // vertices near it all recede from it, and the others are too far to reach it. 0 if they do not.
  double parting() {
    Vec3<double> out;
    if (meets_exactly(m.a, m.b, pose_a, pose_b, Portal(), out)) return 0;
    ++counts.steps;
    const Instant now = m.at(0);
    const Vec3<double> n = out * (-1 / length(out));
    const Plane plane = Plane::fixed(Frame::world, n, now);
    const double bound = plane.bound(m, 0, end, now), most = length(m.d) +
                                                             std::abs(m.of_a.angle) * m.of_a.swing +
                                                             std::abs(m.of_b.angle) * m.of_b.swing;
    for (const double near : {1e-2, 1e-4, 1e-6, 1e-8}) {
      const double rate = slowest(m.a, m.of_a, now.a, n, near) +
                          slowest(m.b, m.of_b, now.b, -n, near) + dot(n, m.d) - 1e-12 * most;
      if (!(rate > 0)) continue;
      const double room = near - m.slack, until = std::fmin(room / (2 * most), rate / bound);
      axis = n;
      return std::fmin(std::fmin(until, std::sqrt(0.5 * room / bound)), end);
    }
    return 0;
  }

  // The least rate along n of a hull's vertices within `near` of the least along n, as it turns.
  double slowest(const Hull& hull, const Turning& turning, const Mat3<double>& r,
                 const Vec3<double>& n, double near) const {
    const Vec3<double> in = r.transposed() * n,
                       turn = r.transposed() * cross(n, turning.axis) * turning.angle;
    double least = std::numeric_limits<double>::infinity(), rate = least;
    for (int i = 0; i < hull.size(); ++i) least = std::fmin(least, dot(in, hull.point(i)));
    for (int i = 0; i < hull.size(); ++i) {
      if ((dot(in, hull.point(i)) - least) * m.unit > near) continue;
      rate = std::fmin(rate, dot(turn, hull.point(i) * m.unit + turning.arm));
    }
    return rate;
  }

  void unproved() {
    impact.hit = true, impact.time = from, impact.proved = false;
    if (hit_at_end) impact.latest = end;
    impact.found = Found::within;
  }

  bool at_start() {
    const Answer start = overlap(m.a, m.b, pose_a, pose_b);
    Counts all = counts;
    all.add(start.counts);
    if (start.hit) impact = Impact::at_start(start);
    impact.counts = all;
    return start.hit;
  }

  // Is the plane that of a vertex at a face, or of two edges?
  bool fits(const Plane& plane) const {
    if (plane.frame == Frame::edges) return true;
    return simplex.n == 3 && (simplex.kinds([](const Gap& x) { return x.a; }) == 1 ||
                              simplex.kinds([](const Gap& x) { return x.b; }) == 1);
  }

  // Where the march stands: a plane that separates `now`, and its gap there.
  struct Stand {
    Instant now;
    Plane plane{};
    Gap gap{};
    bool goes_on = false;  // with the same plane: Newton's method is at work on it
  };

  // A new plane. False where the hulls are too near for one.
  bool find(Stand& at, int segment) {
    const double share = segment < 8 ? 0.5 : 0.99;
    const Apart apart = apart_at(m, at.now, axis, touch(), share, simplex, counts);
    if (apart.found)
      at.plane = choose(at.now, apart, segment, at.gap);
    else
      touched(at);
    return apart.found;
  }

  void touched(Stand& at) {
    done = !touching();
    at = {m.at(from)}, simplex.n = 0;
  }

  // Carries the proof on by the plane, until which time it is sure, or to the contact.
  void advance(Stand& at, int segment) {
    const double margin = at.plane.margin(m), f = at.gap.along - margin,
                 slope = at.plane.slope(m, at.now, at.gap), before = from;
    const auto bound = [&](double to) { return at.plane.bound(m, before, to, at.now); };
    // As the bound grows with the interval, it is that of one about as long.
    double h = reach(f, slope, bound(from), segment);
    h = reach(f, slope, bound(std::fmin(from + h, end)), segment);
    const Instant then = m.at(std::fmin(from + h, end));
    const Gap ended = height(at.plane, then);
    const double at_then = ended.along - margin, step = then.t - from,
                 sure = sure_share(f, at_then, bound(then.t), step);
    from = sure == 1 ? then.t : from + sure * step;
    done = sure == 1 && then.t == end;
    if (done) return;
    if (at_then < 0 && then.t - from <= 0.95 * widest_bracket && meets(then)) {
      impact.set(from, then.t), name(then, at.plane.normal(then));
      done = true;
      return;
    }
    at.goes_on = sure == 1 && slope < 0 && at_then > 0 && at_then < 0.02 * f && fits(at.plane);
    at.now = sure == 1 ? then : m.at(from), at.gap = ended;
    axis = at.plane.normal(at.now);
    if (!at.goes_on) simplex.add(ended);
    if (!(from > before)) touched(at);
  }

  void run() {
    if (!m.sure) {
      if (!at_start()) unproved();
      return;
    }
    if (!window() || passes()) return;
    Stand at{m.at(from)};
    for (int segment = 0; segment < most_segments && !done; ++segment) {
      ++counts.steps;
      if (at.goes_on || find(at, segment)) advance(at, segment);
    }
    if (!done) unproved();
  }
};

}  // namespace detail

// When the interiors of two hulls meet first as both move, in a bracket that is proved to hold that
// time. A clear is one of [0, until] and proved; a hit that could not be told from touching is
// flagged. Hulls that are flat have no interior; do not ask.
inline Impact march(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb, const Motion& ma,
                    const Motion& mb, double until = 1) {
  Impact impact;
  impact.counts.steps = 1;
  const Moving moving(a, b, pa, pb, ma, mb);
  detail::March{.m = moving, .pose_a = pa, .pose_b = pb, .impact = impact, .end = until}.run();
  return impact;
}

}  // namespace ofg::verified
