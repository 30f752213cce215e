// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Steps 2 to 5 and 7: the k faces nearest to a point, nearest first, and their bounding sphere.
#pragma once
#include <algorithm>
#include <vector>

#include "answer.hpp"
#include "mesh.hpp"
#include "motion.hpp"
#include "options.hpp"

namespace ofg {

// Entries in reserved memory: emptying and filling it writes nothing else.
template <class T>
class List {
 public:
  void reserve(std::size_t n) { store.resize(std::max(n, store.size())); }
  void clear() { used = 0; }
  void push_back(const T& x) { store[used++] = x; }
  void keep(std::size_t n) { used = n; }  // the first n entries of the memory
  std::size_t size() const { return used; }
  T* data() { return store.data(); }
  T* begin() { return store.data(); }
  T* end() { return store.data() + used; }
  const T* begin() const { return store.data(); }
  const T* end() const { return store.data() + used; }
  const T& operator[](std::size_t i) const { return store[i]; }
  void swap(List& other) { store.swap(other.store), std::swap(used, other.used); }

 private:
  std::vector<T> store;
  std::size_t used = 0;
};

template <class T>
struct Selection {
  List<Candidate<T>> near;           // nearest first; equal distances in the order of the faces
  std::vector<T> x, y, z;            // corners of the same faces as placed: all a, then all b,
                                     // then all c, each padded
  List<int> vertices, edges;         // of the selected faces, each once, nearest first
  List<int> vertex_face, edge_face;  // a selected face to which each belongs
  Vec3<T> centre;                    // mean of the faces' centres, in the body's own frame
  T radius = 0;  // from `centre` to the farthest vertex of the faces, rounded up

  int size() const { return int(near.size()); }
  int padded() const { return (size() + lanes<T> - 1) / lanes<T> * lanes<T>; }
  TriangleView<T> view() const {
    const T *px = x.data(), *py = y.data(), *pz = z.data();
    const int n = padded();
    return {{px, py, pz, px + n, py + n, pz + n, px + 2 * n, py + 2 * n, pz + 2 * n}};
  }
  Triangle<T> triangle(int i) const {
    const std::size_t a = std::size_t(i), n = std::size_t(padded()), b = a + n, c = b + n;
    return {{x[a], y[a], z[a]}, {x[b], y[b], z[b]}, {x[c], y[c], z[c]}};
  }
  // The corners, of both copies if there are two.
  CloudView<T> cloud(int copies = 1) const {
    return {x.data(), y.data(), z.data(), copies * 3 * padded()};
  }
};

// All memory of a query. Reserve once for the largest meshes; then no query allocates. One per
// thread.
template <class T>
struct Workspace {
  Selection<T> a, b;
  List<Candidate<T>> candidates;
  std::vector<std::uint32_t> seen_face, seen_vertex, seen_edge;
  std::uint32_t epoch = 0;
  std::vector<T> scratch, scratch_bound, box[6];
  std::vector<int> list;
  std::vector<typename IntOf<T>::type> ids;
  std::vector<unsigned char> flags;

