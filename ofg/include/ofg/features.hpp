// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Contacts of two moving meshes on chords: vertices against faces, edges against edges; and their
// times on the true paths.
#pragma once
#include "overlap.hpp"

namespace ofg::detail {

// A part of the step, with the poses of A in B's frame at its ends.
template <class T>
struct Window {
  double t0, t1;
  Transform<double> start, end;
  double at(double share) const { return t0 + (t1 - t0) * share; }
};

// Bound on all coordinates tested in a window, in B's frame, and on the lengths that determine the
// rounding of its poses.
template <class T>
T scale_of(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Window<T>& w) {
  const T ends = std::fmax(scale_of(a, b, Vec3<T>(w.start.p)), scale_of(a, b, Vec3<T>(w.end.p)));
  return std::fmax(ends, T(track.arms()));
}

// The features in contact, for the time of impact: a vertex and a face, or two edges.
struct Contact {
  Found found = Found::nothing;
  double share = 2;  // of the window
  int moving = -1, fixed = -1;
  int face_a = -1, face_b = -1;
};

// Virtual edges: the chords of the selected vertices of `m`, from `start` to `end`, against the
// other's selected faces, all in the other's frame. Stops at the first hit, or finds the earliest.
// The other's faces are already gathered in the unit of length of `scale`, and the transforms yield
// the vertices in the same unit.
template <class T>
bool virtual_edges_meet(const Mesh<T>& m, const Selection<T>& s, const Transform<T>& start,
                        const Transform<T>& end, const Selection<T>& other, T scale, bool swapped,
                        bool earliest, Workspace<T>& w, Contact& contact, Counts& counts) {
  bool hit = false;
  const TriangleView<T> faces = other.view();
  for (std::size_t i = 0; i < s.vertices.size(); ++i) {
    const Vec3<T> v = m.vertices[std::size_t(s.vertices[i])], p = start(v), q = end(v);
    const T segment[6] = {p.x, p.y, p.z, q.x, q.y, q.z};
    kernels<T>.segments_miss(faces, other.padded(), segment, rounding<T> * scale, w.flags.data());
    for (int j = 0; j < other.size(); ++j) {
      ++counts.edge_faces;
      if (w.flags[std::size_t(j)]) continue;
      const T share = segment_meets(p, q, other.triangle(j), scale);
      if (share < 0 || !(share < contact.share)) continue;
      const int own = s.vertex_face[i], its = other.near[std::size_t(j)].face;
      contact = {swapped ? Found::face_edge : Found::edge_face,
                 double(share),
                 s.vertices[i],
                 its,
                 swapped ? its : own,
                 swapped ? own : its};
      hit = true;
      if (!earliest) return true;
    }
  }
  return hit;
}

// Boxes of B's selected edges in a unit of length, to reject most pairs of edges.
template <class T>
BoxView<T> edge_boxes(const Mesh<T>& m, const Selection<T>& s, T unit, Workspace<T>& w) {
  const std::size_t n = s.edges.size(), padded = (n + lanes<T> - 1) / lanes<T> * lanes<T>;
  for (std::size_t i = 0; i < padded; ++i) {
    const auto& e = m.edges[std::size_t(s.edges[i < n ? i : 0])];
    const Vec3<T> p = m.vertices[std::size_t(e[0])] * unit,
                  q = m.vertices[std::size_t(e[1])] * unit;
    w.box[0][i] = std::fmin(p.x, q.x), w.box[1][i] = std::fmin(p.y, q.y),
    w.box[2][i] = std::fmin(p.z, q.z);
    w.box[3][i] = std::fmax(p.x, q.x), w.box[4][i] = std::fmax(p.y, q.y),
    w.box[5][i] = std::fmax(p.z, q.z);
  }
  return {{w.box[0].data(), w.box[1].data(), w.box[2].data()},
          {w.box[3].data(), w.box[4].data(), w.box[5].data()}};
}

template <class T>
bool moving_edges_meet(const Mesh<T>& a, const Mesh<T>& b, const Transform<T>& start,
                       const Transform<T>& end, T scale, T unit, bool earliest, Workspace<T>& w,
                       Contact& contact, Counts& counts) {
  bool hit = false;
  const BoxView<T> boxes = edge_boxes(b, w.b, unit, w);
  const int padded = int((w.b.edges.size() + lanes<T> - 1) / lanes<T> * lanes<T>);
  const T slack = rounding<T> * scale;
  for (std::size_t i = 0; i < w.a.edges.size(); ++i) {
    const auto& e = a.edges[std::size_t(w.a.edges[i])];
    const Vec3<T> p = start(a.vertices[std::size_t(e[0])]),
                  q = start(a.vertices[std::size_t(e[1])]);
    const Vec3<T> r = end(a.vertices[std::size_t(e[0])]), s = end(a.vertices[std::size_t(e[1])]);
    const auto low = [](T k, T l, T m, T n) { return std::fmin(std::fmin(k, l), std::fmin(m, n)); };
    const T box[6] = {low(p.x, q.x, r.x, s.x),      low(p.y, q.y, r.y, s.y),
                      low(p.z, q.z, r.z, s.z),      -low(-p.x, -q.x, -r.x, -s.x),
                      -low(-p.y, -q.y, -r.y, -s.y), -low(-p.z, -q.z, -r.z, -s.z)};
    kernels<T>.boxes_apart(boxes, padded, box, slack, w.flags.data());
    for (std::size_t j = 0; j < w.b.edges.size(); ++j) {
      ++counts.edge_pairs;
      if (w.flags[j]) continue;
      const auto& f = b.edges[std::size_t(w.b.edges[j])];
      const Vec3<T> from = b.vertices[std::size_t(f[0])] * unit,
                    to = b.vertices[std::size_t(f[1])] * unit;
      const T share = edges_cross(p, q, r - p, s - q, from, to, scale);
      if (share < 0 || !(share < contact.share)) continue;
      contact = {Found::edge_edge, double(share),    w.a.edges[i],
                 w.b.edges[j],     w.a.edge_face[i], w.b.edge_face[j]};
      hit = true;
      if (!earliest) return true;
    }
  }
  return hit;
}

// Signed measure that is zero when the features in contact meet: a vertex in the plane of a face,
// two edges in one plane.
template <class T>
double measure(const Mesh<T>& a, const Mesh<T>& b, const Contact& c,
               const Transform<double>& a_to_b) {
  const auto vertex = [](const Mesh<T>& m, int v) { return Vec3<double>(m.vertices[v]); };
  if (c.found == Found::edge_edge) {
    const auto& e = a.edges[c.moving];
    const auto& f = b.edges[c.fixed];
    const Vec3<double> p = a_to_b(vertex(a, e[0])), q = a_to_b(vertex(a, e[1])),
                       s = vertex(b, f[0]);
    return triple(q - p, vertex(b, f[1]) - s, p - s);
  }
  const bool swapped = c.found == Found::face_edge;
  const Mesh<T>&moved = swapped ? b : a, &still = swapped ? a : b;
  const auto& f = still.faces[c.fixed];
  const Vec3<double> o = vertex(still, f[0]),
                     n = cross(vertex(still, f[1]) - o, vertex(still, f[2]) - o),
                     v = vertex(moved, c.moving);
  return dot(n, (swapped ? a_to_b.inverse()(v) : a_to_b(v)) - o);
}

// The velocity estimate on the real motion: the time in the window at which the features that met
// on the chords meet on their true paths. Regula falsi in the Illinois form, which keeps a bracket;
// the chord's own time if there is none (two edges that pass one another and return).
template <class T>
double velocity_time(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Window<T>& w,
                     const Contact& c) {
  const double guess = w.at(c.share);
  if (!track.turns()) return guess;
  const auto f = [&](double t) { return measure(a, b, c, track.at(t)); };
  double lo = w.t0, hi = w.t1, flo = f(lo), fhi = f(hi);
  if (flo == 0) return lo;
  if ((flo > 0) == (fhi > 0)) return guess;
  double t = guess;
  int side = 0;
  for (int i = 0; i < 60 && hi - lo > 4e-16 * hi; ++i) {
    const double ft = f(t);
    if (ft == 0) return t;
    if ((ft > 0) == (flo > 0)) {
      lo = t, flo = ft;
      if (side == 1) fhi /= 2;
      side = 1;
    } else {
      hi = t, fhi = ft;
      if (side == 2) flo /= 2;
      side = 2;
    }
    const double next = (flo * hi - fhi * lo) / (flo - fhi);
    if (next == t) break;
    t = next > lo && next < hi ? next : (lo + hi) / 2;
  }
  return t;
}

// Step 4 (and its repairs) over a window, on existing selections. Leaves B's selection gathered,
// and A's not.
template <class T>
bool features_meet(const Mesh<T>& a, const Mesh<T>& b, const Transform<double>& start,
                   const Transform<double>& end, const Options& o, T scale, Workspace<T>& w,
                   Contact& contact, Counts& counts) {
  const T unit = unit_for(scale), size = scale * unit;
  const Transform<T> s(start), e(end), su = s.in_units(unit), eu = e.in_units(unit);
  bool hit = virtual_edges_meet(a, w.a, su, eu, w.b, size, false, o.earliest, w, contact, counts);
  if (hit && !o.earliest) return true;
  if (o.both_vertices) {
    gather(a, w.a), measure_in(unit, w.a);
    const Transform<T> back = s.inverse().in_units(unit), back_end = e.inverse().in_units(unit);
    hit |=
        virtual_edges_meet(b, w.b, back, back_end, w.a, size, true, o.earliest, w, contact, counts);
    if (hit && !o.earliest) return true;
  }
  if (o.edge_edge)
    hit |= moving_edges_meet(a, b, su, eu, size, unit, o.earliest, w, contact, counts);
  return hit;
}

}  // namespace ofg::detail
