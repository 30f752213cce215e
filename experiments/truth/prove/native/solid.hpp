// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A body as the prover sees it: convex elements (one hull, pieces, or triangles) in a tree of
// nearby groups; winding numbers.
#pragma once
#include <numeric>

#include "depth.hpp"

namespace truth {

struct Node {
  int lo, hi, left = -1, right = -1;
  Vertices v;
  std::array<double, 3> centre, low, high;
  double radius, far;
};  // far: of a vertex from the origin

// Distance of a point of the body's frame from the node's bounding box.
inline double outside(const Node& n, vec<double> y) {
  double x = std::max({n.low[0] - y.x, y.x - n.high[0], 0.0}),
         z = std::max({n.low[1] - y.y, y.y - n.high[1], 0.0}),
         w = std::max({n.low[2] - y.z, y.z - n.high[2], 0.0});
  return std::sqrt(x * x + z * z + w * w);
}

class Solid {
 public:
  bool mesh = false;
  std::vector<Vertices> elements;
  std::vector<int> order;   // elements in the order of the tree's leaves
  std::vector<Node> nodes;  // nodes[0] is the root and covers order[lo, hi)
  Vertices vertices;        // of a mesh
  std::vector<std::array<int, 3>> faces;
  std::vector<int> part;  // one element of each piece, or of each connected part of a mesh
  double size = 0;

  explicit Solid(std::vector<Vertices> pieces) : elements(std::move(pieces)) {
    part.resize(elements.size());
    std::iota(part.begin(), part.end(), 0);
    finish();
  }
  Solid(Vertices v, std::vector<std::array<int, 3>> f)
      : mesh(true), vertices(std::move(v)), faces(std::move(f)) {
    for (auto& t : faces) elements.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
    connect();
    finish();
  }

  // Winding number about y (body frame): signed crossings of a ray; nullopt where y is on the
  // surface as far as dd can tell.
  std::optional<int> winding(vec<dd> y) const {
    static const double rays[][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {3, 5, 7},
                                     {-7, 4, 3}, {5, -8, 6}, {-2, -7, 9}};
    for (auto& u : rays)
      if (auto w = crossings(y, {u[0], u[1], u[2]})) return w;
    return std::nullopt;
  }

  // Distance from an inner point y (body frame) to the surface, and the unit vector away from it;
  // of pieces, to that of the piece in which it is deepest.
  double room(vec<dd> y, vec<double>& away) const {
    away = {};
    if (mesh) {
      double best = 1e300;
      nearest(0, y, best, away);
      return best;
    }
    double best = 0;
    for (size_t i = 0; i < elements.size(); ++i) {
      vec<double> out;
      double d = depth_in(i, y, out);
      if (d > best) best = d, away = out;
    }
    return best;
  }

