// Opposing Face Geometry for bodies: convex, concave in pieces, or undivided meshes.
#pragma once
#include "sweep.hpp"

namespace ofg {
namespace detail {

template <class T>
struct Pair {
  const Mesh<T>&a, &b;
  int piece_a, piece_b;
};

// The piece whose centre is nearest to a point of its frame; the first of equals.
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

// OFG at the object level: the piece of A nearest to the centre of B, then the piece of B nearest to that piece.
template <class T>
Pair<T> opposing_pieces(const Body<T>& a, const Body<T>& b, const Track& track, Counts& counts) {
  const bool many_a = a.pieces.size() > 1, many_b = b.pieces.size() > 1;
  int i = a.pieces.empty() ? -1 : 0, j = b.pieces.empty() ? -1 : 0;
  if (many_a || many_b) {
    const Transform<double> pose = track.at(0);
    if (many_a) i = nearest_piece(a, Vec3<T>(pose.inverse()(Vec3<double>(b.centre))), counts);
    const Mesh<T>& mine = i < 0 ? a.whole : a.pieces[i];
    if (many_b) j = nearest_piece(b, Vec3<T>(pose(Vec3<double>(mine.centre))), counts);
  }
  return {i < 0 ? a.whole : a.pieces[i], j < 0 ? b.whole : b.pieces[j], i, j};
}

// Every pair of pieces. An overlap stops at the first hit; a sweep goes on, for the earliest time.
template <class T, class Ask>
Answer all_pieces(const Body<T>& a, const Body<T>& b, bool first_settles, Ask ask) {
  Answer best;
  Counts counts;
  for (int i = a.pieces.empty() ? -1 : 0; i < int(a.pieces.size()); ++i)
    for (int j = b.pieces.empty() ? -1 : 0; j < int(b.pieces.size()); ++j) {
      const Answer one = ask(Pair<T>{i < 0 ? a.whole : a.pieces[i], j < 0 ? b.whole : b.pieces[j], i, j});
      counts.add(one.counts);
      const bool better = one.hit && (!best.hit || one.time < best.time || (best.time != best.time && one.time == one.time));
      if (better) best = one, best.piece_a = i, best.piece_b = j;
      if (best.hit && (first_settles || best.time == 0)) {
        best.counts = counts;
        return best;
      }
    }
  best.counts = counts;
  return best;
}

template <class T, class Ask>
Answer ask_pieces(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o, bool first_settles, Ask ask) {
  if (o.concave == Concave::undivided) return ask(Pair<T>{a.whole, b.whole, -1, -1});
  if (o.concave == Concave::all_pairs) return all_pieces(a, b, first_settles, ask);
  Counts counts;
  const Pair<T> pair = opposing_pieces(a, b, track, counts);
  Answer answer = ask(pair);
  answer.piece_a = pair.piece_a, answer.piece_b = pair.piece_b;
  answer.counts.add(counts);
  return answer;
}

}  // namespace detail

// Do the bodies meet at the start of `track`? Reserve `w` for both bodies first.
template <class T>
Answer overlap(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o, Workspace<T>& w) {
  return detail::ask_pieces(a, b, track, o, true, [&](const detail::Pair<T>& p) { return overlap(p.a, p.b, track, o, w); });
}

// Do the bodies meet during the step of `track`?
template <class T>
Answer sweep(const Body<T>& a, const Body<T>& b, const Track& track, const Options& o, Workspace<T>& w) {
  return detail::ask_pieces(a, b, track, o, false, [&](const detail::Pair<T>& p) { return sweep(p.a, p.b, track, o, w); });
}

}  // namespace ofg
