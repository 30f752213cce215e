// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Verified overlap of one pair of hulls at many poses.
#pragma once
#include "batch.hpp"
#include "verified.hpp"

namespace ofg::verified {
namespace detail {

// Settles what it can of up to most_posed pairs of poses in single precision, one a lane; false in
// `settled` where that proves nothing.
inline void prove_many(const Hull& a, const Hull& b, const Pose* pa, const Pose* pb, int n,
                       bool* settled, Answer* answers) {
  const double sum = a.radius + b.radius, inner = (a.inner + b.inner) / sum,
               slack = 256 * unit_roundoff;
  // The gap counts slack (extents + |shift|): the lengths of Posed, and what `away` is there.
  const double extents = sum + length(a.centre) + length(b.centre);
  const PairOfBodies bodies{{a.centre.x, a.centre.y, a.centre.z},
                            {b.centre.x, b.centre.y, b.centre.z},
                            a.radius,
                            b.radius,
                            ofg::detail::screen_rounding,
                            slack,
                            extents + (a.off_centre + b.off_centre) / slack};
  PosedPairs pairs;
  kernels<double>.pose_pairs(bodies, reinterpret_cast<const double*>(pa),
                             reinterpret_cast<const double*>(pb), n, pairs);
  int rest[most_posed], left = 0;
  const auto keep = [&](int i, int pair) {
    ofg::detail::move_pair(pairs, i, left);
    rest[left++] = pair;
  };
  for (int i = 0; i < n; ++i) {
    answers[i] = Answer();
    answers[i].counts.spheres = answers[i].counts.steps = 1;
    const Vec3<double> between(pairs.between[0][i], pairs.between[1][i], pairs.between[2][i]);
    const double apart = length(between), gap = pairs.gap[i];
    settled[i] = true;
    if (apart > 1 + gap) continue;
    if (apart + gap < inner) {
      answers[i].hit = true, answers[i].found = Found::inside;
      continue;
    }
    settled[i] = false;
    if (gap < 1) keep(i, i);  // else nothing is proved, nor with what is no number
  }
  // Of larger bodies most that are apart at all are so along one of a few axes: then the portals,
  // closed up, wait for fewer of one another.
  const SupportView map_a = a.supports.view(), map_b = b.supports.view();
  if (a.size() > list_unit && b.size() > list_unit) {
    unsigned char verdict[most_posed];
    const int asked = left;
    kernels<double>.reflect(map_a, map_b, pairs, ofg::detail::fill_up(pairs, left), 3, verdict);
    left = 0;
    for (int i = 0; i < asked; ++i) {
      answers[rest[i]].counts.full_tests = 3;
      settled[rest[i]] = verdict[i] == 1;
      if (verdict[i] != 1) keep(i, rest[i]);
    }
  }
  const Vec3<double> beside = verified::detail::beside(a, b, 0) * (1 / sum);
  const float inside[3] = {float(beside.x), float(beside.y), float(beside.z)};
  Proved proved;
  kernels<double>.prove(map_a, map_b, pairs, ofg::detail::fill_up(pairs, left), inside, proved);
  for (int i = 0; i < left; ++i) {
    Answer& answer = answers[rest[i]];
    answer.counts.full_tests += proved.supports[i];
    if (proved.verdict[i] == 0) continue;
    settled[rest[i]] = true;
    if (proved.verdict[i] == 1) continue;
    ++answer.counts.face_pairs;
    const Vec3<float> axis(proved.axis[0][i], proved.axis[1][i], proved.axis[2][i]);
    // Rows of r carry the radius of A, which changes no direction.
    const auto column = [&](int j) {
      return Vec3<float>(pairs.r[j][i], pairs.r[3 + j][i], pairs.r[6 + j][i]);
    };
    const Vec3<float> turned(dot(column(0), axis), dot(column(1), axis), dot(column(2), axis));
    answer.hit = true, answer.found = Found::start;
    answer.face_a = a.opposing.face(Vec3<double>(turned));
    answer.face_b = b.opposing.face(-Vec3<double>(axis));
  }
}

}  // namespace detail

// What `overlap` answers at each of n pairs of poses: equal hits, sooner; faces may differ.
inline void overlap_many(const Hull& a, const Hull& b, const Pose* pa, const Pose* pb,
                         std::size_t n, Answer* answers) {
  static_assert(sizeof(Pose) == 7 * sizeof(double));
  bool settled[most_posed];
  const double sum = a.radius + b.radius;
  const bool in_range = sum > 1e-100 && sum < 1e100;
  for (std::size_t from = 0; from < n; from += most_posed) {
    const int here = int(std::min<std::size_t>(n - from, most_posed));
    if (in_range) detail::prove_many(a, b, pa + from, pb + from, here, settled, answers + from);
    for (std::size_t i = from; i < from + std::size_t(here); ++i) {
      if (in_range && settled[i - from]) continue;
      const std::int64_t supports = in_range ? answers[i].counts.full_tests : 0;
      Parts parts;
      parts.singles = !in_range;  // has been asked
      answers[i] = overlap(a, b, pa[i], pb[i], nullptr, parts);
      answers[i].counts.full_tests += supports;
    }
  }
}

}  // namespace ofg::verified
