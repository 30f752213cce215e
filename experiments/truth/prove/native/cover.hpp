// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Trees of planes that keep all elements of two solids apart, at one moment or over an interval,
// and what they are stuck on.
#pragma once
#include <map>

#include "witness.hpp"

namespace truth {

struct Tree {  // node 0 is the root; children split the elements of `side` at `cut`
  struct Node {
    std::vector<Segment> segments;
    char side = 0;
    int cut = 0, left = -1, right = -1;
  };
  std::vector<Node> nodes;
};

// A plane that is known from elsewhere to keep two elements apart over [0, end], though they may
// touch.
struct Seed {
  int number;
  double end;
};
using Seeds = std::map<Elements, Seed>;

class Covers : public Witness {
 public:
  Covers(const Pair& pair, const Solid& A, const Solid& B, double limit, Seeds seeds)
      : Witness(pair, A, B, limit), seeds_(std::move(seeds)) {}

 protected:
  struct Stuck {
    int a, b;
    double t;
  };
  struct Cover {
    Tree tree;
    std::vector<Stuck> stuck;
    double until = 1, least = 1e300, at = 0;
    bool found = false;
  };

  const Seeds seeds_;

  using Stage::elements;
  std::vector<Elements> elements(const Cover& c) const {
    std::vector<Elements> found;
    for (auto& s : c.stuck) found.push_back(elements(s.a, s.b));
    return found;
  }
  const Seed* seed(int na, int nb) const {
    auto at = seeds_.empty() ? seeds_.end() : seeds_.find(elements(na, nb));
    return at == seeds_.end() ? nullptr : &at->second;
  }
  static Segment planted(const Seed& s, double end) {
    return {end, 'S', wide(vec<double>{double(s.number), 0, 0})};
  }

  // Distance at t between the elements, in double; 0 where a pair meets.
  double distance(double t) {
    double best = 1e300;
    nearest(0, 0, t, best);
    return best;
  }
  void nearest(int na, int nb, double t, double& best, Common* common = nullptr,
               bool* found = nullptr) {
    if (effort_.spent() || sphere_gap(na, nb, t) >= best) return;
    if (best <= 0 && (!common || *found || attempts_ > 8)) return;
    double big = double(A_.nodes[na].v.size() + B_.nodes[nb].v.size());
    if (leaf_pair(na, nb) || (best < 1e300 && (big <= 48 || sphere_gap(na, nb, t) > 0))) {
      auto P = quick(na, nb);
      effort_.done += double(P.size());
      const auto &x = P.a(t), &y = P.b(t);
      auto g = gjk<double>(x, y, y[0] - x[0], P.reach, 1e-6);
      double d = g.status == Status::Apart ? norm(g.v) : 0;
      if (d >= best) return;
      if (leaf_pair(na, nb)) {
        best = d;
        if (d <= 0 && common) *found = crossing(na, nb, t, *common);
        return;
      }
    }
    auto [c1, c2] = children(na, nb, t);
    nearest(c1.first, c1.second, t, best, common, found);
    nearest(c2.first, c2.second, t, best, common, found);
  }

  // A tree of planes that keeps all elements apart by `margin` from s until `end`, or until the
  // first pair gets stuck. With `common` (an instant): stop as soon as a stuck pair yields a common
  // interior point.
  Cover cover(double s, double end, double margin, Common* common) {
    Cover c;
    c.until = end;
    c.tree.nodes.reserve(64);
    extend(c, 0, 0, s, margin, common);
    return c;
  }
  int extend(Cover& c, int na, int nb, double s, double margin, Common* common) {
    int id = int(c.tree.nodes.size());
    c.tree.nodes.emplace_back();
    std::vector<Segment> segments;
    bool instant = s >= c.until, last = leaf_pair(na, nb);
    double from = s;
    if (auto sown = last && margin == 0 ? seed(na, nb) : nullptr; sown && s <= sown->end) {
      const double to = instant ? s : sown->end;
      segments.push_back(planted(*sown, to));
      if (instant || to >= c.until) {
        c.tree.nodes[id].segments = std::move(segments);
        return id;
      }
      s = to;
    }
    auto P = quick(na, nb);
    bool done = !instant && !sd_.turns() && straight(P, s, c.until, margin, segments);
    if (!done) {
      double floor = (last ? 1e4 : 64) * P.blur();
      March m =
          march(P, s, c.until, margin, floor, last ? 0 : 0.03 * (c.until - s), effort_, segments);
      if (m.least < c.least) c.least = m.least, c.at = m.at;
      done = m.done;
      s = m.t;
    }
    if (!done && last) {
      Exact e(*this, na, nb);
      March m = march(e.placed, s, c.until, margin, 1e3 * e.placed.blur(), 0, effort_, segments);
      if (m.least < c.least) c.least = m.least, c.at = m.at;
      if (!sd_.turns() && segments.size() > 1 && segments[0].frame != 'S' &&
          leaf(e.placed, from, m.t, 'W', unwide(segments.back().n), dd(margin)))
        segments = {segments.back()};
      if (!m.done) {
        c.until = m.t;
        c.stuck.push_back({na, nb, m.t});
        if (common && crossing(na, nb, m.t, *common)) c.found = true;
      }
    }
    c.tree.nodes[id].segments = std::move(segments);
    if (done || last || c.found || effort_.spent()) return id;
    if (!instant && s >= c.until) return id;
    auto [c1, c2] = children(na, nb, s);
    bool on_a = c1.first != na || c2.first != na;
    bool swapped = on_a ? c1.first != A_.nodes[na].left : c1.second != B_.nodes[nb].left;
    int first = extend(c, c1.first, c1.second, s, margin, common);
    if (c.found || (margin > 0 && !c.stuck.empty())) return id;
    int second = extend(c, c2.first, c2.second, s, margin, common);
    auto& node = c.tree.nodes[id];
    node.side = on_a ? 'a' : 'b';
    node.cut = on_a ? A_.nodes[A_.nodes[na].left].hi : B_.nodes[B_.nodes[nb].left].hi;
    node.left = swapped ? second : first, node.right = swapped ? first : second;
    return id;
  }
  // Translation: one plane for all of [s, end], if the swept hull of A's group is apart from B's.
  bool straight(Placed<double>& P, double s, double end, double margin, std::vector<Segment>& out) {
    Points<double> both = P.a(s);
    const auto &e = P.a(end), &b = P.b(s);
    both.insert(both.end(), e.begin(), e.end());
    effort_.done += double(both.size() + b.size());
    auto g = gjk<double>(both, b, b[0] - both[0], P.reach, 1e-9);
    if (g.status != Status::Apart) return false;
    double gap = norm(g.v);
    if (!(gap > 64 * P.blur() + margin)) return false;
    auto n = g.v * (1 / gap);
    if (!leaf(P, s, end, 'W', n, margin)) return false;
    out.push_back({end, 'W', wide(n)});
    return true;
  }

  bool meets_at(double t, const Cover& c, Common& common) {
    for (auto it = c.stuck.rbegin(); it != c.stuck.rend() && it - c.stuck.rbegin() < 8; ++it)
      if (crossing(it->a, it->b, t, common)) return true;
    if (single() && !A_.mesh && !B_.mesh) return false;
    attempts_ = 0;
    return cover(t, t, 0, &common).found || anywhere(t, common);
  }
};

}  // namespace truth