 private:
  void nearest(int id, vec<dd> y, double& best, vec<double>& away) const {
    auto& n = nodes[id];
    if (n.left >= 0) {
      auto far = [&](int i) { return outside(nodes[i], {double(y.x), double(y.y), double(y.z)}); };
      double l = far(n.left), r = far(n.right);
      for (auto [d, i] : {l < r ? std::pair{l, n.left} : std::pair{r, n.right},
                          l < r ? std::pair{r, n.right} : std::pair{l, n.left}})
        if (d < best) nearest(i, y, best, away);
      return;
    }
    Gjk<double> g;  // the triangle's point closest to y
    for (int i = 0; i < 3; ++i) {
      vec<dd> w = vec<dd>{dd(n.v[i][0]), dd(n.v[i][1]), dd(n.v[i][2])} - y;
      g.s[i].c = {double(w.x), double(w.y), double(w.z)};
    }
    g.n = 3;
    detail::point3(g);
    double d = norm(g.v);
    if (d < best) best = d, away = d > 0 ? g.v * (-1 / d) : vec<double>{};
  }
  // Least distance of y from the hull's supporting planes, over the directions in which the hull is
  // thin about y: an estimate.
  double depth_in(size_t i, vec<dd> y, vec<double>& away) const {
    Points<double> p, o(1, vec<double>{});
    for (auto& v : elements[i]) {
      vec<dd> w = vec<dd>{dd(v[0]), dd(v[1]), dd(v[2])} - y;
      p.push_back({double(w.x), double(w.y), double(w.z)});
    }
    Effort free{0, 1e300};
    return depth(o, p, largest(p), free, &away, 12);
  }
  void finish() {
    order.resize(elements.size());
    std::iota(order.begin(), order.end(), 0);
    centres_.resize(elements.size());
    for (size_t i = 0; i < elements.size(); ++i) {
      centres_[i] = {0, 0, 0};
      for (auto& v : elements[i])
        for (int c = 0; c < 3; ++c) centres_[i][c] += v[c] / double(elements[i].size());
    }
    grow(0, int(elements.size()));
    size = 2 * nodes[0].radius;
  }
  int grow(int lo, int hi) {
    int id = int(nodes.size());
    nodes.emplace_back();
    Node n;
    n.lo = lo, n.hi = hi;
    if (mesh && hi - lo > 1) {
      std::vector<int> ids;
      for (int i = lo; i < hi; ++i)
        ids.insert(ids.end(), faces[order[i]].begin(), faces[order[i]].end());
      std::sort(ids.begin(), ids.end());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
      for (int i : ids) n.v.push_back(vertices[i]);
    } else {
      for (int i = lo; i < hi; ++i)
        n.v.insert(n.v.end(), elements[order[i]].begin(), elements[order[i]].end());
    }
    std::array<double, 3> low = n.v[0], high = n.v[0];
    for (auto& v : n.v)
      for (int c = 0; c < 3; ++c)
        low[c] = std::min(low[c], v[c]), high[c] = std::max(high[c], v[c]);
    double r = 0;
    int axis = 0;
    for (int c = 0; c < 3; ++c) {
      n.centre[c] = 0.5 * (low[c] + high[c]);
      if (high[c] - low[c] > high[axis] - low[axis]) axis = c;
    }
    for (auto& v : n.v)
      r = std::max(r, std::hypot(v[0] - n.centre[0], v[1] - n.centre[1], v[2] - n.centre[2]));
    n.low = low, n.high = high;
    n.radius = r, n.far = 0;
    for (auto& v : n.v) n.far = std::max(n.far, std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    if (hi - lo > 1) {
      int mid = (lo + hi) / 2;
      std::nth_element(
          order.begin() + lo, order.begin() + mid, order.begin() + hi, [&](int a, int b) {
            return centres_[a][axis] != centres_[b][axis] ? centres_[a][axis] < centres_[b][axis]
                                                          : a < b;
          });
      n.left = grow(lo, mid);
      n.right = grow(mid, hi);
    }
    nodes[id] = std::move(n);
    return id;
  }
  void connect() {
    std::vector<int> root(vertices.size());
    std::iota(root.begin(), root.end(), 0);
    auto find = [&](int i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    for (auto& t : faces) root[find(t[0])] = find(t[1]), root[find(t[1])] = find(t[2]);
    std::vector<char> seen(vertices.size());
    for (size_t i = 0; i < faces.size(); ++i) {
      int r = find(faces[i][0]);
      if (!seen[r]) seen[r] = 1, part.push_back(int(i));
    }
  }
  std::optional<int> crossings(vec<dd> y, vec<double> u) const {
    vec<double> y0{y.x.hi, y.y.hi, y.z.hi};
    double scale = std::abs(y0.x) + std::abs(y0.y) + std::abs(y0.z) + size;
    int total = 0;
    for (auto& t : faces) {
      vec<double> w[3];
      double L = 0;
      for (int i = 0; i < 3; ++i) {
        auto& v = vertices[t[i]];
        w[i] = {v[0] - y0.x, v[1] - y0.y, v[2] - y0.z};
        L = std::max(L, std::abs(w[i].x) + std::abs(w[i].y) + std::abs(w[i].z));
      }
      if (u.y == 0 && u.z == 0) {  // along x: past the triangle's bounds?
        double blur = 1e-14 * (L + scale);
        auto past = [&](double a, double b, double c) {
          return (a > blur && b > blur && c > blur) || (a < -blur && b < -blur && c < -blur);
        };
        if (past(w[0].y, w[1].y, w[2].y) || past(w[0].z, w[1].z, w[2].z)) continue;
      }
      double bound = 1e-14 * 16 * L * (L + scale), e[3];
      int up = 0, down = 0;
      for (int i = 0; i < 3; ++i) {
        e[i] = dot(u, cross(w[i], w[(i + 1) % 3]));
        up += e[i] > bound, down += e[i] < -bound;
      }
      if (up && down) continue;
      double vol = dot(w[0], cross(w[1], w[2]));
      int side = up == 3     ? 1
                 : down == 3 ? -1
                             : 0,
          high = vol > L * bound    ? 1
                 : vol < -L * bound ? -1
                                    : 0;
      if (!side || !high) {
        vec<dd> z[3];
        for (int i = 0; i < 3; ++i) {
          auto& v = vertices[t[i]];
          z[i] = vec<dd>{dd(v[0]), dd(v[1]), dd(v[2])} - y;
        }
        vec<dd> ud{dd(u.x), dd(u.y), dd(u.z)};
        double tiny = bound * 1e-14;
        up = down = 0;
        for (int i = 0; i < 3; ++i) {
          double q = double(dot(ud, cross(z[i], z[(i + 1) % 3])));
          up += q > tiny, down += q < -tiny;
        }
        if (up && down) continue;
        side = up == 3 ? 1 : down == 3 ? -1 : 0;
        double q = double(dot(z[0], cross(z[1], z[2])));
        high = q > L * tiny ? 1 : q < -L * tiny ? -1 : 0;
        if (!side || !high) return std::nullopt;
      }
      if (side == high) total += side;
    }
    return total;
  }
  std::vector<std::array<double, 3>> centres_;
};

}  // namespace truth
