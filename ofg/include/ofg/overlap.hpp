// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Discrete OFG: whether two meshes meet at one pair of poses. Steps are numbered as in the article.
#pragma once
#include "containment.hpp"
#include "screen.hpp"
#include "selection.hpp"

namespace ofg {
namespace detail {

// Bound on the coordinates, in B's frame, of everything that is tested.
template <class T>
T scale_of(const Mesh<T>& a, const Mesh<T>& b, const Vec3<T>& p) {
  return std::fmax(a.extent + length(p), b.extent);
}

inline bool spheres_apart(const Vec3<double>& between, double sum) {
  return dot(between, between) > sum * sum;
}

// triangles_meet, after the planes of the two have been tried. `axis`: a separating axis from t0 to
// s0, if there is one.
template <class T>
bool edges_meet(const Triangle<T>& s0, const Triangle<T>& t0, T slack, Vec3<T>& axis) {
  const Vec3<T> o = t0.a;
  const Triangle<T> s{s0.a - o, s0.b - o, s0.c - o}, t{{}, t0.b - o, t0.c - o};
  const T cs[9] = {s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z, s.c.x, s.c.y, s.c.z};
  const T ct[9] = {0, 0, 0, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z};
  T best[3];
  if (kernels<T>.edges_apart(cs, ct, slack, best)) return axis = {best[0], best[1], best[2]}, false;
  return !((sliver(s) || sliver(t)) && slivers_apart(s, t, slack));
}

// Whether the plane of one of the selected faces separates the selections. `axis`: the normal of
// the best plane, from B to A. A plane with one side in front of it is a candidate; the points of
// the other side are tested against it, because the normal of a sliver is mostly rounding, and a
// mesh need not be convex.
template <class T, class Along>
bool walled_off(const Selection<T>& a, const Selection<T>& b, T gap, Vec3<T>& axis, Along along) {
  T n[3], m[3];
  const T of_b = kernels<T>.planes_gap(b.view(), b.padded(), a.cloud(), n);
  if (of_b > gap && separated(axis = {n[0], n[1], n[2]}, gap, along, 1)) return true;
  const T of_a = kernels<T>.planes_gap(a.view(), a.padded(), b.cloud(), m);
  if (of_a > gap && separated(axis = {-m[0], -m[1], -m[2]}, gap, along, 1)) return true;
  const bool first = of_b > of_a;
  if ((first ? of_b : of_a) > -std::numeric_limits<T>::infinity())
    axis = first ? Vec3<T>(n[0], n[1], n[2]) : Vec3<T>(-m[0], -m[1], -m[2]);
  return false;
}

// Step 8: face against face, the nearest first, until two meet. Tests that settle many pairs at
// once are tried where they are likely to succeed: the planes of the faces before the first row,
// the axis that separated a pair after it, and a search for any plane after the row.
template <class T>
bool faces_meet(const Selection<T>& a, const Selection<T>& b, T scale, Vec3<T> axis,
                Screened screened, Workspace<T>& w, Answer& answer) {
  const T slack = rounding<T> * scale, gap = 4 * slack;
  const CloudView<T> cloud_a = a.cloud(), cloud_b = b.cloud();
  const auto along = [&](const Vec3<T>& v) { return support(cloud_a, cloud_b, v); };
  const std::int64_t all = answer.counts.face_pairs + std::int64_t(a.size()) * b.size();
  const auto settled = [&] {
    answer.counts.face_pairs = all;
    return false;
  };
  if (screened != Screened::meeting && walled_off(a, b, gap, axis, along)) return settled();
  const TriangleView<T> faces = b.view();
  for (int i = 0; i < a.size(); ++i) {
    if (i == 1 && separated(axis, gap, along)) return settled();
    const Triangle<T> t = a.triangle(i);
    const T corners[9] = {t.a.x, t.a.y, t.a.z, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z};
    kernels<T>.planes_apart(faces, b.padded(), corners, slack, w.flags.data());
    for (int j = 0; j < b.size(); ++j) {
      ++answer.counts.face_pairs;
      if (w.flags[std::size_t(j)]) continue;
      ++answer.counts.full_tests;
      Vec3<T> own;
      if (edges_meet(t, b.triangle(j), slack, own)) {
        answer.face_a = a.near[std::size_t(i)].face, answer.face_b = b.near[std::size_t(j)].face;
        return true;
      }
      if (i == 0 && !(own == Vec3<T>()) && separated(own, gap, along, 1)) return settled();
    }
  }
  return false;
}

// Used if the k nearest faces do not meet, since intersecting bodies have faces to report, and
// before k grows: all faces cost up to a hundred times as much if the bodies penetrate deeply.
template <class T>
bool holds(const Mesh<T>& a, const Mesh<T>& b, const Transform<T>& a_to_b, const Options& o,
           Answer& answer) {
  if (!o.containment || !one_inside_other(a, b, a_to_b)) return false;
  answer.found = Found::inside;
  return true;
}

// State of a discrete query after step 1.
template <class T>
struct Near {
  Transform<T> to_b, to_a;
  double slack;
  Screened screened;
};

// Steps 2 to 8 with one choice of k.
template <int Last, class T>
void oppose(const Mesh<T>& a, const Mesh<T>& b, const Near<T>& near, const Options& o,
            Workspace<T>& w, Answer& answer) {
  if constexpr (Last < 2) return;
  Counts& counts = answer.counts;
  const Vec3<T> centre_b = near.to_a(b.centre);
  select(a, &centre_b, 1, o, b.radius, w, w.a, counts);  // 2, 3, 7
  if constexpr (Last < 4) return;
  const Vec3<T> centre_a = near.to_b(w.a.centre);
  select(b, &centre_a, 1, o, w.a.radius, w, w.b, counts);  // 4, 5, 7
  ++counts.spheres;
  if (spheres_apart(Vec3<double>(centre_a - w.b.centre),
                    double(w.a.radius) + double(w.b.radius) + near.slack))
    return;  // 6
  if constexpr (Last < 8) return;
  const T scale = scale_of(a, b, near.to_b.p), unit = unit_for(scale);
  move(near.to_b.in_units(unit), w.a), measure_in(unit, w.b);
  answer.hit = faces_meet(w.a, w.b, scale * unit, (centre_a - w.b.centre) * unit, near.screened, w,
                          answer);  // 8
  if (answer.hit) answer.found = Found::start;
}

// One plane between the hulls of the whole meshes at one pose.
template <class T>
bool hulls_apart(const Mesh<T>& a, const Mesh<T>& b, const Transform<T>& to_b, T gap,
                 Vec3<T>& axis) {
  const Mat3<T> back = to_b.r.transposed();
  const CloudView<T> hull_a = a.cloud.view(), hull_b = b.cloud.view();
  static constexpr T zeros[lanes<T>] = {};
  const CloudView<T> origin{zeros, zeros, zeros, lanes<T>};
  const T unit = unit_for(scale_of(a, b, to_b.p));
  const auto least = [&](const Vec3<T>& v) {
    return (to_b(support(hull_a, origin, back * v)) + support(origin, hull_b, v)) * unit;
  };
  return separated(axis, gap * unit, least, 24);
}

// Steps 2 to 8 with the given k, whatever the repairs.
template <int Last, class T>
void oppose_once(const Mesh<T>& a, const Mesh<T>& b, const Near<T>& near, const Options& o,
                 Workspace<T>& w, Answer& answer) {
  Options once = o;
  once.adaptive_k = false;
  oppose<Last>(a, b, near, once, w, answer);
}

}  // namespace detail

// Convex or not, `a` and `b` are tested as surfaces (with `containment` as solids). Does not
// allocate once `w` has room for both. Adaptive k starts from k, and grows only if neither
// intersecting faces, nor a plane between the bodies, nor containment settles the query. Last: the
// step after which to stop, so that the cost of each can be measured; there is no other use for
// less than 8. screened: the result of an earlier screen of this pair.
template <int Last = 8, class T>
Answer overlap(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Options& o,
               Workspace<T>& w, Screened screened = Screened::unknown) {
  Answer answer;
  answer.counts.spheres = answer.counts.steps = 1;
  const Transform<double> pose = track.at(0);
  const Vec3<double> apart = pose(Vec3<double>(a.centre)) - Vec3<double>(b.centre);
  const double slack = rounding<T> * (length(pose.p) + a.extent + b.extent);
  if (detail::spheres_apart(apart, double(a.radius) + double(b.radius) + slack))
    return answer;  // 1
  const bool screens = o.screens() && screened == Screened::unknown;
  if (screens && detail::screened_apart(a, b, pose, {}, 4 * slack)) return answer;
  const detail::Near<T> near{Transform<T>(pose), Transform<T>(pose.inverse()), slack, screened};
  detail::oppose_once<Last>(a, b, near, o, w, answer);
  Vec3<T> axis(apart);
  answer.hit = answer.hit || detail::holds(a, b, near.to_b, o, answer);
  if (answer.hit || !o.adaptive_k || detail::hulls_apart(a, b, near.to_b, T(4 * slack), axis))
    return answer;
  detail::oppose<Last>(a, b, near, o, w, answer);
  return answer;
}

}  // namespace ofg
