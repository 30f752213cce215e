// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The article, step by step, as its author wrote it: plain loops, without bounds, rejections or
// repairs. Kara, "Opposing Face Geometry", GameDev.net 2004. ARTICLE.md names the function here for
// each sentence of the article. `ofg::overlap` and `ofg::sweep` give the same answers with
// accelerations; a test and the fuzzer compare them.
#pragma once
#include "ofg.hpp"

namespace ofg::article {

// Data shared by the steps of one query: the two meshes, A's poses in B's frame, and the memory.
template <class T>
struct Objects {
  const Mesh<T>&a, &b;
  const Track& track;
  const Options& options;
  Workspace<T>& w;
  Answer& answer;

  Transform<double> start = track.at(0), end = track.at(1);
  ofg::detail::Window<T> step() const { return {0, 1, start, end}; }
};

// Step 1. If the bounding spheres of the objects are disjoint: no collision. For moving objects at
// the start, the literal reading; `Broad::swept` sweeps the spheres along the motion.
template <class T>
bool bounding_spheres_apart(Objects<T>& o, bool moving) {
  ++o.answer.counts.spheres;
  if (moving && o.options.broad == Broad::swept) {
    const double room = rounding<T> * (length(o.start.p) + length(o.end.p) +
                                       2 * (o.a.extent + o.b.extent + o.track.arms()));
    return ofg::detail::swept_spheres_apart(o.a, o.b, o.track, 0, 1, room);
  }
  const Vec3<double> between =
      o.track.between(Vec3<double>(o.a.centre), Vec3<double>(o.b.centre), 0);
  const double slack = rounding<T> * (length(o.start.p) + o.a.extent + o.b.extent + o.track.arms());
  return ofg::detail::spheres_apart(between, double(o.a.radius) + double(o.b.radius) + slack);
}

// Steps 2 and 4, and 7: the k faces whose centres are closest to a point, by increasing distance.
template <class T>
void select_closest(const Mesh<T>& m, const Vec3<T>& point, Objects<T>& o, Selection<T>& s) {
  o.answer.counts.distances += m.size();
  ofg::detail::all_centres(m, point, o.w, o.answer.counts);
  ofg::detail::k_nearest(o.w.candidates, o.options.k);
  s.near.clear();
  for (const auto& face : o.w.candidates) s.near.push_back(face);
}

// Steps 3 and 5, first half: the centre of a selection.
template <class T>
void find_centre(const Mesh<T>& m, Selection<T>& s) {
  Vec3<T> sum;
  for (const auto& face : s.near) sum = sum + m.centres[std::size_t(face.face)];
  s.centre = sum * (T(1) / T(s.size()));
}

// Steps 3 and 5, second half: its bounding radius.
template <class T>
void find_radius(const Mesh<T>& m, Selection<T>& s) {
  T most = 0;
  for (const auto& face : s.near) {
    const Triangle<T> t = m.triangle(face.face);
    for (const Vec3<T>& v : {t.a, t.b, t.c})
      most = std::fmax(most, dot(v - s.centre, v - s.centre));
  }
  s.radius = std::sqrt(most) + rounding<T> * m.extent;
}

// Steps 2 to 5 and 7. `spheres`: with the bounding radii, which a moving query does not need.
template <class T>
void select_faces(Objects<T>& o, bool spheres) {
  const Transform<T> to_a(o.start.inverse()), to_b(o.start);
  select_closest(o.a, to_a(o.b.centre), o, o.w.a);  // 2
  find_centre(o.a, o.w.a);                          // 3
  if (spheres) find_radius(o.a, o.w.a);
  select_closest(o.b, to_b(o.w.a.centre), o, o.w.b);  // 4
  find_centre(o.b, o.w.b);                            // 5
  if (spheres) find_radius(o.b, o.w.b);
}

// Step 6. If the bounding spheres of the selections are disjoint: no collision.
template <class T>
bool selection_spheres_apart(Objects<T>& o) {
  ++o.answer.counts.spheres;
  const double slack = rounding<T> * (length(o.start.p) + o.a.extent + o.b.extent);
  const Vec3<double> between(Transform<T>(o.start)(o.w.a.centre) - o.w.b.centre);
  return ofg::detail::spheres_apart(between, double(o.w.a.radius) + double(o.w.b.radius) + slack);
}

// Step 8. Face against face, the closest first, until two meet. A is at `pose` in B's frame. scale:
// a bound on all coordinates, which separates rounding from distance; lengths are in a unit derived
// from it, so that no product overflows or underflows.
template <class T>
bool faces_meet(Objects<T>& o, const Transform<double>& pose, T scale) {
  const T unit = unit_for(scale);
  const Transform<T> to_b = Transform<T>(pose).in_units(unit);
  for (const auto& mine : o.w.a.near) {
    const Triangle<T> t = o.a.triangle(mine.face), placed{to_b(t.a), to_b(t.b), to_b(t.c)};
    for (const auto& other : o.w.b.near) {
      ++o.answer.counts.face_pairs, ++o.answer.counts.full_tests;
      if (!triangles_meet(placed, in_units(o.b.triangle(other.face), unit), scale * unit)) continue;
      o.answer.face_a = mine.face, o.answer.face_b = other.face;
      return true;
    }
  }
  return false;
}

// Moving objects, steps 3 and 4: each vertex of A's selection is joined to its copy at the end of
// the step, rotated before it is translated, and this virtual edge is tested against B's selection.
// Stops at the first hit.
template <class T>
bool virtual_edges_meet(Objects<T>& o, T scale, ofg::detail::Contact& contact) {
  const T unit = unit_for(scale);
  const Transform<T> start = Transform<T>(o.start).in_units(unit),
                     end = Transform<T>(o.end).in_units(unit);
  list_vertices(o.a, o.w, o.w.a);
  for (std::size_t i = 0; i < o.w.a.vertices.size(); ++i) {
    const int vertex = o.w.a.vertices[i];
    const Vec3<T> v = o.a.vertices[std::size_t(vertex)], p = start(v), q = end(v);
    for (const auto& other : o.w.b.near) {
      ++o.answer.counts.edge_faces;
      const T share = segment_meets(p, q, in_units(o.b.triangle(other.face), unit), scale * unit);
      if (share < 0) continue;
      contact = {Found::edge_face, double(share),        vertex,
                 other.face,       o.w.a.vertex_face[i], other.face};
      return true;
    }
  }
  return false;
}

// The second way to compute the time of impact: move half of the step and test; if nothing meets,
// move half of the remainder, and so on. NaN if none of at most `halvings` moves meets.
template <class T>
double halving_time(Objects<T>& o, T scale) {
  double t = 0;
  for (int i = 0; i < o.options.iterations; ++i) {
    t += (1 - t) / 2;
    ++o.answer.counts.steps;
    if (faces_meet(o, o.track.at(t), scale)) return t;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// The time of a virtual edge's hit, by the chosen method. The faces that met stay those of the
// edge.
template <class T>
double time_of_impact(Objects<T>& o, T scale, const ofg::detail::Contact& contact) {
  const Answer before = o.answer;
  double time = std::numeric_limits<double>::quiet_NaN();
  if (o.options.toi == Toi::velocity) {
    time = ofg::detail::velocity_time(o.a, o.b, o.track, o.step(), contact);
  } else if (o.options.toi == Toi::halving) {
    time = halving_time(o, scale);
  }
  o.answer.face_a = before.face_a, o.answer.face_b = before.face_b;
  return time;
}

// The discrete algorithm, steps 1 to 8.
template <class T>
Answer overlap(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Options& options,
               Workspace<T>& w) {
  Answer answer;
  answer.counts.steps = 1;
  Objects<T> o{a, b, track, options, w, answer};
  if (bounding_spheres_apart(o, false)) return answer;
  select_faces(o, true);
  if (selection_spheres_apart(o)) return answer;
  answer.hit = faces_meet(o, o.start, ofg::detail::scale_of(a, b, Vec3<T>(o.start.p)));
  if (answer.hit) answer.found = Found::start;
  return answer;
}

// The moving objects, steps 1 to 6: step 1 is in `track`; step 2 is the selection, without radii
// and without step 6. By default the faces at both ends are tried first, since then "there is no
// need to interpolate the collision time", which is 0 or 1; `Order::steps` is the article's list of
// steps read literally, virtual edges first.
template <class T>
Answer sweep(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Options& options,
             Workspace<T>& w) {
  Answer answer;
  answer.counts.steps = 1;
  Objects<T> o{a, b, track, options, w, answer};
  if (bounding_spheres_apart(o, true)) return answer;  // step 1 of the discrete algorithm
  select_faces(o, false);                              // 2
  const T scale = ofg::detail::scale_of(a, b, track, o.step());
  ofg::detail::Contact contact;
  const auto at_an_end = [&] {
    for (const Found at : {Found::start, Found::end}) {  // 5, 6
      if (!faces_meet(o, at == Found::start ? o.start : o.end, scale)) continue;
      answer.hit = true, answer.found = at, answer.time = at == Found::start ? 0 : 1;
      return true;
    }
    return false;
  };
  const auto in_between = [&] {
    if (!virtual_edges_meet(o, scale, contact)) return false;  // 3, 4
    answer.hit = true, answer.found = contact.found, answer.face_a = contact.face_a,
    answer.face_b = contact.face_b;
    answer.time = time_of_impact(o, scale, contact);
    return true;
  };
  if (options.order == Order::ends) {
    if (!at_an_end()) in_between();
  } else if (!in_between()) {
    at_an_end();
  }
  return answer;
}

// Concave objects, steps 1 to 3: the piece of A closest to the whole of B, the piece of B closest
// to that piece; the algorithm then tests these two.
template <class T, class Ask>
Answer closest_pieces(const Body<T>& a, const Body<T>& b, const Track& track, Ask ask) {
  Counts counts;
  const ofg::detail::Pair<T> pair = ofg::detail::opposing_pieces(a, b, track, counts);
  Answer answer = ask(pair.a, pair.b);
  answer.piece_a = pair.piece_a, answer.piece_b = pair.piece_b;
  answer.counts.add(counts);
  return answer;
}

template <class T>
Answer overlap(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o,
               Workspace<T>& w) {
  return closest_pieces(a, b, track, [&](const Mesh<T>& x, const Mesh<T>& y) {
    return article::overlap(x, y, track, o, w);
  });
}

template <class T>
Answer sweep(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o,
             Workspace<T>& w) {
  return closest_pieces(a, b, track, [&](const Mesh<T>& x, const Mesh<T>& y) {
    return article::sweep(x, y, track, o, w);
  });
}

}  // namespace ofg::article
