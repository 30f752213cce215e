// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Do the interiors of two convex hulls meet, decided without rounding on the vertices, quaternions
// and positions as they are given? Touching is no meeting.
#pragma once
#include <optional>

#include "verified_portal.hpp"

namespace ofg::verified {
namespace detail {

// The vertices of one hull posed in the world, times |q_A|^2 |q_B|^2, which is positive and makes
// them polynomials in what is given.
class Placed {
 public:
  Placed(const Hull& hull, const double (&q)[4], const Number& others_square,
         const Vector& position)
      : hull_(hull), position_(position), kept_(hull.vertices.size()) {
    turning(q, turn_);
    for (auto& row : turn_) row = row * others_square;
  }

  const Vector& operator[](int i) {
    auto& kept = kept_[std::size_t(i)];
    if (!kept) {
      const Vector v(hull_.vertices[std::size_t(i)]);
      kept = Vector(dot(turn_[0], v), dot(turn_[1], v), dot(turn_[2], v)) + position_;
    }
    return *kept;
  }

  // Four times the centre of the hull's tetrahedron, which is interior.
  Vector inside() {
    const auto& c = hull_.corners;
    return (*this)[c[0]] + (*this)[c[1]] + ((*this)[c[2]] + (*this)[c[3]]);
  }

  // The vertex farthest along n. `near`: n in the hull's axes, of any length. It is off by 8 u |n|
  // from rounding n and by 36 u |n| from turning it, each product with a vertex by 5 u r |n|
  // besides: doubles leave out the vertices that are farther behind than twice 49 u r |n|.
  int farthest(const Vector& n, const Vec3<double>& near) {
    const double unit = unit_of(hull_.radius);
    const Vec3<double> axis = near * unit;
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < hull_.size(); ++i) most = std::fmax(most, dot(axis, hull_.point(i)));
    const double behind = most - 128 * unit_roundoff * hull_.radius * length(axis);
    int best = -1;
    Number height;
    for (int i = 0; i < hull_.size(); ++i) {
      if (dot(axis, hull_.point(i)) < behind) continue;
      const Number h = dot(n, (*this)[i]);
      if (best < 0 || (h - height).sign() > 0) best = i, height = h;
    }
    return best;
  }

 private:
  const Hull& hull_;
  Vector turn_[3], position_;
  std::vector<std::optional<Vector>> kept_;
};

inline Number square(const double (&q)[4]) {
  Number sum;
  for (const double c : q) sum = sum + Number(c) * Number(c);
  return sum;
}

// The sign of det(a, b, d'), d' = d + (e, e^2, e^3) for a positive e smaller than any number: 0
// only where a and b are parallel.
inline int side(const Vector& a, const Vector& b, const Vector& d) {
  const Vector n = cross(a, b);
  if (const int s = dot(n, d).sign()) return s;
  return n.x.sign() ? n.x.sign() : n.y.sign() ? n.y.sign() : n.z.sign();
}

// Does the plane of a portal keep M from the origin, or touch both? Whichever side it faces.
inline bool apart_along(const Portal& portal, Placed& a, Placed& b, const Mat3<double>& ra,
                        const Mat3<double>& rb, Vec3<double>& axis) {
  if (!portal.known) return false;
  Vector v[3];
  for (int i = 0; i < 3; ++i) v[i] = a[portal.a[i]] - b[portal.b[i]];
  const Vector n = cross(v[1] - v[0], v[2] - v[0]);
  if (n.zero()) return false;
  const Vec3<double> near = n.rounded();
  axis = rb.transposed() * near;
  const Vector s = a[a.farthest(n, ra.transposed() * near)] - b[b.farthest(-n, -axis)];
  return dot(n, s).sign() <= 0;
}

}  // namespace detail

// A ray goes from an interior point of M towards the origin, and slightly beside it so that it
// meets no edge (Edelsbrunner and Muecke, Simulation of Simplicity, 1990). The portal is a triangle
// with corners in M that it leaves through. Each step moves the portal out to the support along its
// normal; the ray leaves later each time, so that no triangle comes twice and the search ends.
// axis: the normal of the last portal in B's axes, from M's inside out. ended: where a search with
// rounding did, the normal outward; where bodies touch its plane mostly has all of M on one side
// and the origin in it, and there is nothing to search. sweep: A's displacement relative to B, over
// which a translation is asked about as a whole, without `ended`: the hull of A at its start and at
// its end is what A's interior passes through.
inline bool meets_exactly(const Hull& a, const Hull& b, const Pose& pa, const Pose& pb,
                          const Portal& ended, Vec3<double>& axis, const Vector& sweep = Vector()) {
  double qa[4], qb[4];
  detail::in_range(pa.q, qa), detail::in_range(pb.q, qb);
  const Number na = detail::square(qa), nb = detail::square(qb);
  const Vector way = (Vector(pa.p) - Vector(pb.p)) * (na * nb);
  detail::Placed place_a(a, qa, nb, way), place_b(b, qb, na, Vector());
  const Mat3<double> ra = rotation(pa.q), rb = rotation(pb.q);
  if (detail::apart_along(ended, place_a, place_b, ra, rb, axis)) return false;
  // Four times everything, so that the centres of the tetrahedra need no division.
  const Number four(4.0);
  const Vector swept = sweep * (na * nb * four);
  const Vector inside_b = place_b.inside(), start = place_a.inside() - inside_b, d = -start;
  if (start.zero()) return true;
  // The first portal: a face of A's tetrahedron, moved by the centre of B's. All are kept relative
  // to the start of the ray; det(v[0], v[1], v[2]) > 0.
  Vector v[3], corner[4];
  for (int i = 0; i < 4; ++i)
    corner[i] = place_a[a.corners[std::size_t(i)]] * four - inside_b - start;
  static constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const bool turn = dot(cross(corner[1], corner[2]), corner[3]).sign() < 0;
  for (const auto& f : face) {
    const Vector &p = corner[f[0]], &q = corner[f[turn ? 2 : 1]], &r = corner[f[turn ? 1 : 2]];
    if (detail::side(p, q, d) > 0 && detail::side(q, r, d) > 0 && detail::side(r, p, d) > 0) {
      v[0] = p, v[1] = q, v[2] = r;
      break;
    }
  }
  for (;;) {
    const Vector n = cross(v[1] - v[0], v[2] - v[0]);
    const Vec3<double> near = n.rounded();
    axis = rb.transposed() * near;
    // The origin is before the plane that the ray leaves by, so between two points of M of which
    // one is interior.
    if ((dot(n, v[0]) - dot(n, d)).sign() > 0) return true;
    Vector s = (place_a[place_a.farthest(n, ra.transposed() * near)] -
                place_b[place_b.farthest(-n, -axis)]) *
                   four -
               start;
    if (dot(n, swept).sign() > 0) s = s + swept;
    if ((dot(n, s) - dot(n, d)).sign() <= 0) return false;
    // Beyond the plane, so beyond the portal: the ray leaves through one of three triangles at s.
    const int t[3] = {detail::side(s, v[0], d), detail::side(s, v[1], d), detail::side(s, v[2], d)};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      // s lies farther out on the ray through corner i, or the triangle s, i, j is left through.
      if (t[i] == 0) {
        v[i] = s;
        break;
      }
      if (t[i] > 0 && t[j] < 0) {
        v[k] = s;
        break;
      }
    }
  }
}

}  // namespace ofg::verified
