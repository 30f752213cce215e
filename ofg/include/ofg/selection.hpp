// Steps 2 to 5 and 7: the k faces nearest to a point, nearest first, and their bounding sphere.
#pragma once
#include <algorithm>
#include <vector>

#include "answer.hpp"
#include "mesh.hpp"
#include "motion.hpp"
#include "options.hpp"

namespace ofg {

template <class T>
struct Candidate {
  T distance;  // squared
  int face;
  bool operator<(const Candidate& c) const { return distance < c.distance || (distance == c.distance && face < c.face); }
};

template <class T>
struct Selection {
  std::vector<Candidate<T>> near;     // nearest first; equal distances in the order of the faces
  std::vector<Triangle<T>> triangle;  // the same faces, in B's frame
  std::vector<int> vertices, edges;   // of the selected faces, each once, nearest first
  std::vector<int> vertex_face, edge_face;  // a selected face each belongs to
  Vec3<T> centre;                     // mean of the faces' centres, in the body's own frame
  T radius = 0;                       // from `centre` to the farthest vertex of the faces, rounded up
  int size() const { return int(near.size()); }
};

// All memory a query needs. Reserve once for the largest meshes; then no query allocates. One per thread.
template <class T>
struct Workspace {
  Selection<T> a, b;
  std::vector<Candidate<T>> candidates;
  std::vector<std::uint32_t> seen_face, seen_vertex, seen_edge;
  std::uint32_t epoch = 0;
  std::vector<Vec3<T>> from, to;  // ends of virtual edges

  void reserve(const Mesh<T>& ma, const Mesh<T>& mb) {
    const std::size_t f = std::max(ma.faces.size(), mb.faces.size());
    const std::size_t v = std::max(ma.vertices.x.size(), mb.vertices.x.size()), e = std::max(ma.edges.size(), mb.edges.size());
    if (f <= seen_face.size() && v <= seen_vertex.size() && e <= seen_edge.size()) return;
    for (auto* s : {&a, &b}) {
      s->near.reserve(f), s->triangle.reserve(f), s->vertices.reserve(v), s->vertex_face.reserve(v);
      s->edges.reserve(e), s->edge_face.reserve(e);
    }
    candidates.reserve(f);
    seen_face.resize(std::max(f, seen_face.size())), seen_vertex.resize(std::max(v, seen_vertex.size()));
    seen_edge.resize(std::max(e, seen_edge.size()));
    from.reserve(v), to.reserve(v);
  }
  void reserve(const Body<T>& ba, const Body<T>& bb) {
    reserve(ba.whole, bb.whole);
    for (const auto& p : ba.pieces)
      for (const auto& q : bb.pieces) reserve(p, q);
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

// Insertion beats a partial sort while the selection fits in a few cache lines.
constexpr int insertion_limit = 32;

template <class T>
void k_nearest(std::vector<Candidate<T>>& c, int k) {
  if (k >= int(c.size())) {
    std::sort(c.begin(), c.end());
  } else if (k > insertion_limit) {
    std::partial_sort(c.begin(), c.begin() + k, c.end());
  } else {
    Candidate<T> best[insertion_limit];
    int n = 0;
    for (const auto& x : c) {
      if (n == k && !(x < best[n - 1])) continue;
      int i = n < k ? n++ : k - 1;
      for (; i > 0 && x < best[i - 1]; --i) best[i] = best[i - 1];
      best[i] = x;
    }
    std::copy(best, best + n, c.begin());
  }
  if (k < int(c.size())) c.resize(std::size_t(k));
}

template <class T>
T squared_distance_to(const Mesh<T>& m, int f, const Vec3<T>& p, Nearest nearest) {
  if (nearest == Nearest::triangle) return squared_distance(p, m.triangle(f));
  const Vec3<T> d = m.centres[f] - p;
  return dot(d, d);
}

// No point of the face is within `reach` of the point.
template <class T>
bool out_of_reach(const Mesh<T>& m, const Candidate<T>& c, T reach, Nearest nearest) {
  const T far = reach + rounding<T> * (m.extent + reach) + (nearest == Nearest::centre ? m.face_radius[c.face] : T(0));
  return c.distance > far * far;
}

}  // namespace detail

// The k faces nearest to each of `points` (in the mesh's frame). With adaptive k also every face that comes within `reach` of
// one of them.
template <class T>
void select(const Mesh<T>& m, const Vec3<T>* points, int n_points, const Options& o, T reach, Workspace<T>& w, Selection<T>& s,
            Counts& counts) {
  const std::uint32_t epoch = w.next_epoch();
  s.near.clear();
  for (int i = 0; i < n_points; ++i) {
    auto& c = w.candidates;
    c.clear();
    for (int f = 0; f < m.size(); ++f) c.push_back({detail::squared_distance_to(m, f, points[i], o.nearest), f});
    counts.distances += m.size();
    const auto take = [&](const Candidate<T>& x) {
      if (w.seen_face[x.face] == epoch) return;
      w.seen_face[x.face] = epoch;
      s.near.push_back(x);
    };
    if (o.adaptive_k)
      for (const auto& x : c)
        if (!detail::out_of_reach(m, x, reach, o.nearest)) take(x);
    detail::k_nearest(c, o.k);
    for (const auto& x : c) take(x);
  }
  if (n_points > 1 || o.adaptive_k) std::sort(s.near.begin(), s.near.end());
  Vec3<T> sum;
  for (const auto& x : s.near) sum = sum + m.centres[x.face];
  s.centre = sum * (T(1) / T(s.size()));
  s.radius = 0;
  for (const auto& x : s.near) {
    const Triangle<T> t = m.triangle(x.face);
    s.radius = std::fmax(s.radius, std::fmax(length(t.a - s.centre), std::fmax(length(t.b - s.centre), length(t.c - s.centre))));
  }
  s.radius += rounding<T> * m.extent;
}

// The selected faces in B's frame.
template <class T>
void place(const Mesh<T>& m, const Transform<T>& to_b, Selection<T>& s) {
  s.triangle.clear();
  for (const auto& x : s.near) {
    const Triangle<T> t = m.triangle(x.face);
    s.triangle.push_back({to_b(t.a), to_b(t.b), to_b(t.c)});
  }
}

template <class T>
void place(const Mesh<T>& m, Selection<T>& s) {
  s.triangle.clear();
  for (const auto& x : s.near) s.triangle.push_back(m.triangle(x.face));
}

// The vertices of the selected faces, each once: the starts of the virtual edges.
template <class T>
void list_vertices(const Mesh<T>& m, Workspace<T>& w, Selection<T>& s) {
  const std::uint32_t epoch = w.next_epoch();
  s.vertices.clear(), s.vertex_face.clear();
  for (const auto& x : s.near)
    for (int v : m.faces[x.face])
      if (w.seen_vertex[v] != epoch) {
        w.seen_vertex[v] = epoch;
        s.vertices.push_back(v), s.vertex_face.push_back(x.face);
      }
}

template <class T>
void list_edges(const Mesh<T>& m, Workspace<T>& w, Selection<T>& s) {
  const std::uint32_t epoch = w.next_epoch();
  s.edges.clear(), s.edge_face.clear();
  for (const auto& x : s.near)
    for (int e : m.face_edges[x.face])
      if (w.seen_edge[e] != epoch) {
        w.seen_edge[e] = epoch;
        s.edges.push_back(e), s.edge_face.push_back(x.face);
      }
}

}  // namespace ofg
