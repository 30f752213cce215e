// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Verified overlap of bodies of any kind: convex pieces, or what a closed surface winds about.
#pragma once
#include "verified.hpp"
#include "verified_crossing.hpp"

namespace ofg::verified {

using Hulls = std::vector<Hull>;

struct Solid {
  Hulls pieces;     // convex; none of a closed surface
  Surface surface;  // no faces of a union
  Vec3<double> centre;
  double radius = 0;  // no vertex is farther from the centre
  Tree tree;          // over the pieces

  // A union of convex pieces, none of them flat.
  explicit Solid(Hulls hulls) : pieces(std::move(hulls)) {
    std::vector<Vec3<double>> all;
    for (const auto& piece : pieces)
      all.insert(all.end(), piece.vertices.begin(), piece.vertices.end());
    centre = middle_of(all);
    for (const auto& v : all) radius = std::fmax(radius, length(v - centre));
    radius *= 1 + 8 * unit_roundoff;
    Items items;
    const double unit = radius > 0 ? 1 / radius : 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (const auto& v : pieces[i].vertices) items.points.push_back((v - centre) * unit);
      items.end(int(i));
    }
    tree = Tree(items);
  }

  // What a closed surface winds about. vertices, faces: as Surface takes them, and its exceptions.
  static Solid closed(std::vector<Vec3<double>> vertices, Triangles faces) {
    Solid solid;
    solid.surface = Surface(std::move(vertices), std::move(faces));
    solid.centre = solid.surface.centre, solid.radius = solid.surface.radius;
    return solid;
  }

  bool is_closed() const { return pieces.empty(); }
  bool is_convex() const { return pieces.size() == 1; }

  // Of the tables and trees.
  std::size_t bytes() const {
    std::size_t sum = tree.bytes() + surface.tree.bytes();
    for (const auto& piece : pieces) sum += piece.opposing.bytes();
    return sum;
  }

 private:
  Solid() = default;
};

