// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Data of a body computed before any query: vertices and face centres in structure-of-arrays.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "on_demand.hpp"
#include "separation.hpp"
#include "support_map.hpp"

namespace ofg {

template <class T>
struct Points {
  std::vector<T> x, y, z;
  void push(const Vec3<T>& p) { x.push_back(p.x), y.push_back(p.y), z.push_back(p.z); }
  Vec3<T> operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  int size() const { return int(x.size()); }
};

// The centres of the faces in blocks of block_faces neighbours, so that most blocks can be rejected
// by their boxes.
template <class T>
struct Blocks {
  std::vector<T> x, y, z, lo[3], hi[3];
  using Int = typename IntOf<T>::type;
  std::vector<Int> face;  // of each slot, then padding
  int faces = 0, count = 0;

  BlockView<T> view() const {
    return {x.data(),
            y.data(),
            z.data(),
            face.data(),
            {lo[0].data(), lo[1].data(), lo[2].data()},
            {hi[0].data(), hi[1].data(), hi[2].data()},
            faces,
            count};
  }

  explicit Blocks(const Points<T>& centres = {}) {
    faces = centres.size();
    face.resize(std::size_t(faces));
    for (std::size_t i = 0; i < face.size(); ++i) face[i] = Int(i);
    split(centres, 0, face.size());
    count = int((face.size() + block_faces - 1) / block_faces);
    constexpr T inf = std::numeric_limits<T>::infinity();
    const std::size_t padded = std::size_t(count + block_faces - 1) / block_faces * block_faces;
    for (int i = 0; i < 3; ++i) lo[i].assign(padded, inf), hi[i].assign(padded, inf);
    for (std::size_t i = 0; i < std::size_t(count) * block_faces; ++i) {
      const Vec3<T> c = i < face.size() ? centres[std::size_t(face[i])] : Vec3<T>(inf, inf, inf);
      x.push_back(c.x), y.push_back(c.y), z.push_back(c.z);
      if (i >= face.size()) continue;
      const T at[3] = {c.x, c.y, c.z};
      for (int j = 0; j < 3; ++j) {
        T &l = lo[j][i / block_faces], &h = hi[j][i / block_faces];
        const bool first = i % block_faces == 0;
        l = first || at[j] < l ? at[j] : l;
        h = first || at[j] > h ? at[j] : h;
      }
    }
    face.resize(std::size_t(count) * block_faces);
  }

 private:
  // Halves along the longest side, at a whole number of blocks.
  void split(const Points<T>& c, std::size_t from, std::size_t to) {
    if (to - from <= block_faces) {
      std::sort(face.begin() + long(from), face.begin() + long(to));
      return;
    }
    const std::vector<T>* axis[3] = {&c.x, &c.y, &c.z};
    const std::vector<T>* longest = axis[0];
    T most = -1;
    for (const auto* a : axis) {
      T l = (*a)[std::size_t(face[from])], h = l;
      for (std::size_t i = from; i < to; ++i)
        l = std::min(l, (*a)[std::size_t(face[i])]), h = std::max(h, (*a)[std::size_t(face[i])]);
      if (h - l > most) most = h - l, longest = a;
    }
    const std::size_t middle =
        from + ((to - from) / 2 + block_faces - 1) / block_faces * block_faces;
    const auto before = [&](Int i, Int j) {
      const T a = (*longest)[std::size_t(i)], b = (*longest)[std::size_t(j)];
      return a < b || (a == b && i < j);
    };
    std::nth_element(face.begin() + long(from), face.begin() + long(middle),
                     face.begin() + long(to), before);
    split(c, from, middle), split(c, middle, to);
  }
};

// The first vertex of each part of a surface connected through vertices, in the order of the faces.
inline std::vector<int> first_of_parts(const std::vector<std::array<int, 3>>& faces,
                                       std::size_t n) {
  std::vector<int> root(n), first;
  std::iota(root.begin(), root.end(), 0);
  const auto above = [&](int i) -> int& { return root[std::size_t(i)]; };
  const auto find = [&](int i) {
    while (above(i) != i) i = above(i) = above(above(i));
    return i;
  };
  for (const auto& f : faces)
    for (int i = 1; i < 3; ++i) {
      const int a = find(f[0]), b = find(f[std::size_t(i)]);
      above(std::max(a, b)) = std::min(a, b);  // so that a root is the least of its part
    }
  std::vector<char> seen(n);
  for (const auto& f : faces) {
    const int r = find(f[0]);
    if (!seen[std::size_t(r)]) seen[std::size_t(r)] = 1, first.push_back(r);
  }
  return first;
}

// One triangle mesh. `convex` asserts that it bounds a convex solid with outward faces.
template <class T>
struct Mesh {
  Points<T> vertices;
  std::vector<std::array<int, 3>> faces;
  std::vector<std::array<int, 3>> face_edges;  // of each face, the edges ab, bc, ca
  std::vector<std::array<int, 2>> edges;       // each undirected edge once
  Points<T> centres;                           // of the faces: the mean of three vertices
  Blocks<T> blocks;                            // the same centres, for the selection
  std::vector<T> corners;                      // of each face: nine coordinates in a row
  Cloud<T> cloud;                              // the vertices, for support functions
  std::vector<T> face_radius;       // from a face's centre to its farthest vertex, rounded up
  std::vector<Vec3<T>> own_points;  // one point of the solid in each of its parts
  Vec3<T> centre;                   // mean of the vertices
  T radius = 0;                     // from `centre` to the farthest vertex, rounded up
  T extent = 0;  // largest distance of a vertex from the frame's origin, rounded up
  bool convex = false;

