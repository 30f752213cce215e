// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A portal in doubles (Snethen, XenoCollide, in Game Programming Gems 7, 2008) that proves what it
// answers, or answers nothing.
#pragma once
#include "answer.hpp"
#include "verified_pose.hpp"

namespace ofg::verified {

enum class Verdict : unsigned char { unsure, apart, meeting };

// What proved the last answer: worth a try at the next pose.
struct Proof {
  Verdict verdict = Verdict::unsure;
  Vec3<double> axis;        // in B's axes: of a plane between the two, or the normal of the portal
  Vec3<double> a[3], b[3];  // corners of the portal, relative to the centres, in their bodies' axes
  Vec3<double> inside;      // what is added to `between` to make the fourth corner, in B's axes
  double off = 0;           // how far the corners may be from points of the bodies
};

// The vertices of A and of B whose differences are the corners of a portal.
struct Portal {
  bool known = false;
  int a[3], b[3];
};

namespace detail {

constexpr int most_steps = 100, most_starts = 3;

// Within M: a point at a share of the inscribed balls' radii from `between`, in a direction that no
// symmetry singles out. From the centre itself the ray runs along edges and through corners of the
// portal wherever two boxes meet squarely, and then no tetrahedron holds the origin by a margin.
inline Vec3<double> beside(const Hull& a, const Hull& b, int start) {
  static constexpr double way[most_starts][3] = {
      {0.1013, 0.1781, -0.1447}, {-0.2273, 0.0641, 0.1187}, {0.0719, -0.2131, 0.1619}};
  const double size = a.inner + b.inner;
  return {way[start][0] * size, way[start][1] * size, way[start][2] * size};
}

// Is the origin inside the tetrahedron of a proof at this pose?
inline bool still_meeting(const Posed& at, const Proof& p) {
  Vec3<double> v[4] = {at.between + p.inside * at.unit};
  for (int i = 0; i < 3; ++i) v[i + 1] = (at.r * p.a[i] - p.b[i]) * at.unit + at.between;
  return holds_origin(v, at.slack + at.away + p.off * at.unit);
}

struct Search {
  const Hull &a, &b;
  const Posed& at;
  Counts& counts;
  Proof& proof;
  bool closed = false;  // whether it ended at a portal that no support lies beyond, which proof has

  // The support along n; true where its plane keeps the two apart, or where n is no direction.
  bool ends(const Vec3<double>& n, Support& s) {
    if (!(dot(n, n) > 1e-120)) return true;
    s = support(a, b, at, n);
    counts.distances += a.size() + b.size();
    ++counts.full_tests;
    if (!clear_along(s, n, at)) return false;
    proof.verdict = Verdict::apart, proof.axis = n;
    return true;
  }

  void keep(const Vec3<double>& inside, const Vec3<double>& n, const Support (&s)[3]) {
    proof.inside = inside, proof.axis = n, proof.off = 0;
    for (int i = 0; i < 3; ++i) proof.a[i] = s[i].a, proof.b[i] = s[i].b;
  }

  bool proves_meeting(const Vec3<double>& inside, const Vec3<double>& n, const Support (&s)[3]) {
    ++counts.face_pairs;
    keep(inside, n, s);
    if (!still_meeting(at, proof)) return false;
    proof.verdict = Verdict::meeting;
    return true;
  }

  void run(int start) {
    const Vec3<double> inside = beside(a, b, start), v0 = at.between + inside * at.unit;
    Support v[3], s;
    if (ends(-v0, v[0])) return;
    // The axis reflected at the corner that stands in its way: often it separates (Chung and Wang
    // 1996), and any other corner will do for a second.
    const Vec3<double> w = v[0].point;
    Vec3<double> n = w * (2 * dot(w, v0) / dot(w, w)) - v0;
    if (ends(n, v[1])) return;
    const Vec3<double> e = w - v0, f = v[1].point - v0;
    n = cross(e, f);
    if (!(dot(n, n) > 1e-20 * dot(e, e) * dot(f, f))) {  // in line with v0: any other will do
      n = cross(e, Vec3<double>(e.y, e.z, -e.x));
      if (ends(n, v[1])) return;
      n = cross(e, v[1].point - v0);
    }
    if (dot(n, v0) > 0) std::swap(v[0], v[1]), n = -n;
    bool seeking = true;  // the ray does not yet pass through the portal
    for (int step = 0; step < most_steps; ++step) {
      if (ends(n, s)) return;
      if (seeking) {
        // s takes the place of the corner that it makes needless, or completes the portal.
        if (dot(cross(v[0].point, s.point), v0) < 0) {
          v[1] = s;
        } else if (dot(cross(s.point, v[1].point), v0) < 0) {
          v[0] = s;
        } else {
          v[2] = s, seeking = false;
        }
        if (seeking) n = cross(v[0].point - v0, v[1].point - v0);
      } else {
        if (!(dot(n, s.point - v[0].point) > at.slack * length(n)))
          return closed = true, keep(inside, n, v);  // nothing to gain
        const Vec3<double> c = cross(s.point, v0);
        const bool one = dot(v[0].point, c) > 0, two = dot(v[1].point, c) > 0,
                   three = dot(v[2].point, c) > 0;
        v[one ? (two ? 0 : 2) : (three ? 1 : 0)] = s;
      }
      if (seeking) continue;
      n = cross(v[1].point - v[0].point, v[2].point - v[0].point);
      if (dot(n, v[0].point) >= 0 && proves_meeting(inside, n, v)) return;
    }
  }
};

}  // namespace detail
}  // namespace ofg::verified
