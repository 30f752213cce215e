// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Two solids in one scene, as the prover's searches share them: their points posed in double and in
// double-double, groups of elements and how near they may be, and the effort spent.
#pragma once
#include "solid.hpp"

namespace truth {

using Elements = std::pair<int, int>;  // an element of A and one of B

class Stage {
 public:
  Stage(const Pair& pair, const Solid& A, const Solid& B, double limit)
      : A_(A), B_(B), sd_(pair), sq_(pair), ra_(A.nodes.size()), rb_(B.nodes.size()) {
    effort_.limit = limit;
    blur_ = quick(0, 0).blur();
  }
  const Effort& effort() const { return effort_; }

 protected:
  struct Exact {  // one pair of tree nodes in double-double
    Moving<dd> a, b;
    Placed<dd> placed;
    Exact(const Stage& p, int na, int nb)
        : a{p.of_a<dd>(p.sq_, p.A_.nodes[na].v), {}},
          b{p.of_b<dd>(p.sq_, p.B_.nodes[nb].v), {}},
          placed(p.sq_, a, b, p.reach(na, nb)) {}
  };

  const Solid &A_, &B_;
  Scene<double> sd_;
  Scene<dd> sq_;
  double blur_;
  mat<double> pose_a_, pose_b_;
  double posed_ = -1;
  Effort effort_;
  std::vector<Moving<double>> ra_, rb_;

  bool single() const { return A_.elements.size() == 1 && B_.elements.size() == 1; }
  double reach(int na, int nb) const {
    return A_.nodes[na].far + B_.nodes[nb].far + norm(sd_.about_a) + norm(sd_.about_b) +
           norm(sd_.dp) + norm(sd_.d);
  }
  Placed<double> quick(int na, int nb) {
    if (ra_[na].r.empty()) ra_[na].r = of_a(sd_, A_.nodes[na].v);
    if (rb_[nb].r.empty()) rb_[nb].r = of_b(sd_, B_.nodes[nb].v);
    return {sd_, ra_[na], rb_[nb], reach(na, nb)};
  }
  template <class T>
  static Points<T> of_a(const Scene<T>& s, const Vertices& v) {
    return turned(s.RA, s.about_a, v);
  }
  template <class T>
  static Points<T> of_b(const Scene<T>& s, const Vertices& v) {
    return turned(s.RB, s.about_b, v);
  }
  Elements elements(int na, int nb) const {
    return {A_.order[A_.nodes[na].lo], B_.order[B_.nodes[nb].lo]};
  }
  bool leaf_pair(int na, int nb) const { return A_.nodes[na].left < 0 && B_.nodes[nb].left < 0; }

  // The vertices of one pair of elements that lie near the contact, in double-double: a tenth of
  // the work of all of them.
  struct Near {
    std::vector<int> ids_a, ids_b;
    Moving<dd> a, b;
    std::optional<Placed<dd>> placed;
    Near(Stage& p, int na, int nb, double t) {
      auto P = p.quick(na, nb);
      const auto &x = P.a(t), &y = P.b(t);
      auto shrunk = [](const Points<double>& q) {
        vec<double> m;
        for (auto& v : q) m = m + v;
        m = m * (1.0 / double(q.size()));
        Points<double> out(q);
        for (auto& v : out) v = v + (m - v) * 1e-3;
        return out;
      };
      auto sa = shrunk(x), sb = shrunk(y);
      auto g = gjk<double>(sa, sb, sb[0] - sa[0], P.reach, 1e-6);
      if (g.status != Status::Apart) return;
      ids_a = ends(x, g.v), ids_b = ends(y, -g.v);
      a.r = of_a(p.sq_, pick(p.A_.nodes[na].v, ids_a)),
      b.r = of_b(p.sq_, pick(p.B_.nodes[nb].v, ids_b));
      placed.emplace(p.sq_, a, b, P.reach);
    }
    static std::vector<int> ends(const Points<double>& p,
                                 vec<double> n) {  // near the support along n, and six all around
      std::vector<int> ids;
      double top = dot(n, p[support(p, n)]), range = top + dot(-n, p[support(p, -n)]);
      for (int i = 0; i < int(p.size()); ++i)
        if (dot(n, p[i]) > top - 4e-3 * range) ids.push_back(i);
      for (vec<double> u :
           {vec<double>{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, -n})
        ids.push_back(support(p, u));
      std::sort(ids.begin(), ids.end());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
      return ids;
    }
    static Vertices pick(const Vertices& v, const std::vector<int>& ids) {
      Vertices out;
      for (int i : ids) out.push_back(v[i]);
      return out;
    }
  };
  // Lower bound on the distance of two groups: their bounding spheres, and the sphere of each
  // against the box of the other.
  double sphere_gap(int na, int nb, double t) {
    if (t != posed_) {
      pose_a_ = sd_.a.at(t) * sd_.RA, pose_b_ = sd_.b.at(t) * sd_.RB;
      posed_ = t;
    }
    auto &a = A_.nodes[na], &b = B_.nodes[nb];
    auto shift = sd_.d * t;
    vec<double> x = pose_a_ * (vector<double>(a.centre) - sd_.about_a) + shift;
    vec<double> y = pose_b_ * (vector<double>(b.centre) - sd_.about_b) + sd_.dp;
    double spheres = norm(x - y) - a.radius - b.radius;
    double boxes = std::max(outside(a, transposed(pose_a_, y - shift) + sd_.about_a) - b.radius,
                            outside(b, transposed(pose_b_, x - sd_.dp) + sd_.about_b) - a.radius);
    return std::max(spheres, boxes);
  }
  bool split_a(int na, int nb) const {
    if (A_.nodes[na].left < 0) return false;
    return B_.nodes[nb].left < 0 || A_.nodes[na].radius >= B_.nodes[nb].radius;
  }
  std::pair<std::pair<int, int>, std::pair<int, int>> children(int na, int nb,
                                                               double t) {  // nearer first
    std::pair<int, int> c1{na, nb}, c2{na, nb};
    if (split_a(na, nb))
      c1.first = A_.nodes[na].left, c2.first = A_.nodes[na].right;
    else
      c1.second = B_.nodes[nb].left, c2.second = B_.nodes[nb].right;
    if (sphere_gap(c2.first, c2.second, t) < sphere_gap(c1.first, c1.second, t)) std::swap(c1, c2);
    return {c1, c2};
  }
  vec<dd> world(int side, vec<dd> y, double t) const {
    return side ? sq_.b.at(dd(t)) * (sq_.RB * (y - sq_.about_b)) + sq_.dp
                : sq_.a.at(dd(t)) * (sq_.RA * (y - sq_.about_a)) + sq_.d * dd(t);
  }
  // A point of the scene at time t, in a body's frame.
  vec<dd> in_a(vec<dd> x, double t) const {
    return transposed(sq_.RA, transposed(sq_.a.at(dd(t)), x - sq_.d * dd(t))) + sq_.about_a;
  }
  vec<dd> in_b(vec<dd> x, double t) const {
    return transposed(sq_.RB, transposed(sq_.b.at(dd(t)), x - sq_.dp)) + sq_.about_b;
  }
};

}  // namespace truth
