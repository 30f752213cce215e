// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// What is proposed for two solids: at one instant, and over the step.
#pragma once
#include <cstdio>
#include <string>

#include "solid_depth.hpp"

namespace truth {

struct Instant {
  std::string label = "uncertain";
  double gap = 0;
  std::vector<Elements> stuck;  // where uncertain: neither apart nor shown to share a point
  Tree tree;
  Common common;
};

struct Proof {
  std::string label = "uncertain", reason, start = "uncertain";
  double t_lo = 0, t_hi = 0, gap = 0, depth = 0;
  Tree tree;
  Common common;
  Instant end;
  std::vector<Elements> stuck;
};

inline std::string digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

class Prover : public Depths {
 public:
  using Depths::Depths;

  Instant at(double t) {
    Instant out;
    attempts_ = 0;
    if (single() && !A_.mesh && !B_.mesh) {
      if (!settle(quick(0, 0), t, out) && !settle_near(t, out)) {
        Exact e(*this, 0, 0);
        if (!settle(e.placed, t, out)) untouched(t, out);
      }
      return out;
    }
    double apart = 1e300;
    bool found = false;
    nearest(0, 0, t, apart, &out.common, &found);
    if (found) {
      out.label = "hit";
      return out;
    }
    if (apart > 1e3 * blur_)
      for (double share : {0.99, 0.5}) {
        Cover c = cover(t, t, share * apart, nullptr);
        if (!c.stuck.empty()) continue;
        out.label = contained(t, out.common) ? "hit" : "clear";
        out.gap = share * apart, out.tree = std::move(c.tree);
        return out;
      }
    Cover c = cover(t, t, 0, &out.common);
    if (c.found)
      out.label = "hit";
    else if (c.stuck.empty()) {
      out.label = contained(t, out.common) ? "hit" : "clear";
      out.tree = std::move(c.tree);
    } else if (anywhere(t, out.common))
      out.label = "hit";
    else
      out.stuck = elements(c);
    return out;
  }
  Proof sweep() {
    Proof p;
    Instant start = at(0);
    p.start = start.label;
    if (start.label == "hit") {
      p.label = "hit", p.common = start.common;
      finish(p);
      return p;
    }
    if (start.label == "uncertain") {
      p.reason = why("touching at the start"), p.stuck = start.stuck;
      return p;
    }
    Cover c = cover(0, 1, 0, nullptr);
    if (effort_.spent()) {
      p.reason = why("");
      return p;
    }
    p.tree = std::move(c.tree);
    if (c.stuck.empty()) {
      p.label = "clear";
      widen(p, c);
      return p;
    }
    p.t_lo = c.until;
    for (double rel : {2e-13, 6e-13, 1e-11, 1e-9, 1e-6, 1e-4, 1e-2, 1.0}) {
      if (rel > 1e-6 && p.t_lo * rel > 1e-12) break;
      p.t_hi = p.t_lo > 0 ? std::min(1.0, p.t_lo * (1 + rel))
                          : 1e-12 * rel;  // 0: they touch at the start
      if (!(p.t_hi > p.t_lo)) break;
      if (!meets_at(p.t_hi, c, p.common)) continue;
      p.label = "hit";
      finish(p);
      return p;
    }
    p.reason = why("touching without overlap that could be certified, at t = " + digits(p.t_lo));
    p.stuck = elements(c);
    return p;
  }

