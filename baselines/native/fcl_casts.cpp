// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// FCL's continuous request on hulls: as it comes, and conservative advancement at its best, as
// baselines/fcl.py asks it.
#include <cstring>
#include <new>

#include "fcl_shapes.hpp"

namespace {

struct Leg {
  fcl::Transform3d start_a, stop_a, b;
};

// An InterpMotion reads its reference point before anything has written it: it is made where zeros
// are, the origin, which FCL documents. So are those of CCDM_LINEAR in baselines/fcl.py.
class Interpolated {
 public:
  Interpolated(const fcl::Transform3d& from, const fcl::Transform3d& to) {
    std::memset(place_, 0, sizeof place_);
    asm volatile("" : : "r"(place_) : "memory");  // or the compiler drops what nobody reads
    motion_ = ::new (place_) fcl::InterpMotion<double>(from, to);
  }
  ~Interpolated() { motion_->~InterpMotion(); }
  Interpolated(const Interpolated&) = delete;
  const fcl::InterpMotion<double>* get() const { return motion_; }

 private:
  alignas(fcl::InterpMotion<double>) unsigned char place_[sizeof(fcl::InterpMotion<double>)];
  fcl::InterpMotion<double>* motion_;
};

struct Cast : lane::Engine {
  fcl::ContinuousCollisionRequestd request;
  std::vector<shapes::Geometry> made;
  std::vector<std::array<const fcl::CollisionGeometryd*, 2>> pairs;
  std::vector<std::vector<Leg>> legs;

  using Engine::Engine;

  bool linear() const { return request.ccd_motion_type == fcl::CCDM_LINEAR; }
  bool answers(lane::Question question) const override {
    return question == lane::Question::translation ||
           (linear() && question == lane::Question::motion);
  }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& cases) override {
    for (const auto& body : bodies) made.push_back(shapes::convex(body));
    for (const auto& c : cases) {
      // Between two poses FCL takes the shortest turn.
      const int n = linear() ? std::max(1, int(std::ceil(std::abs(c.angle) / 3))) : 1;
      std::vector<Leg> path;
      for (int i = 0; i < n; ++i)
        path.push_back({shapes::transform(c.at(double(i) / n)),
                        shapes::transform(c.at(double(i + 1) / n)), shapes::transform(c.pose_b)});
      legs.push_back(std::move(path));
      pairs.push_back({made[c.a].get(), made[c.b].get()});
    }
  }

  lane::Verdict ask(std::size_t i) override {
    const auto [a, b] = pairs[i];
    for (std::size_t k = 0; k < legs[i].size(); ++k) {
      const auto& [start, stop, at_b] = legs[i][k];
      fcl::ContinuousCollisionResultd result;
      if (linear()) {
        const Interpolated of_a(start, stop), of_b(at_b, at_b);
        const fcl::MotionBased *motion_a = of_a.get(), *motion_b = of_b.get();
        fcl::continuousCollide(a, motion_a, b, motion_b, request, result);
      } else {
        fcl::continuousCollide(a, start, stop, b, at_b, at_b, request, result);
      }
      if (result.is_collide)
        return {true, (double(k) + result.time_of_contact) / double(legs[i].size())};
    }
    return {false};
  }
};

std::unique_ptr<Cast> advancement(const char* name, fcl::CCDMotionType path) {
  auto cast = std::make_unique<Cast>(name);
  cast->request.num_max_iterations = 1000;
  cast->request.toc_err = 1e-4;
  cast->request.ccd_motion_type = path;
  cast->request.gjk_solver_type = fcl::GST_INDEP;
  cast->request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  return cast;
}

std::unique_ptr<Cast> as_it_comes() {
  auto cast = std::make_unique<Cast>("fcl-ccd-convex");
  cast->request.ccd_motion_type = fcl::CCDM_TRANS;
  cast->request.gjk_solver_type = fcl::GST_LIBCCD;
  cast->request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  return cast;
}

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(as_it_comes());
  engines.push_back(advancement("fcl-advancement-convex", fcl::CCDM_LINEAR));
  engines.push_back(advancement("fcl-advancement-convex path=trans", fcl::CCDM_TRANS));
}