  void reserve(const Mesh<T>& ma, const Mesh<T>& mb) {
    const std::size_t f = std::max(ma.faces.size(), mb.faces.size()) + 2 * block_faces;
    const std::size_t v = std::max(ma.vertices.x.size(), mb.vertices.x.size()),
                      e = std::max(ma.edges.size(), mb.edges.size()) + 2 * block_faces;
    if (f <= seen_face.size() && v <= seen_vertex.size() && e <= seen_edge.size()) return;
    const auto grow = [](auto& vector, std::size_t n) {
      vector.resize(std::max(n, vector.size()));
    };
    for (auto* s : {&a, &b}) {
      s->near.reserve(f + most_ranked), s->vertices.reserve(v), s->vertex_face.reserve(v),
          s->edges.reserve(e), s->edge_face.reserve(e);
      grow(s->x, 6 * f), grow(s->y, 6 * f), grow(s->z, 6 * f);
    }
    candidates.reserve(f + most_ranked);
    grow(seen_face, f), grow(seen_vertex, v), grow(seen_edge, e);
    grow(scratch, f + most_ranked), grow(scratch_bound, f), grow(list, f),
        grow(ids, f + most_ranked), grow(flags, std::max(f, e));
    for (auto& side : box) grow(side, e);
  }
  void reserve(const Body<T>& ba, const Body<T>& bb) {
    reserve(ba.whole, bb.whole);
    for (const auto* body : {&ba, &bb})  // also where the other body has no pieces
      for (const auto& piece : body->pieces) reserve(piece, piece);
  }
  std::uint32_t next_epoch() {
    if (++epoch == 0) {
      for (auto* s : {&seen_face, &seen_vertex, &seen_edge}) std::fill(s->begin(), s->end(), 0u);
      epoch = 1;
    }
    return epoch;
  }
};

namespace detail {

template <class T>
void k_nearest(List<Candidate<T>>& c, int k) {
  if (k < int(c.size())) {
    std::nth_element(c.begin(), c.begin() + k, c.end());
    c.keep(std::size_t(k));
  }
  std::sort(c.begin(), c.end());
}

// By centres, in blocks: used by most queries.
template <class T>
void nearest_centres(const Mesh<T>& m, const Vec3<T>& point, int k, Workspace<T>& w,
                     List<Candidate<T>>& found, Counts& counts) {
  const T p[3] = {point.x, point.y, point.z};
  NearestScratch<T> scratch{w.scratch_bound.data(), w.scratch.data(), w.list.data(), w.ids.data()};
  int evaluated;
  found.keep(
      std::size_t(kernels<T>.nearest(m.blocks.view(), p, k, scratch, found.data(), &evaluated)));
  counts.evaluated += evaluated;
  if (int(found.size()) > k) k_nearest(found, k);
}

// By distance to the faces themselves. A face is no nearer than its centre less its radius, and the
// k with the nearest centres bound the k-th distance, so most faces are rejected; those within
// `reach` never are.
template <class T>
void nearest_triangles(const Mesh<T>& m, const Vec3<T>& p, int k, T reach, Workspace<T>& w,
                       Counts& counts) {
  T limit = std::numeric_limits<T>::infinity();
  const T unit = unit_for(std::fmax(m.extent, largest(p))), back = 1 / unit;
  const Vec3<T> at = p * unit;
  const auto squared = [&](int face) {
    const Triangle<T> t = m.triangle(face);
    const T d = squared_distance(at, {t.a * unit, t.b * unit, t.c * unit});
    return d * back * back;
  };
  if (k <= block_faces && k <= m.size()) {
    nearest_centres(m, p, k, w, w.candidates, counts);
    T farthest = 0;
    for (const auto& c : w.candidates) farthest = std::fmax(farthest, squared(c.face));
    limit = std::fmax(std::sqrt(farthest), reach) + 4 * rounding<T> * (m.extent + length(p));
  }
  w.candidates.clear();
  for (int f = 0; f < m.size(); ++f) {
    const Vec3<T> d = m.centres[std::size_t(f)] - p;
    const T far = limit + m.face_radius[std::size_t(f)];
    if (dot(d, d) > far * far) continue;
    w.candidates.push_back({squared(f), f});
  }
  counts.evaluated += std::int64_t(w.candidates.size());
}

// By distance to the centres, face by face.
template <class T>
void all_centres(const Mesh<T>& m, const Vec3<T>& p, Workspace<T>& w, Counts& counts) {
  w.candidates.clear();
  for (int f = 0; f < m.size(); ++f) {
    const Vec3<T> d = m.centres[std::size_t(f)] - p;
    w.candidates.push_back({dot(d, d), f});
  }
  counts.evaluated += m.size();
}

// No point of the face is within `reach` of the point.
template <class T>
bool out_of_reach(const Mesh<T>& m, const Candidate<T>& c, T reach, Nearest nearest) {
  const T far = reach + rounding<T> * (m.extent + reach) +
                (nearest == Nearest::centre ? m.face_radius[std::size_t(c.face)] : T(0));
  return c.distance > far * far;
}

// The corners of the selected faces, as copy number `copy` (0, or 1 for the end of a sweep), in the
// frame of the mesh.
template <class T>
void gather(const Mesh<T>& m, Selection<T>& s, int copy = 0) {
  const std::size_t n = std::size_t(s.padded()), first = std::size_t(copy) * 3 * n;
  T *x = s.x.data() + first, *y = s.y.data() + first, *z = s.z.data() + first;
  for (std::size_t i = 0; i < n; ++i) {
    const T* c = &m.corners[9 * std::size_t(s.near[i < s.near.size() ? i : 0].face)];
    x[i] = c[0], y[i] = c[1], z[i] = c[2];
    x[n + i] = c[3], y[n + i] = c[4], z[n + i] = c[5];
    x[2 * n + i] = c[6], y[2 * n + i] = c[7], z[2 * n + i] = c[8];
  }
}

// Centre and radius of a selection; leaves its corners gathered in its own frame.
template <class T>
void bound(const Mesh<T>& m, Selection<T>& s) {
  Vec3<T> sum;
  for (const auto& x : s.near) sum = sum + m.centres[std::size_t(x.face)];
  s.centre = sum * (T(1) / T(s.size()));
  gather(m, s);
  const T p[3] = {s.centre.x, s.centre.y, s.centre.z};
  s.radius = std::sqrt(kernels<T>.farthest(s.x.data(), s.y.data(), s.z.data(), 3 * s.padded(), p)) +
             rounding<T> * m.extent;
}

}  // namespace detail

// The k faces nearest to each of `points` (in the mesh's frame), and their corners there. With
// adaptive k also every face that comes within `reach` of one of them.
template <class T>
void select(const Mesh<T>& m, const Vec3<T>* points, int n_points, const Options& o, T reach,
            Workspace<T>& w, Selection<T>& s, Counts& counts) {
  counts.distances += std::int64_t(n_points) * m.size();
  if (n_points == 1 && !o.adaptive_k && o.nearest == Nearest::centre && o.k <= block_faces) {
    detail::nearest_centres(m, points[0], o.k, w, s.near, counts);
    detail::bound(m, s);
    return;
  }
  const std::uint32_t epoch = w.next_epoch();
  s.near.clear();
  const auto take = [&](const Candidate<T>& x) {
    if (w.seen_face[std::size_t(x.face)] == epoch) return;
    w.seen_face[std::size_t(x.face)] = epoch;
    s.near.push_back(x);
  };
  for (int i = 0; i < n_points; ++i) {
    if (o.nearest == Nearest::triangle)
      detail::nearest_triangles(m, points[i], o.k, o.adaptive_k ? reach : T(0), w, counts);
    else
      detail::all_centres(m, points[i], w, counts);
    if (o.adaptive_k)
      for (const auto& x : w.candidates)
        if (!detail::out_of_reach(m, x, reach, o.nearest)) take(x);
    detail::k_nearest(w.candidates, o.k);
    for (const auto& x : w.candidates) take(x);
  }
  if (n_points > 1 || o.adaptive_k) std::sort(s.near.begin(), s.near.end());
  detail::bound(m, s);
}

// Gathered corners stay where they are, in another unit of length.
template <class T>
void measure_in(T unit, Selection<T>& s) {
  if (unit == 1) return;
  const T rows[9] = {unit, 0, 0, 0, unit, 0, 0, 0, unit}, shift[3] = {};
  kernels<T>.transform(s.x.data(), s.y.data(), s.z.data(), 3 * s.padded(), rows, shift);
}

// Moves the gathered corners to B's frame.
template <class T>
void move(const Transform<T>& to_b, Selection<T>& s, int copy = 0) {
  const T rows[9] = {to_b.r.row[0].x, to_b.r.row[0].y, to_b.r.row[0].z,
                     to_b.r.row[1].x, to_b.r.row[1].y, to_b.r.row[1].z,
                     to_b.r.row[2].x, to_b.r.row[2].y, to_b.r.row[2].z};
  const T shift[3] = {to_b.p.x, to_b.p.y, to_b.p.z};
  const int n = 3 * s.padded();
  kernels<T>.transform(s.x.data() + copy * n, s.y.data() + copy * n, s.z.data() + copy * n, n, rows,
                       shift);
}

// The vertices of the selected faces, each once: the starts of the virtual edges.
template <class T>
void list_vertices(const Mesh<T>& m, Workspace<T>& w, Selection<T>& s) {
  const std::uint32_t epoch = w.next_epoch();
  s.vertices.clear(), s.vertex_face.clear();
  for (const auto& x : s.near)
    for (int v : m.faces[std::size_t(x.face)])
      if (w.seen_vertex[std::size_t(v)] != epoch) {
        w.seen_vertex[std::size_t(v)] = epoch;
        s.vertices.push_back(v), s.vertex_face.push_back(x.face);
      }
}

template <class T>
void list_edges(const Mesh<T>& m, Workspace<T>& w, Selection<T>& s) {
  const std::uint32_t epoch = w.next_epoch();
  s.edges.clear(), s.edge_face.clear();
  for (const auto& x : s.near)
    for (int e : m.face_edges[std::size_t(x.face)])
      if (w.seen_edge[std::size_t(e)] != epoch) {
        w.seen_edge[std::size_t(e)] = epoch;
        s.edges.push_back(e), s.edge_face.push_back(x.face);
      }
}

}  // namespace ofg
