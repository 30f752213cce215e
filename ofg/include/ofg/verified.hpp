// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Verified Opposing Face Geometry: do the interiors of two convex bodies meet? The answer is
// proved, never guessed. Look only at what opposes, verify against the whole body, and look at more
// where that objects; what doubles cannot prove is decided in twice their digits, or exactly.
#pragma once
#include "screen.hpp"
#include "verified_exact.hpp"
#include "verified_fine.hpp"
#include "verified_spheres.hpp"

namespace ofg::verified {

// What the last question about a pair of bodies left behind, for the next one. The answer is proved
// at each pose and does not depend on it. For one thread at a time.
struct Cache {
  std::uint64_t a = 0, b = 0;  // the hulls that it is about
  Proof proof;
};

// Parts that may be left out, to price them; each answer is proved all the same.
struct Parts {
  bool spheres = true;    // bounding and inscribed
  bool singles = true;    // single precision before double
  bool selection = true;  // the opposing vertices before the whole bodies
  bool doubles = true;    // double precision before exact arithmetic
  bool twice = true;      // and after it twice the digits
};

namespace detail {

// In single precision, and first through what opposes. In units of the sum of the radii, where
// Posed's slack, and 128 units of 2^-24 (screen.hpp counts them), are the gap that proves an
// answer.
inline void opposed(const Hull& a, const Hull& b, const Posed& at, const Parts& parts,
                    Counts& counts, Proof& proof) {
  const double unit = 1 / (a.radius + b.radius), share = unit / at.unit;
  OpposedPair pair;
  const Mat3<double> back = at.r.transposed();
  pair.patch_a = a.opposing.patch(back * -at.between);
  pair.patch_b = b.opposing.patch(at.between);
  pair.map_a = a.supports.view(), pair.map_b = b.supports.view();
  pair.complete = a.opposing.complete() && b.opposing.complete();
  pair.whole = !parts.selection;
  const Vec3<double> between = at.between * share, inside = beside(a, b, 0) * unit;
  const double scale = a.radius * unit;
  for (int i = 0; i < 3; ++i) {
    const Vec3<double>& row = at.r.row[i];
    pair.r[3 * i] = float(row.x * scale), pair.r[3 * i + 1] = float(row.y * scale),
               pair.r[3 * i + 2] = float(row.z * scale);
  }
  const auto put = [](const Vec3<double>& v, float* to) {
    to[0] = float(v.x), to[1] = float(v.y), to[2] = float(v.z);
  };
  put(between, pair.between), put(inside, pair.inside);
  pair.size_b = float(b.radius * unit);
  const double way = std::abs(between.x) + std::abs(between.y) + std::abs(between.z);
  const double gap = ofg::detail::screen_rounding * (1 + way) + (at.slack + at.away) * share;
  pair.gap = float(gap * (1 + 1e-6));
  Opposed out{};
  const int said = kernels<double>.oppose(pair, out);
  counts.distances += out.distances, counts.face_pairs += out.portals;
  counts.full_tests += out.supports, counts.growths += out.growths;
  if (said == 0) return;
  proof.verdict = said == 1 ? Verdict::apart : Verdict::meeting;
  proof.axis = {out.axis[0], out.axis[1], out.axis[2]};
  if (said == 1) return;
  proof.inside = beside(a, b, 0), proof.off = 0x1p-22 * (a.radius + b.radius);
  for (int i = 0; i < 3; ++i) {
    const float* c = out.corners[i];
    proof.a[i] = Vec3<double>(c[0], c[1], c[2]) * a.radius;
    proof.b[i] = Vec3<double>(c[3], c[4], c[5]) * b.radius;
  }
}

// Does a plane across n keep the two apart, by the tables and in single precision? A table's points
// are rounded to 2 units of 2^-24 of the radius, the axis likewise, and the choice among them is
// off by 30: 128 are more.
inline bool apart_by_tables(const Hull& a, const Hull& b, const Posed& at, const Vec3<double>& n,
                            Counts& counts) {
  const Vec3<double> turned = at.r.transposed() * n;
  const double size = length(n), scale = 1 / size;
  const auto extreme = [scale](const SupportMap& map, const Vec3<double>& axis) {
    const float v[3] = {float(axis.x * scale), float(axis.y * scale), float(axis.z * scale)};
    float p[3];
    kernels<double>.extreme(map.view(), v, p);
    return Vec3<double>(p[0], p[1], p[2]);
  };
  ++counts.full_tests;
  const double sum = (a.radius + b.radius) * at.unit,
               height = (dot(turned, extreme(a.supports, -turned)) * a.radius -
                         dot(n, extreme(b.supports, n)) * b.radius) *
                            at.unit +
                        dot(n, at.between);
  return height < -(ofg::detail::screen_rounding * sum + at.slack) * size;
}

// Only a plane or a portal that still proves its answer here is an answer.
inline bool recalled(const Hull& a, const Hull& b, const Posed& at, const Cache& cache,
                     Counts& counts, Proof& proof) {
  if (cache.a != a.number || cache.b != b.number) return false;
  if (cache.proof.verdict == Verdict::apart) {
    if (apart_by_tables(a, b, at, cache.proof.axis, counts)) {
      proof = cache.proof;
      return true;
    }
    Search search{a, b, at, counts, proof};
    Support s;
    return search.ends(cache.proof.axis, s) && proof.verdict != Verdict::unsure;
  }
  if (cache.proof.verdict != Verdict::meeting) return false;
  ++counts.face_pairs;
  if (!still_meeting(at, cache.proof)) return false;
  proof = cache.proof;
  return true;
}

// In doubles from several starts, and where these end at a portal with the origin on it, as far as
// doubles can tell, in twice the digits.
inline void closed_in(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb, const Posed& at,
                      const Parts& parts, Counts& counts, Proof& proof, Portal& ended) {
  const int starts = a.inner + b.inner > 0 ? most_starts : 1;
  for (int i = 0; i < starts && proof.verdict == Verdict::unsure && !ended.known; ++i) {
    Search search{a, b, at, counts, proof};
    search.run(i);
    if (proof.verdict != Verdict::unsure || !search.closed || !parts.twice) continue;
    const FinePose fine(a, b, pa, pb, at);
    FineSearch{a, b, fine, counts, proof, ended}.run();
  }
}

// Whether spheres settle it, and then the answer.
inline bool settled(Verdict said, Answer& answer) {
  if (said == Verdict::meeting) answer.hit = true, answer.found = Found::inside;
  return said != Verdict::unsure;
}

inline void name(const Hull& a, const Hull& b, const Posed& at, const Proof& proof,
                 Answer& answer) {
  answer.hit = proof.verdict == Verdict::meeting;
  if (!answer.hit) return;
  answer.found = Found::start;
  answer.face_a = a.opposing.face(at.r.transposed() * proof.axis);
  answer.face_b = b.opposing.face(-proof.axis);
}

}  // namespace detail

// Do the interiors of two hulls meet? Touching is no meeting. Hulls that are flat have no interior;
// do not ask. cache: of this pair, or none.
//
// hit: `found` is start, with the faces that oppose each other where the portal was left; or
// inside, where the inscribed balls meet. counts: spheres; distances, of vertices along an axis;
// face_pairs, portals tried; full_tests, supports of the whole bodies, and growths, of these those
// that objected to a selection; steps, 1, and 1 more where it took exact arithmetic.
inline Answer overlap(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb,
                      Cache* cache = nullptr, const Parts& parts = {}) {
  Answer answer;
  answer.counts.steps = 1;
  const Frames frames(a, b, pa, pb);
  answer.counts.spheres = parts.spheres;
  if (parts.spheres && detail::settled(by_spheres(a, b, frames), answer)) return answer;
  const Centres centres(a, b, pa, pb, frames);
  if (parts.spheres && detail::settled(by_spheres(a, b, centres), answer)) return answer;
  const Posed at(a, b, centres);
  Proof proof;
  if (at.sure && cache && detail::recalled(a, b, at, *cache, answer.counts, proof)) {
    detail::name(a, b, at, proof, answer);
    return answer;
  }
  if (at.sure && parts.singles) detail::opposed(a, b, at, parts, answer.counts, proof);
  Portal ended;
  if (at.sure && parts.doubles)
    detail::closed_in(a, b, pa, pb, at, parts, answer.counts, proof, ended);
  if (proof.verdict != Verdict::unsure) {
    if (cache) *cache = {a.number, b.number, proof};
  } else {
    ++answer.counts.steps;
    proof.verdict =
        meets_exactly(a, b, pa, pb, ended, proof.axis) ? Verdict::meeting : Verdict::apart;
  }
  detail::name(a, b, at, proof, answer);
  return answer;
}

}  // namespace ofg::verified
