// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The portal of verified_portal.hpp in twice the digits, from where doubles left it: for bodies so
// near to touching that the rounding of doubles hides the answer. It proves what it answers or
// answers nothing.
#pragma once
#include "verified_portal.hpp"
#include "verified_twice.hpp"

namespace ofg::verified::detail {

// Posed, with the same bounds in units of 2^-102 in place of 2^-53. Vertices relative to the
// centres and the difference d of the positions are exact here. N(q) is off by 21 units; the matrix
// by 42 from two of them, 9 from their product, and 11 from the squares, the quotients and the
// products with those: 62. between = r c_A + shift - c_B: 68 units |c_A|, 50 |d|, and 2 of all for
// the sums. A point of M: 68 units r_A, and 2 of all again. Less than 84 of all the lengths, as
// there.
struct FinePose {
  Mat3<Twice> r;      // from A's axes to B's, times `unit`
  Vec3Twice between;  // from B's centre to A's, times `unit`
  Mat3<double> turn;  // r rounded
  double unit, slack;

  FinePose(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb, const Posed& at)
      : unit(at.unit), slack(at.slack * (twice_roundoff / unit_roundoff)) {
    double qa[4], qb[4];
    in_range(pa.q, qa), in_range(pb.q, qb);
    const Mat3<Twice> back = turning(qb).transposed();
    const Twice one(1), per_b = one / square_of(qb), per = per_b / square_of(qa);
    r = back * turning(qa);
    for (auto& row : r.row) row = scaled(row * per, unit);
    const Vec3Twice shift = scaled(back * exact_difference(pa.p, pb.p) * per_b, unit);
    between = r * Vec3Twice(a.centre) + shift - scaled(Vec3Twice(b.centre), unit);
    for (int i = 0; i < 3; ++i) turn.row[i] = Vec3<double>(r.row[i]);
  }
};

struct FineSearch {
  struct Corner {
    Vec3Twice m;  // a point of M
    int a, b;     // the vertices that it is the difference of
  };

  const Hull &a, &b;
  const FinePose& at;
  Counts& counts;
  Proof& proof;
  Portal& ended;

  Vec3Twice of_a(int i) const {
    return at.r * exact_difference(a.vertices[std::size_t(i)], a.centre) + at.between;
  }
  Vec3Twice of_b(int i) const {
    return scaled(exact_difference(b.vertices[std::size_t(i)], b.centre), at.unit);
  }

  // The vertex of a hull farthest along an axis in its own axes, by what `along` says of those that
  // doubles cannot tell apart. They err as in Placed::farthest.
  template <class Along>
  static int farthest(const Hull& hull, const Vec3<double>& axis, Along along) {
    const int n = hull.size();
    const double *x = hull.cloud.x.data(), *y = hull.cloud.y.data(), *z = hull.cloud.z.data();
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < n; ++i) {
      const double h = axis.x * x[i] + axis.y * y[i] + axis.z * z[i];
      most = h > most ? h : most;
    }
    const double behind = most - 128 * unit_roundoff * hull.radius * length(axis);
    int best = -1;
    bool alone = true;
    Twice height;
    for (int i = 0; i < n; ++i) {
      if (axis.x * x[i] + axis.y * y[i] + axis.z * z[i] < behind) continue;
      if (best < 0) {
        best = i;
        continue;
      }
      if (alone) height = along(best), alone = false;
      const Twice h = along(i);
      if (double(h - height) > 0) best = i, height = h;
    }
    return best;
  }

  Corner support(const Vec3Twice& n) {
    ++counts.full_tests, counts.distances += a.size() + b.size();
    const Vec3<double> axis(n);
    const int i = farthest(a, at.turn.transposed() * axis * (1 / at.unit),
                           [&](int k) { return dot(n, of_a(k)); });
    const int j = farthest(b, -axis, [&](int k) { return -dot(n, of_b(k)); });
    return {of_a(i) - of_b(j), i, j};
  }

  // holds_origin of verified_pose.hpp.
  bool holds_origin(const Vec3Twice (&v)[4]) const {
    static constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    int outward = 0;
    for (const auto& c : face) {
      const Vec3Twice p = v[c[0]], e = v[c[1]] - p, f = v[c[2]] - p, n = cross(e, f);
      const double height = double(dot(n, p)), spread = wide(e) * wide(f);
      const double doubt = at.slack * wide(n) + 16 * twice_roundoff * spread * (wide(p) + at.slack);
      if (!(std::abs(height) > 1.001 * doubt) || !(wide(n) > 1e-100)) return false;
      const int side = height > 0 ? 1 : -1;
      if (outward != 0 && side != outward) return false;
      outward = side;
    }
    return true;
  }

  // A point of M: where the ray of doubles begins, if that is sure to be one; or of two tetrahedra.
  Vec3Twice inside() const {
    if (a.off_centre + b.off_centre == 0)
      return at.between + scaled(Vec3Twice(proof.inside), at.unit);
    Vec3Twice p;
    for (int i = 0; i < 4; ++i) {
      static constexpr double share[4] = {0.3125, 0.1875, 0.375, 0.125};
      p = p + (of_a(a.corners[std::size_t(i)]) - of_b(b.corners[std::size_t(i)])) * share[i];
    }
    return p;
  }

  // The corner of the doubles' portal, by the vertices that are rounded to it.
  Corner corner(const Vec3<double>& from_a, const Vec3<double>& from_b) const {
    const auto which = [](const Hull& hull, const Vec3<double>& p) {
      int i = 0;
      while (i + 1 < hull.size() && !(hull.point(i) == p)) ++i;
      return i;
    };
    const int i = which(a, from_a), j = which(b, from_b);
    return {of_a(i) - of_b(j), i, j};
  }

  void run() {
    const Vec3Twice v0 = inside();
    Corner v[3];
    for (int i = 0; i < 3; ++i) v[i] = corner(proof.a[i], proof.b[i]);
    for (int step = 0; step < most_steps; ++step) {
      Vec3Twice n = cross(v[1].m - v[0].m, v[2].m - v[0].m);
      if (double(dot(n, v[0].m - v0)) < 0) std::swap(v[1], v[2]), n = -n;
      if (!(wide(n) > 1e-100)) return;
      if (double(dot(n, v[0].m)) >= 0) {
        ++counts.face_pairs;
        const Vec3Twice all[4] = {v0, v[0].m, v[1].m, v[2].m};
        if (holds_origin(all)) return settle(Verdict::meeting, n, v);
      }
      const Corner s = support(n);
      const double size = 1.001 * at.slack * wide(n);
      if (double(dot(n, s.m)) < -size) return settle(Verdict::apart, n, v);
      if (!(double(dot(n, s.m - v[0].m)) > size)) {  // nothing to gain
        ended.known = true;
        for (int i = 0; i < 3; ++i) ended.a[i] = v[i].a, ended.b[i] = v[i].b;
        return;
      }
      const Vec3Twice c = cross(s.m, v0);
      const bool one = double(dot(v[0].m, c)) > 0, two = double(dot(v[1].m, c)) > 0,
                 three = double(dot(v[2].m, c)) > 0;
      v[one ? (two ? 0 : 2) : (three ? 1 : 0)] = s;
    }
  }

  void settle(Verdict verdict, const Vec3Twice& n, const Corner (&v)[3]) {
    proof.verdict = verdict, proof.axis = Vec3<double>(n);
    for (int i = 0; i < 3; ++i) proof.a[i] = a.point(v[i].a), proof.b[i] = b.point(v[i].b);
  }
};

}  // namespace ofg::verified::detail
