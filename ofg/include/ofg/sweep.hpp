// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// OFG over one step: whether two moving meshes meet, and when. Translational and rotational sweep
// are one algorithm, on the motion of A relative to B; its virtual edges are exact for translations
// and chords of the true paths for rotations.
#pragma once
#include "features.hpp"
#include "stray.hpp"

namespace ofg {
namespace detail {

// Step 1 over a window: spheres swept along the chord between the centres, enlarged by the
// deviation of the true path from it.
template <class T>
bool swept_spheres_apart(const Mesh<T>& a, const Mesh<T>& b, const Track& track, double t0,
                         double t1, double slack) {
  const Vec3<double> ca(a.centre), cb(b.centre);
  const Vec3<double> from = track.between(ca, cb, t0), step = track.between(ca, cb, t1) - from;
  const double along = dot(step, step);
  const double at = along > 0 ? std::fmin(1.0, std::fmax(0.0, -dot(from, step) / along)) : 0.0;
  const double stray =
      track.a.stray(track.a.lever(ca), t1 - t0) + track.b.stray(track.b.lever(cb), t1 - t0);
  return spheres_apart(from + step * at, double(a.radius) + double(b.radius) + stray + slack);
}

template <class T>
bool surfaces_meet(const Mesh<T>& a, const Transform<double>& pose, Workspace<T>& w, T scale,
                   Answer& answer) {
  const Transform<T> to_b(pose);
  const T unit = unit_for(scale);
  gather(a, w.a);
  move(to_b.in_units(unit), w.a);
  return faces_meet(w.a, w.b, scale * unit, (to_b(w.a.centre) - w.b.centre) * unit,
                    Screened::unknown, w, answer);
}

// One plane between B's selection and A's at both ends excludes all chords: none of the tests of
// the window can hit.
template <class T>
bool chords_apart(const Mesh<T>& a, const Window<T>& window, T gap, T unit, Workspace<T>& w) {
  for (int i = 0; i < 2; ++i) {
    gather(a, w.a, i);
    move(Transform<T>(i ? window.end : window.start).in_units(unit), w.a, i);
  }
  Vec3<T> axis = w.a.triangle(0).a - w.b.triangle(0).a;
  const CloudView<T> cloud_a = w.a.cloud(2), cloud_b = w.b.cloud();
  return separated(axis, gap * unit,
                   [&](const Vec3<T>& v) { return support(cloud_a, cloud_b, v); });
}

// Halves the window, testing the first half each time, with all tests of the sweep.
template <class T>
double bisection_time(const Mesh<T>& a, const Mesh<T>& b, const Track& track,
                      const Window<T>& window, const Options& o, T scale, Workspace<T>& w,
                      Counts& counts) {
  double lo = window.t0, hi = window.t1;
  Transform<double> start = window.start;
  for (int i = 0; i < o.iterations; ++i) {
    const double mid = (lo + hi) / 2;
    const Transform<double> middle = track.at(mid);
    ++counts.steps;
    Contact ignored;
    Answer there;
    const bool hit = features_meet(a, b, start, middle, o, scale, w, ignored, there.counts) ||
                     surfaces_meet(a, middle, w, scale, there);
    counts.add(there.counts);
    if (hit) {
      hi = mid;
    } else {
      lo = mid, start = middle;
    }
  }
  return hi;
}

// The article's second way: move half of the window and test the faces there; if none meet, move
// half of the remainder, and so on. NaN if none of the moves meets.
template <class T>
double halving_time(const Mesh<T>& a, const Track& track, const Window<T>& window, const Options& o,
                    T scale, Workspace<T>& w, Counts& counts) {
  double t = window.t0;
  for (int i = 0; i < o.iterations; ++i) {
    t += (window.t1 - t) / 2;
    ++counts.steps;
    Answer there;
    const bool hit = surfaces_meet(a, track.at(t), w, scale, there);
    counts.add(there.counts);
    if (hit) return t;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// The time of a hit between the ends, by the chosen method.
template <class T>
double time_of_impact(const Mesh<T>& a, const Mesh<T>& b, const Track& track,
                      const Window<T>& window, const Contact& contact, const Options& o, T scale,
                      Workspace<T>& w, Counts& counts) {
  if (o.toi == Toi::velocity) return velocity_time(a, b, track, window, contact);
  if (o.toi == Toi::bisection) return bisection_time(a, b, track, window, o, scale, w, counts);
  if (o.toi == Toi::halving) return halving_time(a, track, window, o, scale, w, counts);
  return std::numeric_limits<double>::quiet_NaN();
}

// Selections for a window: at its start, or also at its end, or also where the centres pass
// closest.
template <class T>
void select_for(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Window<T>& window,
                const Options& o, Workspace<T>& w, Counts& counts) {
  double times[3] = {window.t0, window.t1, window.t1};
  const int n = o.selection_times < 3 ? o.selection_times : 3;
  double gap = n == 1 ? window.t1 - window.t0
                      : (window.t1 - window.t0) / 2;  // farthest any time is from one of `times`
  const Vec3<double> ca(a.centre), cb(b.centre);
  if (n == 3) {
    const Vec3<double> from = track.between(ca, cb, window.t0),
                       step = track.between(ca, cb, window.t1) - from;
    const double along = dot(step, step), share = along > 0 ? -dot(from, step) / along : 0;
    times[1] = window.at(std::fmin(1.0, std::fmax(0.0, share)));
    gap = std::fmax(times[1] - window.t0, window.t1 - times[1]) / 2;
  }
  Transform<double> pose[3];
  Vec3<T> point[3];
  for (int i = 0; i < n; ++i) {
    pose[i] = times[i] == window.t0   ? window.start
              : times[i] == window.t1 ? window.end
                                      : track.at(times[i]);
    point[i] = Transform<T>(pose[i].inverse())(b.centre);
  }
  T reach_a = b.radius, reach_b = 0;
  double far = 0;
  if (o.adaptive_k) {
    far = length(track.pivots(window.t0)) + track.slide() * (window.t1 - window.t0);
    reach_a += T(gap * track.speed(0, track.b.lever(cb), far));
  }
  select(a, point, n, o, reach_a, w, w.a, counts);
  if (o.adaptive_k)
    reach_b = w.a.radius + T(gap * track.speed(track.a.lever(Vec3<double>(w.a.centre)), 0, far));
  for (int i = 0; i < n; ++i) point[i] = Transform<T>(pose[i])(w.a.centre);
  select(b, point, n, o, reach_b, w, w.b, counts);
}

// One plane between the hulls of the whole meshes, with a margin for the deviation: the bodies are
// apart throughout the window, on their true paths.
template <class T>
bool hulls_apart(const Mesh<T>& a, const Mesh<T>& b, const Window<T>& window, T gap,
                 Vec3<T>& axis) {
  const Transform<T> start(window.start), end(window.end);
  const T unit = unit_for(std::fmax(scale_of(a, b, start.p), scale_of(a, b, end.p)));
  const Mat3<T> back = start.r.transposed(), back_end = end.r.transposed();
  const CloudView<T> hull_a = a.cloud.view(), hull_b = b.cloud.view();
  static constexpr T zeros[lanes<T>] = {};
  const CloudView<T> origin{zeros, zeros, zeros, lanes<T>};
  const auto least = [&](const Vec3<T>& v) {
    const Vec3<T> p = start(support(hull_a, origin, back * v)),
                  q = end(support(hull_a, origin, back_end * v));
    return ((dot(v, p) < dot(v, q) ? p : q) + support(origin, hull_b, v)) * unit;
  };
  return separated(axis, gap * unit, least, 16);
}

// The virtual edges and the end of one window, with its own selections; also the start if nothing
// was tested before it.
template <class T>
bool sweep_window(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Window<T>& window,
                  bool first, const Options& o, Workspace<T>& w, Answer& answer) {
  Counts& counts = answer.counts;
  const T scale = scale_of(a, b, track, window);
  const T unit = unit_for(scale);
  select_for(a, b, track, window, o, w, counts);
  measure_in(unit, w.b);
  list_vertices(a, w, w.a);
  if (o.both_vertices) list_vertices(b, w, w.b);
  if (o.edge_edge) list_edges(a, w, w.a), list_edges(b, w, w.b);
  // Where a chord of B's vertex meets a face of A, the two are no farther apart at that time than
  // the sum of both deviations.
  const double h = window.t1 - window.t0;
  const T room = 4 * rounding<T> * scale +
                 (o.both_vertices ? T(stray(a, track, h) + stray_of_b(a, b, track, h)) : T(0));
  if (chords_apart(a, window, room, unit, w)) {
    counts.face_pairs += std::int64_t(1 + first) * w.a.size() * w.b.size();
    counts.edge_faces += std::int64_t(w.a.vertices.size()) * w.b.size();
    if (o.both_vertices) counts.edge_faces += std::int64_t(w.b.vertices.size()) * w.a.size();
    if (o.edge_edge) counts.edge_pairs += std::int64_t(w.a.edges.size() * w.b.edges.size());
    return false;
  }
  const auto at_start = [&] {
    if (!first || !surfaces_meet(a, window.start, w, scale, answer)) return false;
    return answer.found = Found::start, answer.time = window.t0, true;
  };
  const auto at_end = [&] {
    if (!surfaces_meet(a, window.end, w, scale, answer)) return false;
    answer.found = window.t1 < 1 ? Found::within : Found::end;
    answer.time =
        o.end_moment ? bisection_time(a, b, track, window, o, scale, w, counts) : window.t1;
    return true;
  };
  const auto in_between = [&] {
    Contact contact;
    if (!features_meet(a, b, window.start, window.end, o, scale, w, contact, counts)) return false;
    answer.found = contact.found, answer.face_a = contact.face_a, answer.face_b = contact.face_b;
    answer.time = time_of_impact(a, b, track, window, contact, o, scale, w, counts);
    return true;
  };
  if (o.earliest) return at_start() || in_between() || at_end();
  if (o.order == Order::steps) return in_between() || at_start() || at_end();
  return at_start() || at_end() || in_between();
}

// Whether a body contains a point of the other at one pose. If so, the faces that meet there are
// reported, if any of the k nearest do: `crossing`.
template <class T>
bool overlaps_at(const Mesh<T>& a, const Mesh<T>& b, const Transform<double>& pose, Found crossing,
                 double slack, const Options& o, Workspace<T>& w, Answer& answer) {
  const Near<T> near{Transform<T>(pose), Transform<T>(pose.inverse()), slack, Screened::unknown};
  if (!holds(a, b, near.to_b, o, answer)) return false;
  Answer faces;
  oppose_once<8>(a, b, near, o, w, faces);
  answer.counts.add(faces.counts);
  if (faces.hit)
    answer.found = crossing, answer.face_a = faces.face_a, answer.face_b = faces.face_b;
  return true;
}

// State of a sweep across its windows.
template <class T>
struct Sweep {
  const Mesh<T>&a, &b;
  const Track& track;
  const Options& o;
  Workspace<T>& w;
  Answer& answer;
  double tolerance;  // maximum deviation of a chord; infinite if arcs are not divided
  Vec3<T> axis;

  double slack(const Window<T>& x) const {
    return rounding<T> *
           (2 * (double(a.extent) + b.extent + track.arms()) + length(x.start.p) + length(x.end.p));
  }

  // Windows in the order of time, halved until their chords are accurate enough, or the bodies
  // surely apart. No deeper than 24: a hundred full rotations at a tolerance of 1e-6 need 19.
  bool meet(const Window<T>& x, bool first, int depth) {
    ++answer.counts.steps;
    if (depth > 0) {
      ++answer.counts.spheres;
      if (swept_spheres_apart(a, b, track, x.t0, x.t1, slack(x))) return false;
    }
    const double away =
        tolerance < std::numeric_limits<double>::infinity() ? stray(a, track, x.t1 - x.t0) : 0;
    const bool proof = away > 0 || (o.adaptive_k && !track.turns());
    if (proof && away < a.radius && hulls_apart(a, b, x, T(away + slack(x)), axis)) return false;
    const double astray =
        away > 0 && o.both_vertices ? std::fmax(away, stray_of_b(a, b, track, x.t1 - x.t0)) : away;
    if (!(astray > tolerance) || depth == 24)
      return sweep_window(a, b, track, x, first, o, w, answer);
    const double middle = (x.t0 + x.t1) / 2;
    const Transform<double> pose = track.at(middle);
    return meet({x.t0, middle, x.start, pose}, first, depth + 1) ||
           meet({middle, x.t1, pose, x.end}, false, depth + 1);
  }
};

}  // namespace detail

// As `overlap`, over the step t in [0, 1] of `track`.
template <class T>
Answer sweep(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Options& o,
             Workspace<T>& w) {
  Answer answer;
  const auto slack = [&](const Transform<double>& pose) {
    return rounding<T> * (length(pose.p) + a.extent + b.extent + track.arms());
  };
  detail::Window<T> window{0, 1, track.at(0), track.at(1)};
  ++answer.counts.spheres;
  const Vec3<double> ca(a.centre), cb(b.centre);
  const bool rejected =
      o.broad == Broad::start
          ? detail::spheres_apart(track.between(ca, cb, 0),
                                  double(a.radius) + double(b.radius) + slack(window.start))
          : detail::swept_spheres_apart(a, b, track, 0, 1, slack(window.start) + slack(window.end));
  if (rejected) return answer;
  const double room = 4 * (slack(window.start) + slack(window.end));
  const bool screens = o.screens() && !track.turns();
  if (screens && detail::screened_apart(a, b, window.start, window.end.p - window.start.p, room))
    return answer;
  if (detail::overlaps_at(a, b, window.start, Found::start, slack(window.start), o, w, answer)) {
    answer.hit = true, answer.time = 0;
    return answer;
  }
  const double tolerance =
      o.arc_tolerance > 0 ? o.arc_tolerance * a.radius : std::numeric_limits<double>::infinity();
  detail::Sweep<T> parts{a, b, track, o, w, answer, tolerance, Vec3<T>(window.start(ca) - cb)};
  answer.hit = parts.meet(window, true, 0);
  if (!answer.hit &&
      detail::overlaps_at(a, b, window.end, Found::end, slack(window.end), o, w, answer)) {
    answer.hit = true, answer.time = 1;
  }
  return answer;
}

}  // namespace ofg
