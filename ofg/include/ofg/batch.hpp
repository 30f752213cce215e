// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Many poses of one pair of bodies in one call.
#pragma once
#include "ofg.hpp"

namespace ofg {
namespace detail {

// The first n pairs, and unused ones to fill a register.
inline int fill_up(PosedPairs& pairs, int n) {
  const int padded = (n + lanes<float> - 1) / lanes<float> * lanes<float>;
  for (int i = n; i < padded; ++i) {
    for (auto& row : pairs.r) row[i] = 0;
    for (auto& row : pairs.between) row[i] = 0;
    pairs.size_b[i] = 0, pairs.gap[i] = -1;
  }
  return padded;
}

inline void move_pair(PosedPairs& pairs, int from, int to) {
  for (auto& row : pairs.r) row[to] = row[from];
  for (auto& row : pairs.between) row[to] = row[from];
  pairs.size_b[to] = pairs.size_b[from], pairs.gap[to] = pairs.gap[from];
}

// Screens up to most_posed pairs at once: a few axes for all, then portals for the remaining pairs,
// compacted.
template <class T>
void screen(const Mesh<T>& a, const Mesh<T>& b, const Pose* pa, const Pose* pb, int n,
            Screened* out) {
  static_assert(sizeof(Pose) == 7 * sizeof(double) && sizeof(Screened) == 1);
  const auto &ca = a.centre, &cb = b.centre;
  const PairOfBodies bodies{{double(ca.x), double(ca.y), double(ca.z)},
                            {double(cb.x), double(cb.y), double(cb.z)},
                            double(a.radius),
                            double(b.radius),
                            screen_rounding,
                            4 * rounding<T>,
                            double(a.extent) + double(b.extent)};
  PosedPairs pairs;
  const SupportView map_a = a.supports().view(), map_b = b.supports().view();
  unsigned char verdict[most_posed];
  int rest[most_posed], left = 0;
  kernels<T>.pose_pairs(bodies, reinterpret_cast<const double*>(pa),
                        reinterpret_cast<const double*>(pb), n, pairs);
  if (first_axes(a, b) > 0)
    kernels<T>.reflect(map_a, map_b, pairs, fill_up(pairs, n), first_axes(a, b), verdict);
  for (int i = 0; i < n; ++i) {
    out[i] = first_axes(a, b) > 0 ? Screened(verdict[i]) : Screened::unknown;
    if (out[i] == Screened::apart) continue;
    move_pair(pairs, i, left);
    rest[left++] = i;
  }
  kernels<T>.portal(map_a, map_b, pairs, fill_up(pairs, left), verdict);
  for (int i = 0; i < left; ++i) out[rest[i]] = Screened(verdict[i]);
}

// The one pair of meshes that is tested for two bodies at every pose; none if a body has several
// pieces.
template <class T>
const Mesh<T>* only_mesh(const Body<T>& body, const Options& o) {
  if (o.concave == Concave::undivided || body.pieces.empty()) return &body.whole;
  return body.pieces.size() == 1 ? &body.pieces[0] : nullptr;
}

}  // namespace detail

// The answers of `overlap` at each of n pairs of poses. First reserve `w` for both bodies.
template <class T>
void overlap_many(const Body<T>& a, const Body<T>& b, const Pose* pa, const Pose* pb, std::size_t n,
                  const Options& o, Workspace<T>& w, Answer* answers) {
  const Mesh<T>*ma = detail::only_mesh(a, o), *mb = detail::only_mesh(b, o);
  const bool screens = o.screen && ma && mb;
  Screened screened[most_posed] = {};
  for (std::size_t from = 0; from < n; from += most_posed) {
    const int here = int(std::min<std::size_t>(n - from, most_posed));
    if (screens) detail::screen(*ma, *mb, pa + from, pb + from, here, screened);
    for (std::size_t i = from; i < from + std::size_t(here); ++i) {
      if (!screens) {
        answers[i] = overlap(a, b, {pa[i], pb[i]}, o, w);
        continue;
      }
      const Screened known = screened[i - from];
      answers[i] = Answer();
      answers[i].counts.spheres = answers[i].counts.steps = 1;
      if (known != Screened::apart) answers[i] = overlap(*ma, *mb, {pa[i], pb[i]}, o, w, known);
      const bool named = o.concave != Concave::all_pairs || answers[i].hit;  // as there
      answers[i].piece_a = named && ma != &a.whole ? 0 : -1,
      answers[i].piece_b = named && mb != &b.whole ? 0 : -1;
    }
  }
}

}  // namespace ofg
