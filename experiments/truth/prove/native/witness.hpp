// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Points inside both solids at one moment: where two elements cross, and below their surfaces.
#pragma once
#include "stage.hpp"

namespace truth {

struct Common {  // a point inside both at some time, in the frame of Scene; piece and tetrahedron
                 // of each (piece -1: a mesh)
  Wide point{};
  int piece_a = -1, piece_b = -1;
  std::array<int, 4> a{}, b{};
};

class Witness : public Stage {
 public:
  using Stage::Stage;

 protected:
  int attempts_ =
      0;  // pairs of elements in which a common point was sought and not found, at one instant

  // A point of the crossing of two elements, moved into the solid where an element is only a
  // triangle of its surface.
  bool crossing(int na, int nb, double t, Common& out) {
    if (attempts_++ > 48) return false;
    if (!A_.mesh && !B_.mesh) {
      auto P = quick(na, nb);
      auto w = inside<double>(P.a(t), P.b(t), P.reach);
      if (!w) {
        Exact e(*this, na, nb);
        w = inside<dd>(e.placed.a(t), e.placed.b(t), e.placed.reach);
      }
      if (!w) return false;
      out = {w->point, A_.order[A_.nodes[na].lo], B_.order[B_.nodes[nb].lo], w->a, w->b};
      return true;
    }
    Exact e(*this, na, nb);
    const auto &x = e.placed.a(t), &b = e.placed.b(t);
    vec<dd> inward;
    if (A_.mesh) inward = inward - unit(cross(x[1] - x[0], x[2] - x[0]));
    if (B_.mesh) inward = inward - unit(cross(b[1] - b[0], b[2] - b[0]));
    if (!(norm(inward) > dd(1e-20))) return false;
    double reach = e.placed.reach;
    for (auto& y : shared(na, nb, t, x, b, reach))
      for (double depth = 0.03 * std::min(A_.size, B_.size); depth > 1e-27 * reach; depth *= 0.02) {
        if (!holds(y + inward * dd(depth), t, out)) continue;
        double inner = depth,
               outer = 50 * depth;  // half way through what both share: where the ball is to grow
        for (int i = 0; i < 6; ++i) {
          double half = std::sqrt(inner * outer);
          (holds(y + inward * dd(half), t, out) ? inner : outer) = half;
        }
        holds(y + inward * dd(0.5 * inner), t, out);
        return true;
      }
    return false;
  }
  static vec<dd> unit(vec<dd> v) {
    dd l = norm(v);
    return l > dd(0) ? v * (dd(1) / l) : v;
  }
  // Points common to two hulls and in the relative interior of both, if they cross.
  std::vector<vec<dd>> shared(int na, int nb, double t, const Points<dd>& A, const Points<dd>& B,
                              double reach) {
    std::vector<vec<dd>> found;
    auto P = quick(na, nb);
    for (auto& y : crossings<double>(P.a(t), P.b(t), reach, 1e-6))
      found.push_back({dd(y.x), dd(y.y), dd(y.z)});
    return found.empty() ? crossings<dd>(A, B, reach, 1e-25) : found;
  }
  template <class T>
  std::vector<vec<T>> crossings(const Points<T>& A, const Points<T>& B, double reach,
                                double least) {
    unsigned long long seed = 7;
    auto draw = [&] {
      return 0.25 + double((seed = seed * 6364136223846793005ULL + 1442695040888963407ULL) >> 33) /
                        4294967296.0;
    };
    auto shrink = [&](const Points<T>& p, double eps) {
      vec<T> m;
      double total = 0;
      for (auto& v : p) {
        double w = draw();
        m = m + v * T(w), total += w;
      }
      m = m * (T(1) / T(total));
      Points<T> out(p);
      for (auto& v : out) v = v + (m - v) * T(eps);
      return out;
    };
    std::vector<vec<T>> found;
    for (double eps = 0.5; eps > least && found.empty(); eps *= eps > 0.06 ? 0.25 : 0.03)
      for (int attempt = 0; attempt < 2; ++attempt) {
        auto a = shrink(A, eps), b = shrink(B, eps);
        effort_.done += (std::is_same_v<T, double> ? 1.0 : 20.0) * double(a.size() + b.size());
        auto g = gjk<T>(a, b, b[0] - a[0], reach, 1e-3);
        if (g.status == Status::Apart) break;
        if (g.status != Status::Meet) continue;
        vec<T> y;
        for (int i = 0; i < 4; ++i) y = y + b[g.s[i].b] * g.w[i];
        found.push_back(y);
      }
    return found;
  }