 private:
  void finish(Proof& p) {
    p.end = at(1);
    // Deepest of instants at growing distances from the impact (a thin wall is crossed in a small
    // part of the step).
    const bool meshes = A_.mesh || B_.mesh;
    auto depth_of = [&](double t) {
      Instant there;
      if (meshes) there = at(t);
      return !meshes || there.label == "hit" ? depth_at(t, there.common) : 0.0;
    };
    p.depth = depth_at(p.t_hi, p.common);
    double best = p.t_hi, ratio = meshes ? 0.03 : 0.2, rest = 1 - p.t_hi;
    for (double f = 1; f > 1e-11 && p.t_hi + f * rest > p.t_hi; f *= ratio) {
      double d = depth_of(p.t_hi + f * rest);
      if (d > p.depth) p.depth = d, best = p.t_hi + f * rest;
    }
    double lo = p.t_hi + (best - p.t_hi) * ratio,
           hi = std::min(1.0, p.t_hi + (best - p.t_hi) / ratio);
    for (int i = 1; i < (meshes ? 3 : 9) && hi > lo; ++i)
      p.depth = std::max(p.depth, depth_of(lo + (hi - lo) * i / (meshes ? 3 : 9)));
  }
  std::string why(std::string otherwise) const {
    return effort_.spent() ? "the effort limit of " + std::to_string((long long)effort_.limit) +
                                 " vertex visits ran out"
                           : otherwise;
  }
  // Two single elements that touch at t, with a seed there; else they are stuck.
  void untouched(double t, Instant& out) const {
    auto s = seed(0, 0);
    if (s && t <= s->end) {
      out.label = "clear";
      out.tree.nodes.push_back({{planted(*s, t)}});
    } else
      out.stuck = {elements(0, 0)};
  }
  bool settle_near(double t, Instant& out) {
    if (A_.nodes[0].v.size() + B_.nodes[0].v.size() < 24) return false;
    Near near(*this, 0, 0, t);
    Instant found;
    if (!near.placed || !settle(*near.placed, t, found)) return false;
    if (found.label == "hit")
      for (int i = 0; i < 4; ++i)
        found.common.a[i] = near.ids_a[found.common.a[i]],
        found.common.b[i] = near.ids_b[found.common.b[i]];
    else {
      Exact e(*this, 0, 0);
      auto n = unwide(found.tree.nodes[0].segments[0].n);
      double sure = width(e.placed, t, n) / double(norm(n)) - e.placed.blur();
      if (!(sure > 32 * e.placed.blur())) return false;
      found.gap = claimed(sure);
    }
    out = found;
    return true;
  }
  // A gap a little below the certain one, so that the checker's doubles can agree: they err more
  // than ours.
  double claimed(double sure) const {
    double low = sure - 48 * blur_;
    return std::min(low > 0.99 * sure ? low : sure, sure * (1 - 1e-9));
  }
  template <class T>
  bool settle(Placed<T>&& P, double t, Instant& out) {
    return settle(P, t, out);
  }
  template <class T>
  bool settle(Placed<T>& P, double t, Instant& out) {  // one convex pair
    const auto &x = P.a(t), &y = P.b(t);
    auto g = gjk<T>(x, y, y[0] - x[0], P.reach, 1e-9);
    if (g.status == Status::Apart) {
      double gap = double(norm(g.v));
      auto n = g.v * T(1 / gap);
      double trust = 32 * P.blur();
      if (!(gap > trust) || !leaf(P, t, t, 'W', n, T(0.5 * trust))) return false;
      double sure = width(P, t, n) / double(norm(n)) - P.blur();
      out.label = "clear", out.gap = claimed(sure);
      out.tree.nodes.push_back({{{t, 'W', wide(n)}}});
      return true;
    }
    auto w = inside<T>(x, y, P.reach);
    if (!w) return false;
    out.label = "hit", out.common = {w->point, 0, 0, w->a, w->b};
    return true;
  }
  template <class T>
  static double width(Placed<T>& P, double t, vec<T> n) {  // |n| times the distance along n
    const auto &x = P.a(t), &y = P.b(t);
    return double(dot(n, y[support(y, -n)]) - dot(n, x[support(x, n)]));
  }

  // A clear sweep: prove it again with a margin close to the least distance, which the places where
  // that fails help to find.
  void widen(Proof& p, const Cover& c) {
    if (!sd_.turns() && single()) {
      if (!swept(quick(0, 0), p)) {
        Exact e(*this, 0, 0);
        swept(std::move(e.placed), p);
      }
      return;
    }
    double least = single() ? c.least : 1e300;  // of groups it would be that of their hulls
    const int n = single() ? 16 : 12;
    int best = 0;
    double lowest = 1e300;
    for (int i = 0; i <= n; ++i) {
      double d = distance(double(i) / n);
      if (d < lowest) lowest = d, best = i;
    }
    least = std::min(least, lowest);
    least = std::min(least, dip(double(best) / n, 1.0 / n));
    if (single() && std::abs(c.at - double(best) / n) > 1.0 / n)
      least = std::min(least, dip(c.at, 1.0 / n));
    for (double share : {0.98, 0.95, 0.95, 0.8, 0.4, 0.1}) {
      if (!(share * least > 64 * blur_)) return;
      Cover again = cover(0, 1, share * least, nullptr);
      if (effort_.spent()) return;
      if (again.stuck.empty()) {
        p.tree = std::move(again.tree), p.gap = share * least;
        return;
      }
      least = std::min(least, dip(again.until, 1.0 / n));
    }
  }
  template <class T>
  bool swept(Placed<T> P,
             Proof& p) {  // translation of one element: the swept hull's distance and plane
    Points<T> both = P.a(0);
    const auto &e = P.a(1), &b = P.b(0);
    both.insert(both.end(), e.begin(), e.end());
    auto g = gjk<T>(both, b, b[0] - both[0], P.reach, 1e-9);
    if (g.status != Status::Apart) return false;
    auto n = g.v * (T(1) / norm(g.v));
    double gap = double(dot(n, b[support(b, -n)]) - dot(n, both[support(both, n)])) - P.blur();
    if (!(gap > 1e3 * P.blur())) return false;
    p.gap = claimed(gap);
    p.tree = {};
    p.tree.nodes.push_back({{{1.0, 'W', wide(n)}}});
    return true;
  }
  double dip(double t, double width) {  // least distance near t, by golden section
    const double r = 0.6180339887498949;
    double lo = std::max(0.0, t - width), hi = std::min(1.0, t + width), least = distance(t);
    double x = hi - r * (hi - lo), y = lo + r * (hi - lo), fx = distance(x), fy = distance(y);
    for (int i = 0; i < (single() ? 36 : 16); ++i) {
      if (fx < fy)
        hi = y, y = x, fy = fx, x = hi - r * (hi - lo), fx = distance(x);
      else
        lo = x, x = y, fx = fy, y = lo + r * (hi - lo), fy = distance(y);
      least = std::min({least, fx, fy});
    }
    return least;
  }
};

}  // namespace truth
