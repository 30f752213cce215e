// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// What verified overlap knows of a convex body before it is asked: the convex hull of the vertices.
// The faces name what opposes and bound the inscribed sphere; no answer trusts them to be convex.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "mesh.hpp"
#include "on_demand.hpp"
#include "verified_lists.hpp"
#include "verified_number.hpp"
#include "verified_table.hpp"

namespace ofg::verified {

constexpr double unit_roundoff = 0x1p-53;

struct Hull {
  std::vector<Vec3<double>> vertices;  // as given: what is exact is about these
  Vec3<double> centre;                 // within 2 n units of rounding of a point of the hull
  double way = 0;                      // from the frame's origin to the centre
  Cloud<double> cloud;                 // vertex - centre, each coordinate rounded once
  double radius = 0;                   // no vertex is farther from the centre
  double inner = 0;                    // the ball about the centre that the hull is sure to hold
  double off_centre = 0;               // bound on the centre's distance from the hull
  std::array<int, 4> corners{};        // of a tetrahedron that is exactly not flat
  bool flat = true;                    // there is none: the interior is empty
  SupportMap supports;                 // relative to the centre in units of the radius
  OpposingTable opposing;              // likewise
  std::uint64_t number = 0;            // no other hull of this process has it

  Hull() = default;

  // faces: triangles of indices into the vertices, wound outward.
  Hull(std::vector<Vec3<double>> given, const std::vector<std::array<int, 3>>& faces)
      : vertices(std::move(given)) {
    const int n = size();
    Points<double> all;
    double extent = 0;
    for (const auto& v : vertices) {
      all.push(v), centre = centre + v * (1.0 / n);
      extent = std::fmax(extent, length(v));
    }
    way = length(centre);
    for (const auto& v : vertices) {
      cloud.push(v - centre);
      radius = std::fmax(radius, length(v - centre));
    }
    // A length has a relative error of 4 units, and each difference of 1.
    radius *= 1 + 8 * unit_roundoff;
    // The mean of n vectors, each product rounded twice, summed one after another.
    off_centre = extent * (2 * n + 8) * unit_roundoff;
    cloud.pad();
    find_corners();
    if (flat) return;
    if (!faces.empty() && closed(faces)) inner = inscribed(faces);
    if (inner > 0) off_centre = 0;  // the centre is inside
    supports = SupportMap(all.x.data(), all.y.data(), all.z.data(), n, centre, radius);
    opposing = OpposingTable(cloud, n, faces, radius);
    number = next_number();
  }

  template <class T>
  explicit Hull(const Mesh<T>& mesh) : Hull(vertices_of(mesh), mesh.faces) {}

  Vec3<double> point(int i) const {
    const auto k = std::size_t(i);
    return {cloud.x[k], cloud.y[k], cloud.z[k]};
  }
  int size() const { return int(vertices.size()); }

  // Lists of the vertices of a large hull, for sweeps; none of a small one.
  const ExtremeLists* extreme_lists() const {
    if (size() <= 64) return nullptr;
    return &lists.get([&] { return ExtremeLists(cloud, supports); });
  }

 private:
  OnDemand<ExtremeLists> lists;

  template <class T>
  static std::vector<Vec3<double>> vertices_of(const Mesh<T>& mesh) {
    std::vector<Vec3<double>> all;
    for (int i = 0; i < mesh.vertices.size(); ++i)
      all.push_back(Vec3<double>(mesh.vertices[std::size_t(i)]));
    return all;
  }

  static std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }

  // Four vertices that doubles find to be far from one plane, and exact arithmetic agrees; or any
  // four that it finds.
  void find_corners() {
    const auto far = [&](auto measure) {
      int best = 0;
      for (int i = 1; i < size(); ++i)
        if (measure(point(i)) > measure(point(best))) best = i;
      return best;
    };
    const double small = unit_of(std::fmax(radius, 1e-200));  // so that no square vanishes
    const int i = far([&](const Vec3<double>& p) { return length(p); });
    const Vec3<double> a = point(i) * small;
    const int j = far([&](const Vec3<double>& p) { return length(p * small - a); });
    const Vec3<double> e = point(j) * small - a;
    const int k = far([&](const Vec3<double>& p) { return length(cross(e, p * small - a)); });
    const Vec3<double> f = cross(e, point(k) * small - a);
    const int l = far([&](const Vec3<double>& p) { return std::abs(dot(f, p * small - a)); });
    corners = {i, j, k, l};
    flat = !solid(i, j, k, l);
    if (!flat) return;
    const auto at = [&](int v) { return Vector(vertices[std::size_t(v)]); };
    // Exactly: a vertex apart from the first, one off their line, one off their plane.
    int b = 1, c, d;
    while (b < size() && (at(b) - at(0)).zero()) ++b;
    if (b >= size()) return;
    for (c = b + 1; c < size(); ++c)
      if (!cross(at(b) - at(0), at(c) - at(0)).zero()) break;
    if (c >= size()) return;
    for (d = c + 1; d < size(); ++d)
      if (solid(0, b, c, d)) break;
    if (d >= size()) return;
    corners = {0, b, c, d}, flat = false;
  }

  bool solid(int i, int j, int k, int l) const {
    const auto at = [&](int v) { return Vector(vertices[std::size_t(v)]); };
    const Vector o = at(i);
    return dot(cross(at(j) - o, at(k) - o), at(l) - o).sign() != 0;
  }

  // Is every directed edge there once, and its opposite too?
  static bool closed(const std::vector<std::array<int, 3>>& faces) {
    std::vector<std::pair<int, int>> edges;
    for (const auto& f : faces)
      for (int i = 0; i < 3; ++i) edges.push_back({f[std::size_t(i)], f[std::size_t((i + 1) % 3)]});
    std::sort(edges.begin(), edges.end());
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
    return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
      return std::binary_search(edges.begin(), edges.end(), std::pair(e.second, e.first));
    });
  }

  // The radius of a ball about the centre inside a closed surface of the vertices; 0 where that is
  // not certain. Seen from the centre every face is wound alike, so that each adds to the winding
  // number there, which is a whole number and so not 0: what the surface winds about is in the hull
  // of its corners. With x, e, f the corner and two edges of a face in doubles and u the unit
  // roundoff: the normal e x f is off by 8 u |e| |f|, its product with x by 12 u |e| |f| |x|, the
  // corners themselves by u |x|; see verified_margin.hpp.
  double inscribed(const std::vector<std::array<int, 3>>& faces) const {
    constexpr double u = unit_roundoff;
    const double small = unit_of(radius);
    double least = radius;
    for (const auto& face : faces) {
      const Vec3<double> x = point(face[0]) * small, e = point(face[1]) * small - x,
                         f = point(face[2]) * small - x, n = cross(e, f);
      const double size = length(n), off = 16 * u * length(e) * length(f) * length(x);
      const double height = dot(n, x) - off;
      if (!(height > 0) || !(size > 1e-100)) return 0;
      const double wide = size * (1 + 8 * u) + 8 * u * length(e) * length(f);
      least = std::fmin(least, height / wide / small * (1 - 8 * u) - 8 * u * radius);
    }
    return std::fmax(least, 0.0);
  }
};

}  // namespace ofg::verified
