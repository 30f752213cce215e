// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Opposing Face Geometry for bodies: convex, concave in pieces, or undivided meshes.
#pragma once
#include <algorithm>
#include <array>

#include "sweep.hpp"

namespace ofg {
namespace detail {

template <class T>
struct Pair {
  const Mesh<T>&a, &b;
  int piece_a, piece_b;
};

// The piece whose centre is nearest to a point of its frame; the first of equally near ones.
template <class T>
int nearest_piece(const Body<T>& body, const Vec3<T>& p, Counts& counts) {
  int best = 0;
  T least = std::numeric_limits<T>::infinity();
  for (std::size_t i = 0; i < body.pieces.size(); ++i) {
    const Vec3<T> d = body.pieces[i].centre - p;
    ++counts.distances;
    if (dot(d, d) < least) least = dot(d, d), best = int(i);
  }
  return best;
}

// OFG at the object level: the piece of A nearest to the centre of B, then the piece of B nearest
// to that piece, at time t.
template <class T>
Pair<T> opposing_pieces(const Body<T>& a, const Body<T>& b, const Track& track, Counts& counts,
                        double t = 0) {
  const bool many_a = a.pieces.size() > 1, many_b = b.pieces.size() > 1;
  int i = a.pieces.empty() ? -1 : 0, j = b.pieces.empty() ? -1 : 0;
  if (many_a || many_b) {
    const Transform<double> pose = track.at(t);
    if (many_a) i = nearest_piece(a, Vec3<T>(pose.inverse()(Vec3<double>(b.centre))), counts);
    const Mesh<T>& mine = i < 0 ? a.whole : a.pieces[i];
    if (many_b) j = nearest_piece(b, Vec3<T>(pose(Vec3<double>(mine.centre))), counts);
  }
  return {i < 0 ? a.whole : a.pieces[i], j < 0 ? b.whole : b.pieces[j], i, j};
}

// Whether the second answer is preferred: a hit to none, an earlier time to a later one or to none.
inline bool better(const Answer& now, const Answer& one) {
  return one.hit &&
         (!now.hit || one.time < now.time || (now.time != now.time && one.time == one.time));
}

// Every pair of pieces. An overlap stops at the first hit; a sweep continues, for the earliest
// time.
template <class T, class Ask>
Answer all_pieces(const Body<T>& a, const Body<T>& b, bool first_settles, Ask ask) {
  Answer best;
  Counts counts;
  for (int i = a.pieces.empty() ? -1 : 0; i < int(a.pieces.size()); ++i)
    for (int j = b.pieces.empty() ? -1 : 0; j < int(b.pieces.size()); ++j) {
      const Answer one =
          ask(Pair<T>{i < 0 ? a.whole : a.pieces[i], j < 0 ? b.whole : b.pieces[j], i, j});
      counts.add(one.counts);
      if (better(best, one)) best = one, best.piece_a = i, best.piece_b = j;
      if (best.hit && (first_settles || best.time == 0)) {
        best.counts = counts;
        return best;
      }
    }
  best.counts = counts;
  return best;
}

// A repair: the pieces are selected at the start, at the end and where the centres pass closest;
// every selected pair is tested, and the earliest time counts.
template <class T, class Ask>
Answer pieces_over_time(const Body<T>& a, const Body<T>& b, const Track& track, int n, Ask ask) {
  const Vec3<double> ca(a.centre), cb(b.centre), from = track.between(ca, cb, 0),
                                                 step = track.between(ca, cb, 1) - from;
  const double along = dot(step, step),
               nearest = along > 0 ? std::fmin(1.0, std::fmax(0.0, -dot(from, step) / along)) : 0;
  const double times[3] = {0, 1, nearest};
  Answer best;
  Counts counts;
  std::array<std::array<int, 2>, 3> seen;
  for (int i = 0; i < n; ++i) {
    const Pair<T> pair = opposing_pieces(a, b, track, counts, times[i]);
    seen[std::size_t(i)] = {pair.piece_a, pair.piece_b};
    if (std::find(seen.begin(), seen.begin() + i, seen[std::size_t(i)]) != seen.begin() + i)
      continue;
    Answer one = ask(pair);
    counts.add(one.counts);
    if (i == 0 || better(best, one))
      best = one, best.piece_a = pair.piece_a, best.piece_b = pair.piece_b;
  }
  best.counts = counts;
  return best;
}

template <class T, class Ask>
Answer ask_pieces(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o,
                  bool first_settles, Ask ask) {
  if (o.concave == Concave::undivided) return ask(Pair<T>{a.whole, b.whole, -1, -1});
  if (o.concave == Concave::all_pairs) return all_pieces(a, b, first_settles, ask);
  if (o.piece_times > 1 && !first_settles)
    return pieces_over_time(a, b, track, std::min(o.piece_times, 3), ask);
  Counts counts;
  const Pair<T> pair = opposing_pieces(a, b, track, counts);
  Answer answer = ask(pair);
  answer.piece_a = pair.piece_a, answer.piece_b = pair.piece_b;
  answer.counts.add(counts);
  return answer;
}

}  // namespace detail

// Whether the bodies meet at the start of `track`. First reserve `w` for both bodies.
template <class T>
Answer overlap(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o,
               Workspace<T>& w) {
  return detail::ask_pieces(a, b, track, o, true, [&](const detail::Pair<T>& p) {
    return overlap(p.a, p.b, track, o, w);
  });
}

// Whether the bodies meet during the step of `track`.
template <class T>
Answer sweep(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o,
             Workspace<T>& w) {
  return detail::ask_pieces(a, b, track, o, false,
                            [&](const detail::Pair<T>& p) { return sweep(p.a, p.b, track, o, w); });
}

}  // namespace ofg
