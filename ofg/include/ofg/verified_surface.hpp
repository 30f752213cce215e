// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A closed surface of triangles, and the solid that it winds about.
#pragma once
#include <map>
#include <numeric>
#include <stdexcept>

#include "verified_sides.hpp"
#include "verified_tree.hpp"

namespace ofg::verified {

using Triangles = std::vector<std::array<int, 3>>;

struct Surface {
  std::vector<Vec3<double>> vertices;  // as given: what is exact is about these
  Triangles faces;
  std::vector<Vec3<double>> cloud;  // vertex - centre, each coordinate rounded once
  std::vector<int> shells;          // a vertex of each part that no faces connect to another
  Vec3<double> centre;              // of the bounding box
  double radius = 0;                // no vertex is farther from the centre
  std::vector<int> broad;  // the faces with an area: where others lie, their neighbours' edges do
  Tree tree;               // over these

  Surface() = default;

  // faces: wound outward; each edge is used as often one way as the other. Raises
  // std::invalid_argument where that is not so, and where all vertices lie in one plane.
  Surface(std::vector<Vec3<double>> points, Triangles triangles)
      : vertices(std::move(points)), faces(std::move(triangles)) {
    if (!balanced()) throw std::invalid_argument("its surface is open, or not wound one way");
    centre = middle_of(vertices);
    for (const auto& v : vertices) {
      cloud.push_back(v - centre);
      radius = std::fmax(radius, length(cloud.back()));
    }
    radius *= 1 + 8 * unit_roundoff;
    find_shells();
    plant();
  }

  const Vec3<double>& corner(int face, int i) const { return cloud[index(face, i)]; }
  std::size_t index(int face, int i) const {
    return std::size_t(faces[std::size_t(face)][std::size_t(i)]);
  }

 private:
  bool balanced() const {
    std::map<std::pair<int, int>, int> uses;
    for (const auto& f : faces)
      for (std::size_t i = 0; i < 3; ++i) {
        const int p = f[i], q = f[(i + 1) % 3];
        if (p != q) uses[std::minmax(p, q)] += p < q ? 1 : -1;
      }
    return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 0; });
  }

  void find_shells() {
    std::vector<int> root(vertices.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int v) {
      while (root[std::size_t(v)] != v)
        v = root[std::size_t(v)] = root[std::size_t(root[std::size_t(v)])];
      return v;
    };
    for (const auto& f : faces)
      for (std::size_t i = 1; i < 3; ++i) root[std::size_t(find(f[i]))] = find(f[0]);
    std::vector<bool> seen(vertices.size());
    for (const auto& f : faces) {
      const int shell = find(f[0]);
      if (!seen[std::size_t(shell)]) shells.push_back(shell);
      seen[std::size_t(shell)] = true;
    }
  }

  void plant() {
    Items items;
    const double unit = radius > 0 ? 1 / radius : 0;
    for (int i = 0; i < int(faces.size()); ++i) {
      if (flat(i)) continue;
      broad.push_back(i);
      for (int j = 0; j < 3; ++j) items.points.push_back(corner(i, j) * unit);
      items.end(i);
    }
    if (in_one_plane()) throw std::invalid_argument("its surface is flat: its interior is empty");
    tree = Tree(items);
  }

  // Differences are off by u of the largest coordinate, twice; products of two by 8 u of that.
  bool flat(int face) const {
    const auto &a = vertices[index(face, 0)], &b = vertices[index(face, 1)],
               &c = vertices[index(face, 2)];
    const double most = std::fmax(largest(a), std::fmax(largest(b), largest(c)));
    if (largest(cross(b - a, c - a)) > 64 * unit_roundoff * most * most) return false;
    return normal(face).zero();
  }

  bool in_one_plane() const {
    if (broad.empty()) return true;
    const Vector n = normal(broad[0]), o(vertices[index(broad[0], 0)]);
    return std::all_of(vertices.begin(), vertices.end(),
                       [&](const auto& v) { return dot(n, Vector(v) - o).sign() == 0; });
  }

  Vector normal(int face) const {
    const Vector o(vertices[index(face, 0)]);
    return cross(Vector(vertices[index(face, 1)]) - o, Vector(vertices[index(face, 2)]) - o);
  }
};

}  // namespace ofg::verified
