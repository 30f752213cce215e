// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// On which side of a plane through three points does a fourth lie, of points of two posed bodies?
// In doubles where these are sure, else exactly, on the coordinates, quaternions and positions as
// they are given. Where the answer is "on the plane", one body gives way by less than any number.
#pragma once
#include <optional>
#include <unordered_map>

#include "verified_exact.hpp"

namespace ofg::verified {

// Two bodies at one pair of poses, in B's axes. As Posed has it, without units: how far a computed
// point may be from the true one is counted there as 84 u of the same lengths, u = 2^-53, for
// vertices; points on rays lie up to six radii from a centre and so are off by six times as much.
struct Between {
  Mat3<double> r;        // from A's axes to B's
  Vec3<double> between;  // from B's centre to A's
  double slack = 0;
  bool sure = true;  // false where numbers left their range: nothing is known

  Between(const Vec3<double>& centre_a, double radius_a, const Vec3<double>& centre_b,
          double radius_b, const Pose& pa, const Pose& pb) {
    const Transform<double> pose = Track(pa, pb).at(0);
    const double sum = radius_a + radius_b,
                 lengths = sum + length(centre_a) + length(centre_b) + length(pa.p - pb.p);
    r = pose.r;
    between = r * centre_a + pose.p - centre_b;
    slack = 1024 * unit_roundoff * lengths;
    sure = sum > 1e-100 && lengths < 1e90 && slack < sum * 1e90;
  }
};

// The mean of n given points in a row, n a power of two. at: in B's axes relative to its centre,
// within a Between's slack.
struct Point {
  Vec3<double> at;
  const Vec3<double>* given;
  int n = 1;
  bool in_b = false;    // are the given ones in B's axes, or in A's?
  bool moves = false;   // with B
  bool vertex = false;  // of a body, so that what is given stays where it is
};

class Sides {
 public:
  std::int64_t exact = 0;  // questions that took exact arithmetic

  Sides(const Pose& pa, const Pose& pb, const Between& at, bool doubles)
      : pa_(pa), pb_(pb), slack_(doubles && at.sure ? at.slack : INFINITY) {}

  // The sign of det(b - a, c - a, d - a), where B is moved by (e, e^2, e^3) for a positive e
  // smaller than any number (Edelsbrunner and Muecke, Simulation of Simplicity, 1990). 0 only where
  // two lines among the points are parallel, or three points in line.
  int operator()(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Vec3<double> e = b.at - a.at, f = c.at - a.at, g = d.at - a.at;
    return settled(dot(cross(e, f), g), size(e), size(f), size(g), a, b, c, d);
  }

  // The same of a plane and three points.
  void of_plane(const Point (&plane)[3], const Point (&p)[3], int (&side)[3]) {
    const Vec3<double> o = plane[0].at, e = plane[1].at - o, f = plane[2].at - o, n = cross(e, f);
    const double x = size(e), y = size(f);
    for (int k = 0; k < 3; ++k) {
      const Vec3<double> g = p[k].at - o;
      side[k] = settled(dot(n, g), x, y, size(g), plane[0], plane[1], plane[2], p[k]);
    }
  }

  // Does the line from p to q pass between the corners of a face, whose plane it passes?
  bool passes(const Point& p, const Point& q, const Point (&face)[3]) {
    const Vec3<double> d = q.at - p.at;
    Vec3<double> w[3];
    double reach[3];
    for (int k = 0; k < 3; ++k) w[k] = face[k].at - p.at, reach[k] = size(w[k]);
    const double along = size(d);
    int first = 0;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, side = settled(dot(cross(d, w[k]), w[l]), along, reach[k],
                                                reach[l], p, q, face[k], face[l]);
      if (k == 0) first = side;
      if (side != first) return false;
    }
    return true;
  }

 private:
  // Each point is off by the slack s, so differences by 2 s, and their determinant by
  // 2 s (xy + yz + zx) with x, y, z no less than the lengths and 2 s; rounding adds 12 u xyz
  // (holds_origin).
  int settled(double det, double x, double y, double z, const Point& a, const Point& b,
              const Point& c, const Point& d) {
    const double doubt =
        2 * slack_ * (x * y + y * z + z * x) + 16 * unit_roundoff * x * y * z + 1e-290;
    if (det > doubt) return 1;
    if (det < -doubt) return -1;
    ++exact;
    return exactly(a, b, c, d);
  }

  // What is exact is in the world, relative to B's position, times 4 |q_A|^2 |q_B|^2.
  struct Frames {
    Vector turn[2][3], way;
  };

  double size(const Vec3<double>& v) const {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) + 2 * slack_;
  }

  static Frames frames_of(const Pose& pa, const Pose& pb) {
    Frames to;
    double qa[4], qb[4];
    detail::in_range(pa.q, qa), detail::in_range(pb.q, qb);
    const Number na = detail::square(qa), nb = detail::square(qb);
    turning(qa, to.turn[0]), turning(qb, to.turn[1]);
    for (std::size_t i = 0; i < 3; ++i)
      to.turn[0][i] = to.turn[0][i] * nb, to.turn[1][i] = to.turn[1][i] * na;
    to.way = (Vector(pa.p) - Vector(pb.p)) * (na * nb * Number(4.0));
    return to;
  }

  Vector place(const Point& point) const {
    Vector sum;
    for (int i = 0; i < point.n; ++i) sum = sum + Vector(point.given[i]);
    sum = sum * Number(4.0 / point.n);
    const auto& turn = frames_->turn[point.in_b ? 1 : 0];
    const Vector v(dot(turn[0], sum), dot(turn[1], sum), dot(turn[2], sum));
    return point.in_b ? v : v + frames_->way;
  }

  // Vertices are asked about again and again where surfaces lie on one another.
  Vector placed(const Point& point) {
    if (!point.vertex) return place(point);
    auto& kept = kept_[point.given];
    if (!kept) kept = place(point);
    return *kept;
  }

  int exactly(const Point& a, const Point& b, const Point& c, const Point& d) {
    if (!frames_) frames_ = frames_of(pa_, pb_);
    const Vector o = placed(a), e = placed(b) - o, f = placed(c) - o, g = placed(d) - o;
    const Vector ef = cross(e, f);
    if (const int s = dot(ef, g).sign()) return s;
    // The determinant is linear in the move, whose multiples are in one direction.
    const auto way = [&](const Point& p) { return Number(double(p.moves) - double(a.moves)); };
    const Vector n = cross(f, g) * way(b) + cross(g, e) * way(c) + ef * way(d);
    return n.x.sign() ? n.x.sign() : n.y.sign() ? n.y.sign() : n.z.sign();
  }

  Pose pa_, pb_;
  double slack_;
  std::optional<Frames> frames_;
  std::unordered_map<const Vec3<double>*, std::optional<Vector>> kept_;
};

}  // namespace ofg::verified
