// Many poses of one pair of bodies in one call.
#pragma once
#include "ofg.hpp"

namespace ofg {
namespace detail {

// Screens up to most_posed pairs at once: by portals, as many as a register has lanes (simd/portal_body.hpp).
template <class T>
void screen(const Mesh<T>& a, const Mesh<T>& b, const Pose* pa, const Pose* pb, int n, Screened* out) {
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
  const int padded = (n + lanes<float> - 1) / lanes<float> * lanes<float>;
  kernels<T>.pose_pairs(bodies, reinterpret_cast<const double*>(pa), reinterpret_cast<const double*>(pb), n, padded, pairs);
  kernels<T>.portal(a.supports.view(), b.supports.view(), pairs, padded, reinterpret_cast<unsigned char*>(out));
}

// The one pair of meshes that is asked of two bodies whatever their pose; none of bodies in several pieces.
template <class T>
const Mesh<T>* only_mesh(const Body<T>& body, const Options& o) {
  if (o.concave == Concave::undivided || body.pieces.empty()) return &body.whole;
  return body.pieces.size() == 1 ? &body.pieces[0] : nullptr;
}

}  // namespace detail

// What `overlap` answers at each of n pairs of poses. Reserve `w` for both bodies first.
template <class T>
void overlap_many(const Body<T>& a, const Body<T>& b, const Pose* pa, const Pose* pb, std::size_t n, const Options& o,
                  Workspace<T>& w, Answer* answers) {
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
      answers[i].piece_a = named && ma != &a.whole ? 0 : -1, answers[i].piece_b = named && mb != &b.whole ? 0 : -1;
    }
  }
}

}  // namespace ofg
