// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A control: an engine behind the spheres of verified OFG. How much of OFG's lead is its spheres,
// which anyone can put in front of any test of convex bodies?
#pragma once
#include "lane.hpp"
#include "ofg/verified_hull.hpp"

namespace lane {

// As baselines/spheres.py asks it: bounding spheres that are apart are a miss and inscribed spheres
// that meet a hit, by the radii of ofg::verified::Hull and with the margin of Posed
// (verified_pose.hpp); else the engine is asked. OFG's own step works out the relative pose that it
// needs further on. Here nothing but the centres is moved, by matrices worked out beforehand as the
// transforms of engines are: the control gets the cheapest form of the step.
class Spheres final : public Engine {
 public:
  explicit Spheres(std::unique_ptr<Engine> engine)
      : Engine("spheres-" + engine->name), engine_(std::move(engine)) {
    isa = engine_->isa, build_of = engine_->build_of;
  }

  // Each pair once, or many poses of one.
  bool stands(Mode mode) const override {
    return (mode == Mode::cold || mode == Mode::warm) && engine_->stands(mode);
  }
  std::string asked_as() const override { return engine_->asked_as(); }
  bool refuses(std::size_t i) const override { return engine_->refuses(i); }
  void turn() override { engine_->turn(); }
  void forget() override { engine_->forget(); }

  void build(const std::vector<Body>& bodies, const std::vector<Case>& cases) override {
    engine_->build(bodies, cases);
    std::vector<Ball> balls;
    for (const Body& body : bodies) balls.push_back(ball(body));
    for (const Case& c : cases) {
      const Ball &a = balls[c.a], &b = balls[c.b];
      const double lengths = a.radius + b.radius + size(a.centre) + size(b.centre) +
                             size(c.pose_a.p) + size(c.pose_b.p);
      pairs_.push_back({a, b, c.pose_a.matrix(), c.pose_b.matrix(), c.pose_a.p, c.pose_b.p,
                        256 * ofg::verified::unit_roundoff * lengths});
    }
  }

  Verdict ask(std::size_t i) override {
    const Pair& at = pairs_[i];
    Vector between;
    for (std::size_t k = 0; k < 3; ++k)
      between[k] = at.place_a[k] + along(at.turn_a, k, at.a.centre) - at.place_b[k] -
                   along(at.turn_b, k, at.b.centre);
    const double apart = size(between);
    if (apart > at.a.radius + at.b.radius + at.slack) return {false};
    if (apart + at.slack < at.a.inner + at.b.inner) return {true};
    return engine_->ask(i);
  }

 private:
  using Vector = std::array<double, 3>;
  struct Ball {
    Vector centre;
    double radius, inner;
  };
  struct Pair {
    Ball a, b;
    std::array<double, 9> turn_a, turn_b;
    Vector place_a, place_b;
    double slack;
  };

  std::unique_ptr<Engine> engine_;
  std::vector<Pair> pairs_;

  static Ball ball(const Body& body) {
    const ofg::verified::Hull hull(ofg::Mesh<double>(body.vertices.data(), body.n(),
                                                     body.faces.data(), body.m(), body.convex));
    return {{hull.centre.x, hull.centre.y, hull.centre.z}, hull.radius, hull.inner};
  }

  static double along(const std::array<double, 9>& turn, std::size_t row, const Vector& v) {
    return turn[3 * row] * v[0] + turn[3 * row + 1] * v[1] + turn[3 * row + 2] * v[2];
  }

  static double size(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
};

// The configurations that get the control: of each library the most exact one, and those that are
// fastest in some cell.
inline bool gets_spheres(const std::string& engine) {
  for (const char* name : {"fcl-convex-exact", "coal-convex-exact", "mujoco-exact", "mujoco-libccd",
                           "parry-exact", "bullet-no-margin", "bullet-gjkepa2"})
    if (engine == name) return true;
  return false;
}

}  // namespace lane