  // Is x (relative to p_A, world axes) strictly inside both at time t? Fills `out` if so.
  bool holds(vec<dd> x, double t, Common& out) {
    vec<dd> ya = in_a(x, t), yb = in_b(x, t);
    Common c;
    c.point = wide(x);
    if (!within(A_, ya, c.piece_a, c.a) || !within(B_, yb, c.piece_b, c.b)) return false;
    out = c;
    return true;
  }
  bool within(const Solid& s, vec<dd> y, int& piece, std::array<int, 4>& ids) {
    if (s.mesh) {
      effort_.done += double(s.faces.size());
      auto w = s.winding(y);
      return w && *w != 0;
    }
    for (size_t i = 0; i < s.elements.size(); ++i)
      if (tetrahedron(s.elements[i], y, ids)) {
        piece = int(i);
        return true;
      }
    return false;
  }
  bool tetrahedron(const Vertices& element, vec<dd> y, std::array<int, 4>& ids) {
    Points<double> p, o(1, vec<double>{double(y.x), double(y.y), double(y.z)});
    for (auto& v : element) p.push_back({v[0], v[1], v[2]});
    double reach = largest(p) + norm(o[0]);
    effort_.done += double(p.size());
    auto g = gjk<double>(o, p, p[0] - o[0], reach, 1e-3);
    if (g.status == Status::Apart && norm(g.v) > 1e-12 * reach) return false;
    if (g.status == Status::Meet && *std::min_element(g.w.begin(), g.w.end()) > 1e-9) {
      for (int i = 0; i < 4; ++i) ids[i] = g.s[i].b;
      return true;
    }
    Points<dd> q, oq(1, y);
    for (auto& v : element) q.push_back({dd(v[0]), dd(v[1]), dd(v[2])});
    effort_.done += 20.0 * double(p.size());
    auto gq = gjk<dd>(oq, q, q[0] - y, reach, 1e-3);
    if (gq.status != Status::Meet) return false;
    for (int i = 0; i < 4; ++i) ids[i] = gq.s[i].b;
    return true;
  }

  // Surfaces are apart at t: is one inside the other? Then a point of the inner one is common to
  // both.
  bool contained(double t, Common& out) { return (B_.mesh || A_.mesh) && probes(t, out, true); }
  // Surfaces are not shown apart, and no crossing gave a point (coincident faces): look below the
  // surface of both.
  bool anywhere(double t, Common& out) { return probes(t, out, false); }

  bool probes(double t, Common& out, bool parts_only) {
    for (int side = 0; side < 2; ++side) {
      const Solid& s = side ? B_ : A_;
      size_t count = parts_only ? s.part.size() : s.elements.size();
      size_t stride = parts_only ? 1 : std::max<size_t>(1, count / 64);
      for (size_t i = 0; i < count && !effort_.spent(); i += stride) {
        int id = parts_only ? s.part[i] : int(i);
        auto& e = s.elements[id];
        vec<dd> m, n;
        Points<dd> p;
        for (auto& v : e) p.push_back({dd(v[0]), dd(v[1]), dd(v[2])});
        double total = 0;
        for (size_t j = 0; j < p.size(); ++j) {
          double w = 1 + 0.37 * double((j * 7 + size_t(id) * 3) % 11) / 11;
          m = m + p[j] * dd(w), total += w;
        }
        m = m * (dd(1) / dd(total));
        if (parts_only && !sees(side ? A_ : B_, side, m, t)) continue;
        if (s.mesh) n = unit(cross(p[1] - p[0], p[2] - p[0]));
        for (double depth = s.mesh ? 0.05 * std::min(A_.size, B_.size) : 0;; depth *= 0.02) {
          if (holds(world(side, m - n * dd(depth), t), t, out)) return true;
          if (!s.mesh || depth < 1e-18 * s.size || effort_.spent()) break;
        }
      }
    }
    return false;
  }
  // Is point y of side's body inside the other body? Where surfaces are apart, that tells of its
  // whole part.
  bool sees(const Solid& other, int side, vec<dd> y, double t) {
    auto x = world(side, y, t);
    vec<dd> there = side ? in_a(x, t) : in_b(x, t);
    int piece;
    std::array<int, 4> ids;
    return within(other, there, piece, ids);
  }
};

}  // namespace truth
