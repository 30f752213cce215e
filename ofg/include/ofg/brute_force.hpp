// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The reference that OFG must equal if k is at least the number of faces: every face against every
// face and, in a sweep, every vertex's virtual edge against every face. Plain loops without
// selection; only bounding boxes of faces reject pairs.
#pragma once
#include "ofg.hpp"

namespace ofg::brute_force {
namespace detail {

template <class T>
struct Box {
  Vec3<T> lo, hi;
  explicit Box(const Triangle<T>& t)
      : lo{std::fmin(t.a.x, std::fmin(t.b.x, t.c.x)), std::fmin(t.a.y, std::fmin(t.b.y, t.c.y)),
           std::fmin(t.a.z, std::fmin(t.b.z, t.c.z))},
        hi{std::fmax(t.a.x, std::fmax(t.b.x, t.c.x)), std::fmax(t.a.y, std::fmax(t.b.y, t.c.y)),
           std::fmax(t.a.z, std::fmax(t.b.z, t.c.z))} {}
  bool apart(const Box& b, T slack) const {
    return lo.x > b.hi.x + slack || b.lo.x > hi.x + slack || lo.y > b.hi.y + slack ||
           b.lo.y > hi.y + slack || lo.z > b.hi.z + slack || b.lo.z > hi.z + slack;
  }
};

template <class T>
bool surfaces_meet(const Mesh<T>& a, const Mesh<T>& b, const Transform<T>& to_b, T scale,
                   Answer& answer) {
  const T unit = unit_for(scale);
  const Transform<T> pose = to_b.in_units(unit);
  scale *= unit;
  for (int i = 0; i < a.size(); ++i) {
    const Triangle<T> t = a.triangle(i), s{pose(t.a), pose(t.b), pose(t.c)};
    const Box<T> box(s);
    for (int j = 0; j < b.size(); ++j) {
      const Triangle<T> other = in_units(b.triangle(j), unit);
      ++answer.counts.face_pairs;
      if (box.apart(Box<T>(other), 2 * rounding<T> * scale)) continue;
      ++answer.counts.full_tests;
      if (!triangles_meet(s, other, scale)) continue;
      answer.face_a = i, answer.face_b = j;
      return true;
    }
  }
  return false;
}

}  // namespace detail

// Whether the surfaces of two whole bodies meet at the start of `track`.
template <class T>
Answer overlap(const Body<T>& a, const Body<T>& b, const Track& track) {
  Answer answer;
  answer.counts.steps = 1;
  const Transform<T> to_b(track.at(0));
  answer.hit = detail::surfaces_meet(a.whole, b.whole, to_b,
                                     ofg::detail::scale_of(a.whole, b.whole, to_b.p), answer);
  if (answer.hit) answer.found = Found::start;
  return answer;
}

// Whether any of A's virtual edges meets a face of B, or the surfaces meet at either end. Time:
// that of the earliest virtual edge.
template <class T>
Answer sweep(const Body<T>& a, const Body<T>& b, const Track& track) {
  Answer answer;
  answer.counts.steps = 1;
  const Mesh<T>&ma = a.whole, &mb = b.whole;
  const ofg::detail::Window<T> window{0, 1, track.at(0), track.at(1)};
  const Transform<T> start(window.start), end(window.end);
  const T scale = ofg::detail::scale_of(ma, mb, track, window);
  const T unit = unit_for(scale);
  const Transform<T> from = start.in_units(unit), to = end.in_units(unit);
  ofg::detail::Contact contact;
  for (int i = 0; i < ma.vertices.size(); ++i)
    for (int j = 0; j < mb.size(); ++j) {
      ++answer.counts.edge_faces;
      const Triangle<T> face = in_units(mb.triangle(j), unit);
      const T share = segment_meets(from(ma.vertices[i]), to(ma.vertices[i]), face, scale * unit);
      if (share >= 0 && share < contact.share)
        contact = {Found::edge_face, double(share), i, j, -1, j};
    }
  if (contact.found != Found::nothing) {
    answer.hit = true, answer.found = contact.found, answer.face_b = contact.face_b;
    answer.time = ofg::detail::velocity_time(ma, mb, track, window, contact);
    return answer;
  }
  for (const auto* pose : {&start, &end}) {
    answer.hit = detail::surfaces_meet(ma, mb, *pose, scale, answer);
    if (answer.hit) answer.found = pose == &start ? Found::start : Found::end;
    if (answer.hit) break;
  }
  return answer;
}

}  // namespace ofg::brute_force