  Mesh() = default;

  // vertices: n x 3, faces: m x 3 indices into them, both row by row.
  // A vertex that no face uses is not part of the body: the first used vertex replaces it.
  Mesh(const double* v, std::size_t n, const std::int32_t* f, std::size_t m, bool convex_)
      : convex(convex_) {
    std::vector<char> used(n, char(m == 0));
    for (std::size_t i = 0; i < 3 * m; ++i) used[std::size_t(f[i])] = 1;
    const std::size_t first = std::size_t(std::find(used.begin(), used.end(), 1) - used.begin());
    std::size_t count = 0;
    Vec3<double> sum;
    for (std::size_t i = 0; i < n; ++i) {
      const double* at = v + 3 * (used[i] ? i : first);
      const Vec3<double> p{at[0], at[1], at[2]};
      if (used[i]) sum = sum + p, ++count;
      vertices.push(Vec3<T>(p));
    }
    centre = Vec3<T>(sum * (1.0 / double(count)));
    for (std::size_t i = 0; i < n; ++i) {
      extent = std::fmax(extent, length(vertices[i]));
      radius = std::fmax(radius, length(vertices[i] - centre));
    }
    extent += rounding<T> * extent;
    radius += rounding<T> * extent;
    faces.reserve(m), face_edges.reserve(m);
    std::unordered_map<std::uint64_t, int> edge_of;
    for (std::size_t i = 0; i < m; ++i) {
      faces.push_back({f[3 * i], f[3 * i + 1], f[3 * i + 2]});
      const Triangle<T> t = triangle(int(i));
      const Vec3<T> c = (t.a + t.b + t.c) * (T(1) / T(3));
      centres.push(c);
      const T r = std::fmax(length(t.a - c), std::fmax(length(t.b - c), length(t.c - c)));
      face_radius.push_back(r + rounding<T> * extent);
      std::array<int, 3> own;
      for (int j = 0; j < 3; ++j) {
        const int s = faces[i][j], e = faces[i][(j + 1) % 3];
        const std::uint64_t key =
            (std::uint64_t(s < e ? s : e) << 32) | std::uint32_t(s < e ? e : s);
        const auto [at, fresh] = edge_of.try_emplace(key, int(edges.size()));
        if (fresh) edges.push_back({s, e});
        own[j] = at->second;
      }
      face_edges.push_back(own);
      corners.insert(corners.end(),
                     {t.a.x, t.a.y, t.a.z, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z});
    }
    blocks = Blocks<T>(centres);
    for (std::size_t i = 0; i < n; ++i) cloud.push(vertices[i]);
    cloud.pad();
    if (convex) own_points.push_back(centre);
    if (!convex)
      for (int i : first_of_parts(faces, n)) own_points.push_back(vertices[std::size_t(i)]);
  }

  // The vertices by table, relative to `centre` in units of `radius`.
  const SupportMap& supports() const {
    return support_map.get([this] {
      return SupportMap(vertices.x.data(), vertices.y.data(), vertices.z.data(), vertices.size(),
                        centre, radius);
    });
  }

  int size() const { return int(faces.size()); }
  Triangle<T> triangle(int f) const {
    return {vertices[faces[f][0]], vertices[faces[f][1]], vertices[faces[f][2]]};
  }

 private:
  OnDemand<SupportMap> support_map;
};

// A body: its convex pieces (one if it is convex, none if it is an undivided concave mesh) and the
// whole surface as one mesh.
template <class T>
struct Body {
  std::vector<Mesh<T>> pieces;
  Mesh<T> whole;
  Vec3<T> centre;  // mean of the centres of the pieces; for an undivided mesh, of its vertices
  T radius = 0;    // from `centre`, rounded up

  void close() {
    centre = whole.centre;
    if (!pieces.empty()) {
      Vec3<T> sum;
      for (const auto& piece : pieces) sum = sum + piece.centre;
      centre = sum * (T(1) / T(pieces.size()));
    }
    radius = 0;
    for (int i = 0; i < whole.vertices.size(); ++i)
      radius = std::fmax(radius, length(whole.vertices[i] - centre));
    radius += rounding<T> * whole.extent;
  }

  // Makes what a query with a screen would otherwise make first. See Options::screens.
  void make_tables() const {
    whole.supports();
    for (const auto& piece : pieces) piece.supports();
  }
};

}  // namespace ofg
