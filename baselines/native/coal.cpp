// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Coal from its wheel: prepared ComputeCollision, as baselines/coal.py asks it.
#include <coal/BVH/BVH_model.h>
#include <coal/collision.h>
#include <coal/shape/convex.h>

#include "lane.hpp"

namespace {

using Geometry = std::shared_ptr<coal::CollisionGeometry>;

void arrays(const lane::Body& body, std::vector<coal::Vec3s>& points,
            std::vector<coal::Triangle>& triangles) {
  const auto& v = body.vertices;
  const auto& f = body.faces;
  for (std::size_t i = 0; i < v.size(); i += 3) points.emplace_back(v[i], v[i + 1], v[i + 2]);
  for (std::size_t i = 0; i < f.size(); i += 3) triangles.emplace_back(f[i], f[i + 1], f[i + 2]);
}

Geometry convex(const lane::Body& body) {
  auto points = std::make_shared<std::vector<coal::Vec3s>>();
  auto triangles = std::make_shared<std::vector<coal::Triangle>>();
  arrays(body, *points, *triangles);
  return std::make_shared<coal::Convex<coal::Triangle>>(points, unsigned(points->size()), triangles,
                                                        unsigned(triangles->size()));
}

Geometry mesh(const lane::Body& body) {
  std::vector<coal::Vec3s> points;
  std::vector<coal::Triangle> triangles;
  arrays(body, points, triangles);
  auto model = std::make_shared<coal::BVHModel<coal::OBBRSS>>();
  model->beginModel(unsigned(triangles.size()), unsigned(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

coal::Transform3s transform(const lane::Pose& pose) {
  coal::Matrix3s r;
  const auto m = pose.matrix();
  for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = m[i];
  return {r, coal::Vec3s(pose.p[0], pose.p[1], pose.p[2])};
}

template <class Base>
struct Coal : Base {
  Geometry (*const shape)(const lane::Body&);
  coal::CollisionRequest request;
  std::vector<Geometry> shapes;
  std::vector<coal::ComputeCollision> collide;
  std::vector<coal::Transform3s> a, b;
  coal::CollisionResult result;

  Coal(const char* name, Geometry (*make)(const lane::Body&), bool exact)
      : Base(name), shape(make) {
    if (!exact) return;
    request = coal::CollisionRequest(coal::NO_REQUEST, 1);
    request.gjk_tolerance = request.epa_tolerance = 1e-12;
    request.gjk_max_iterations = request.epa_max_iterations = 1000;
  }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& cases) override {
    for (const auto& body : bodies) shapes.push_back(shape(body));
    for (const auto& c : cases) {
      collide.emplace_back(shapes[c.a].get(), shapes[c.b].get());
      a.push_back(transform(c.pose_a)), b.push_back(transform(c.pose_b));
    }
  }

  lane::Verdict ask(std::size_t i) override {
    result.clear();
    const bool hit = collide[i](a[i], b[i], request, result) > 0;
    request.updateGuess(result);  // does nothing unless the guess is a cached one
    return {hit};
  }
};

struct Pieces final : lane::Unions {
  coal::CollisionRequest request;
  std::vector<std::vector<Geometry>> made;
  std::vector<std::vector<coal::ComputeCollision>> collide;  // all pairs of pieces of a case
  std::vector<coal::Transform3s> a, b;

  explicit Pieces(const char* name) : Unions(name) {}

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& cases) override {
    for (const auto& body : bodies) {
      made.emplace_back();
      for (const auto& piece : body.pieces) made.back().push_back(convex(piece));
    }
    for (const auto& c : cases) {
      collide.emplace_back();
      for (const auto& p : made[c.a])
        for (const auto& q : made[c.b]) collide.back().emplace_back(p.get(), q.get());
      a.push_back(transform(c.pose_a)), b.push_back(transform(c.pose_b));
    }
  }

  lane::Verdict ask(std::size_t i) override {
    coal::CollisionResult result;
    for (const auto& pair : collide[i]) {
      result.clear();
      if (pair(a[i], b[i], request, result) > 0) return {true};
    }
    return {false};
  }
};

struct Guessing final : Coal<lane::Remembering> {
  Guessing(const char* name, bool exact) : Coal(name, convex, exact) {
    request.gjk_initial_guess = coal::GJKInitialGuess::CachedGuess;
  }
  void forget() override {
    request.cached_gjk_guess = coal::Vec3s(1, 0, 0);
    request.cached_support_func_guess.setZero();
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  using Hulls = Coal<lane::Engine>;
  const auto add = [&](auto engine) { engines.push_back(std::move(engine)); };
  add(std::make_unique<Hulls>("coal-convex", convex, false));
  add(std::make_unique<Hulls>("coal-convex-exact", convex, true));
  add(std::make_unique<Pieces>("coal-convex"));
  add(std::make_unique<Coal<lane::Surfaces>>("coal-mesh", mesh, false));
  add(std::make_unique<Guessing>("coal-convex, cached guess", false));
  add(std::make_unique<Guessing>("coal-convex-exact, cached guess", true));
}
