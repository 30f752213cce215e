// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// FCL's overlap tests, of convex bodies by both of its solvers, of surfaces, and of unions by all
// pairs of pieces, as baselines/fcl.py asks them. Transforms are made beforehand.
#include "fcl_shapes.hpp"

namespace {

template <class Base>
struct Overlap : Base {
  shapes::Geometry (*const shape)(const lane::Body&);
  fcl::CollisionRequestd request;
  std::vector<shapes::Geometry> made;
  std::vector<const fcl::CollisionGeometryd*> a, b;
  std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>> at_a, at_b;

  Overlap(const char* name, shapes::Geometry (*make)(const lane::Body&), fcl::GJKSolverType solver)
      : Base(name), shape(make) {
    request.gjk_solver_type = solver;
  }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& cases) override {
    for (const auto& body : bodies) made.push_back(shape(body));
    for (const auto& c : cases) {
      a.push_back(made[c.a].get()), b.push_back(made[c.b].get());
      at_a.push_back(shapes::transform(c.pose_a)), at_b.push_back(shapes::transform(c.pose_b));
    }
  }

  lane::Verdict ask(std::size_t i) override {
    fcl::CollisionResultd result;
    const bool hit = fcl::collide(a[i], at_a[i], b[i], at_b[i], request, result) > 0;
    if (request.enable_cached_gjk_guess) request.cached_gjk_guess = result.cached_gjk_guess;
    return {hit};
  }
};

struct Pieces final : lane::Unions {
  fcl::CollisionRequestd request;
  std::vector<std::vector<shapes::Geometry>> made;
  std::vector<lane::Case> cases;
  std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>> at_a, at_b;

  explicit Pieces(const char* name) : Unions(name) { request.gjk_solver_type = fcl::GST_LIBCCD; }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    for (const auto& body : bodies) {
      made.emplace_back();
      for (const auto& piece : body.pieces) made.back().push_back(shapes::convex(piece));
    }
    cases = asked;
    for (const auto& c : cases)
      at_a.push_back(shapes::transform(c.pose_a)), at_b.push_back(shapes::transform(c.pose_b));
  }

  lane::Verdict ask(std::size_t i) override {
    for (const auto& a : made[cases[i].a])
      for (const auto& b : made[cases[i].b]) {
        fcl::CollisionResultd result;
        if (fcl::collide(a.get(), at_a[i], b.get(), at_b[i], request, result) > 0) return {true};
      }
    return {false};
  }
};

// FCL's own solver takes a guess, libccd none.
struct Guessing final : Overlap<lane::Remembering> {
  Guessing() : Overlap("fcl-convex-indep, cached guess", shapes::convex, fcl::GST_INDEP) {
    request.enable_cached_gjk_guess = true;
  }
  void forget() override { request.cached_gjk_guess = fcl::Vector3d::UnitX(); }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  using Hulls = Overlap<lane::Engine>;
  const auto add = [&](auto engine) { engines.push_back(std::move(engine)); };
  add(std::make_unique<Hulls>("fcl-convex", shapes::convex, fcl::GST_LIBCCD));
  add(std::make_unique<Hulls>("fcl-convex-exact", shapes::convex, fcl::GST_LIBCCD));
  add(std::make_unique<Hulls>("fcl-convex-indep", shapes::convex, fcl::GST_INDEP));
  add(std::make_unique<Guessing>());
  add(std::make_unique<Pieces>("fcl-convex"));
  add(std::make_unique<Overlap<lane::Surfaces>>("fcl-mesh", shapes::mesh, fcl::GST_LIBCCD));
}