namespace detail {

// All pairs of items, where numbers left their range and no box is to be trusted.
template <class Meet>
bool meet_in_turn(const std::vector<int>& a, const std::vector<int>& b, const Meet& meet) {
  for (const int i : a)
    for (const int j : b)
      if (meet(i, j)) return true;
  return false;
}

inline std::vector<int> items_of(const Solid& solid) {
  if (solid.is_closed()) return solid.surface.broad;
  std::vector<int> all(solid.pieces.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

template <class Meet>
bool meet_in_pairs(const Solid& a, const Solid& b, const Between& at, Counts& counts,
                   const Meet& meet) {
  if (!at.sure) return meet_in_turn(items_of(a), items_of(b), meet);
  const double unit = 1 / (a.radius + b.radius), size_a = a.radius * unit, size_b = b.radius * unit;
  const Mat3<double> turn_back = at.r.transposed();
  const BoxPose forth(at.r, at.between * unit, size_a, size_b),
      back(turn_back, turn_back * -at.between * unit, size_b, size_a);
  return meet_in_trees(a.is_closed() ? a.surface.tree : a.tree,
                       b.is_closed() ? b.surface.tree : b.tree, forth, back, counts.evaluated,
                       meet);
}

inline Answer unions(const Solid& a, const Solid& b, const Between& at, const Pose& pa,
                     const Pose& pb, const Parts& parts) {
  Answer all;
  const auto meet = [&](int i, int j) {
    Answer one =
        overlap(a.pieces[std::size_t(i)], b.pieces[std::size_t(j)], pa, pb, nullptr, parts);
    one.counts.add(all.counts);
    all = one;
    if (all.hit) all.piece_a = i, all.piece_b = j;
    return all.hit;
  };
  Counts counts;
  meet_in_pairs(a, b, at, counts, meet);
  all.counts.add(counts);
  return all;
}

inline Answer surfaces(const Solid& a, const Solid& b, const Between& at, const Pose& pa,
                       const Pose& pb, const Parts& parts) {
  Answer answer;
  Sides sides(pa, pb, at, parts.doubles);
  Crossing crossing(a.surface, b.surface, at, sides);
  const auto meet = [&](int i, int j) {
    ++answer.counts.face_pairs;
    if (!crossing.faces(i, j)) return false;
    answer.hit = true, answer.found = Found::start, answer.face_a = i, answer.face_b = j;
    return true;
  };
  if (!meet_in_pairs(a, b, at, answer.counts, meet) && crossing.contained(answer.counts.evaluated))
    answer.hit = true, answer.found = Found::inside;
  answer.counts.steps = 1 + (sides.exact > 0);
  return answer;
}

// Does a hull's interior hold a point of a triangle? The differences of points of the two are a
// solid as those of two hulls are, so that the same search answers; a triangle has no tables.
inline bool holds_part_of(const Hull& hull, const Hull& triangle, const Pose& ph, const Pose& pt,
                          const Parts& parts, Counts& counts) {
  const Posed at(hull, triangle, ph, pt);
  if (at.sure &&
      length(at.between) > (hull.radius + triangle.radius) * at.unit + at.slack + at.away)
    return false;
  Proof proof;
  if (at.sure && parts.doubles && hull.inner > 0)
    for (int i = 0; i < most_starts && proof.verdict == Verdict::unsure; ++i)
      Search{hull, triangle, at, counts, proof}.run(i);
  if (proof.verdict != Verdict::unsure) return proof.verdict == Verdict::meeting;
  Vec3<double> axis;
  return meets_exactly(hull, triangle, ph, pt, Portal(), axis);
}

// A closed surface and a union: a face has a point inside a piece, or a piece is inside as a whole.
inline Answer mixed(const Solid& a, const Solid& b, const Between& at, const Pose& pa,
                    const Pose& pb, const Parts& parts) {
  Answer answer;
  answer.counts.steps = 1;
  const auto meet = [&](int face, int piece) {
    ++answer.counts.face_pairs;
    const Surface& s = a.surface;
    const Hull triangle(
        {s.vertices[s.index(face, 0)], s.vertices[s.index(face, 1)], s.vertices[s.index(face, 2)]},
        {});
    if (!holds_part_of(b.pieces[std::size_t(piece)], triangle, pb, pa, parts, answer.counts))
      return false;
    answer.hit = true, answer.found = Found::start, answer.face_a = face, answer.piece_b = piece;
    return true;
  };
  Sides sides(pa, pb, at, parts.doubles);
  if (meet_in_pairs(a, b, at, answer.counts, meet)) return answer;
  const Surface none;
  Crossing crossing(a.surface, none, at, sides);
  for (std::size_t i = 0; i < b.pieces.size() && !answer.hit; ++i) {
    // The centre of its tetrahedron is interior, and on no face that it holds no point of.
    const Hull& hull = b.pieces[i];
    Vec3<double> corner[4];
    Point inside{{}, corner, 4, true, true};
    for (std::size_t k = 0; k < 4; ++k) {
      corner[k] = hull.vertices[std::size_t(hull.corners[k])];
      inside.at = inside.at + (corner[k] - b.centre) * 0.25;
    }
    if (crossing.winding(inside, a.surface, false, answer.counts.evaluated) != 0)
      answer.hit = true, answer.found = Found::inside, answer.piece_b = int(i);
  }
  answer.counts.steps = 1 + (sides.exact > 0);
  return answer;
}

inline Answer exchanged(Answer answer) {
  std::swap(answer.face_a, answer.face_b), std::swap(answer.piece_a, answer.piece_b);
  return answer;
}

}  // namespace detail

// Do the interiors of two solids meet? Touching is no meeting, but of surfaces that touch either
// may be said: there B is moved by less than any number. Every pair of pieces or faces is excluded
// by bounds or asked, the deepest first, until one meets.
//
// hit: `found` is start, with the pieces that meet, or the faces that cross; or inside, where one
// is in the other. counts, besides those of hulls: evaluated, pairs of boxes; face_pairs, of faces;
// steps, pairs of pieces, or 1 of surfaces, and 1 more where it took exact arithmetic. cache: of
// this pair, used where both are convex.
inline Answer overlap(const Solid& a, const Solid& b, const Pose& pa, const Pose& pb,
                      Cache* cache = nullptr, const Parts& parts = {}) {
  if (a.is_convex() && b.is_convex()) {
    Answer answer = overlap(a.pieces[0], b.pieces[0], pa, pb, cache, parts);
    answer.piece_a = answer.piece_b = 0;
    return answer;
  }
  const Between at(a.centre, a.radius, b.centre, b.radius, pa, pb);
  Answer apart;
  apart.counts.spheres = apart.counts.steps = 1;
  if (at.sure && length(at.between) > a.radius + b.radius + at.slack) return apart;
  if (a.is_closed() && b.is_closed()) return detail::surfaces(a, b, at, pa, pb, parts);
  if (!a.is_closed() && !b.is_closed()) return detail::unions(a, b, at, pa, pb, parts);
  if (a.is_closed()) return detail::mixed(a, b, at, pa, pb, parts);
  const Between exchanged(b.centre, b.radius, a.centre, a.radius, pb, pa);
  return detail::exchanged(detail::mixed(b, a, exchanged, pb, pa, parts));
}

}  // namespace ofg::verified
