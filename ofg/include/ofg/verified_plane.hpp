// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A plane between two moving hulls, and until when it is sure to keep them apart.
#pragma once
#include "verified_distance.hpp"

namespace ofg::verified {

// Fixed, or turning with a body, or normal to an edge of each.
enum class Frame : unsigned char { world, with_a, with_b, edges };

struct Plane {
  Frame frame = Frame::world;
  Vec3<double> n;       // from B to A, of length 1; in the axes of its frame
  Vec3<double> ea, eb;  // edges: of length 1 in the bodies' axes; n is their product, unless zero

  Vec3<double> normal(const Instant& now) const {
    if (frame == Frame::with_a) return now.a * n;
    if (frame == Frame::with_b) return now.b * n;
    if (frame == Frame::edges) return cross(now.a * ea, now.b * eb);
    return n;
  }

  // Along a unit normal at one time.
  static Plane fixed(Frame frame, const Vec3<double>& n, const Instant& now) {
    Plane plane;
    plane.frame = frame;
    plane.n = frame == Frame::with_a   ? now.a.transposed() * n
              : frame == Frame::with_b ? now.b.transposed() * n
                                       : n;
    return plane;
  }

  // How far rounding may move the gap along it.
  double margin(const Moving& m) const { return frame == Frame::world ? m.slack : 2 * m.slack; }

  // Bound on the second derivative of n(t) . (x - y), x a point of A and y one of B, over [s, e],
  // of which `now` is the start. With k the axes of rotation, x = P_A + R_A r, y = P_B + R_B s and
  // w = x - y:
  // - fixed: of A |angle_A|^2 |n x k_A| |k_A x r|, and B's likewise;
  // - turning with A: n . R_A r is constant. With v = P_A - y, the rest is n'' . v + 2 n' . v'
  //   + n . v''; n'' and n' are at right angles to k_A and of lengths |angle_A|^2 |n x k_A| and
  //   |angle_A| |n x k_A|, and y'' at right angles to k_B;
  // - edges, with u_A and u_B the turned edges: n . w = u_B . R_A (r x e_A) - u_A . R_B (e_B x s)
  //   + (u_A x u_B) . (P_A - P_B). A product of two vectors that turn with A and with B has second
  //   derivatives up to (|angle_A| + |angle_B|)^2 of their lengths.
  double bound(const Moving& m, double s, double e, const Instant& now) const {
    constexpr double up = 1 + 256 * unit_roundoff;
    const Turning &a = m.of_a, &b = m.of_b;
    const double wa = std::abs(a.angle), wb = std::abs(b.angle);
    const Vec3<double> from = m.pivots(s), to = m.pivots(e);
    if (frame == Frame::edges) {
      const double w = wa + wb, far = std::fmax(length(from), length(to)) + a.reach + b.reach;
      return up * (w * w * far + 2 * w * length(m.d));
    }
    const Vec3<double> u = normal(now);
    const auto part = [&](const Vec3<double>& k) { return length(cross(u, k)) + rounded; };
    if (frame == Frame::world) return up * (turned(a, part(a.axis)) + turned(b, part(b.axis)));
    // Turning with one body: `far` bounds the other's points seen from the line about which it
    // turns.
    const Turning &own = frame == Frame::with_a ? a : b, &other = frame == Frame::with_a ? b : a;
    const double w = std::abs(own.angle), v = std::abs(other.angle);
    const double far = std::fmax(length(cross(own.axis, from)), length(cross(own.axis, to))) +
                       (own.turns() ? other.reach : 0);
    const double drift = length(cross(own.axis, m.d)) + v * other.swing;
    // The normal turns by w (e - s) |n x k| at most; the other body's points swing across it.
    const double across = std::fmin(part(other.axis) + w * (e - s) * part(own.axis), 1.0);
    return up * (part(own.axis) * (w * w * far + 2 * w * drift) + v * v * across * other.swing);
  }

  // The rate of the gap between two points, as `gap` found them.
  double slope(const Moving& m, const Instant& now, const Gap& g) const {
    const Vec3<double> va = cross(m.of_a.axis, now.a * (g.a * m.unit + m.of_a.arm)) * m.of_a.angle,
                       vb = cross(m.of_b.axis, now.b * (g.b * m.unit + m.of_b.arm)) * m.of_b.angle;
    const Vec3<double> u = normal(now);
    double rate = dot(u, m.d + va - vb);
    if (frame == Frame::with_a) rate += m.of_a.angle * dot(cross(m.of_a.axis, u), g.w);
    if (frame == Frame::with_b) rate += m.of_b.angle * dot(cross(m.of_b.axis, u), g.w);
    if (frame == Frame::edges) {
      const Vec3<double> ua = now.a * ea, ub = now.b * eb;
      rate += dot(cross(cross(m.of_a.axis, ua) * m.of_a.angle, ub) +
                      cross(ua, cross(m.of_b.axis, ub) * m.of_b.angle),
                  g.w);
    }
    return rate;
  }

 private:
  static constexpr double rounded = 64 * unit_roundoff;  // of a normal of length 1

  static double turned(const Turning& body, double across) {
    return body.angle * body.angle * across * body.swing;
  }
};

// f lies above its chord less (bound / 2)(t - s)(e - t). The share of [s, e] over which that is not
// negative, from gaps f(s) > 0 and f(e): 1 for all of it.
inline double sure_share(double at_s, double at_e, double bound, double h) {
  const double bend = 0.5 * bound * h * h, b = at_e - at_s - bend;
  const double under = b * b - 4 * bend * at_s;
  if (at_e > 0 && (b >= 0 || under < 0)) return 1;
  // The lesser root, without cancellation; less than it by more than rounding.
  const double root = 2 * at_s / (-b + std::sqrt(std::fmax(under, 0.0)));
  if (at_e > 0 && root >= 1) return 1;
  return std::fmin(root * (1 - 32 * unit_roundoff), 1.0);
}

}  // namespace ofg::verified
