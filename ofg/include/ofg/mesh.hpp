// What is known of a body before any question is asked: vertices and face centres in structure-of-arrays.
#pragma once
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "triangle.hpp"

namespace ofg {

template <class T>
struct Points {
  std::vector<T> x, y, z;
  void push(const Vec3<T>& p) { x.push_back(p.x), y.push_back(p.y), z.push_back(p.z); }
  Vec3<T> operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  int size() const { return int(x.size()); }
};

// One triangle mesh. `convex` promises that it bounds a convex solid with outward faces.
template <class T>
struct Mesh {
  Points<T> vertices;
  std::vector<std::array<int, 3>> faces;
  std::vector<std::array<int, 3>> face_edges;  // of each face, the edges ab, bc, ca
  std::vector<std::array<int, 2>> edges;       // each undirected edge once
  Points<T> centres;                           // of the faces: the mean of three vertices
  std::vector<T> face_radius;                  // from a face's centre to its farthest vertex, rounded up
  Vec3<T> centre;                              // mean of the vertices
  T radius = 0;                                // from `centre` to the farthest vertex, rounded up
  T extent = 0;                                // largest distance of a vertex from the frame's origin, rounded up
  bool convex = false;

  Mesh() = default;

  // vertices: n x 3, faces: m x 3 indices into them, both row by row.
  Mesh(const double* v, std::size_t n, const std::int32_t* f, std::size_t m, bool convex_) : convex(convex_) {
    Vec3<double> sum;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3<double> p{v[3 * i], v[3 * i + 1], v[3 * i + 2]};
      sum = sum + p;
      vertices.push(Vec3<T>(p));
    }
    centre = Vec3<T>(sum * (1.0 / double(n)));
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
        const std::uint64_t key = (std::uint64_t(s < e ? s : e) << 32) | std::uint32_t(s < e ? e : s);
        const auto [at, fresh] = edge_of.try_emplace(key, int(edges.size()));
        if (fresh) edges.push_back({s, e});
        own[j] = at->second;
      }
      face_edges.push_back(own);
    }
  }

  int size() const { return int(faces.size()); }
  Triangle<T> triangle(int f) const { return {vertices[faces[f][0]], vertices[faces[f][1]], vertices[faces[f][2]]}; }
};

// A body: its convex pieces (one if it is convex, none if it is an undivided concave mesh) and the whole surface as one mesh.
template <class T>
struct Body {
  std::vector<Mesh<T>> pieces;
  Mesh<T> whole;
  Vec3<T> centre;  // mean of the centres of the pieces; of an undivided mesh, of its vertices
  T radius = 0;    // from `centre`, rounded up

  void close() {
    centre = whole.centre;
    if (!pieces.empty()) {
      Vec3<T> sum;
      for (const auto& piece : pieces) sum = sum + piece.centre;
      centre = sum * (T(1) / T(pieces.size()));
    }
    radius = 0;
    for (int i = 0; i < whole.vertices.size(); ++i) radius = std::fmax(radius, length(whole.vertices[i] - centre));
    radius += rounding<T> * whole.extent;
  }
};

}  // namespace ofg
