// Coal from its wheel: prepared ComputeCollision on hulls.
#include <coal/BVH/BVH_model.h>
#include <coal/collision.h>
#include <coal/shape/convex.h>

#include "lane.hpp"

namespace {

using Geometry = std::shared_ptr<coal::CollisionGeometry>;

void arrays(const lane::Body& body, std::vector<coal::Vec3s>& points, std::vector<coal::Triangle>& triangles) {
  for (std::size_t i = 0; i < body.n(); ++i) points.emplace_back(body.vertices[3 * i], body.vertices[3 * i + 1], body.vertices[3 * i + 2]);
  for (std::size_t i = 0; i < body.m(); ++i) triangles.emplace_back(body.faces[3 * i], body.faces[3 * i + 1], body.faces[3 * i + 2]);
}

Geometry convex(const lane::Body& body) {
  auto points = std::make_shared<std::vector<coal::Vec3s>>();
  auto triangles = std::make_shared<std::vector<coal::Triangle>>();
  arrays(body, *points, *triangles);
  return std::make_shared<coal::Convex<coal::Triangle>>(points, unsigned(points->size()), triangles, unsigned(triangles->size()));
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

struct Coal final : lane::Engine {
  Geometry (*shape)(const lane::Body&);
  coal::CollisionRequest request;
  std::vector<Geometry> shapes;
  std::vector<coal::ComputeCollision> collide;
  std::vector<coal::Transform3s> a, b;
  coal::CollisionResult result;

  Coal(const char* name, Geometry (*make)(const lane::Body&), bool exact) : Engine(name), shape(make) {
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
    return {collide[i](a[i], b[i], request, result) > 0};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Coal>("coal-convex", convex, false));
  engines.push_back(std::make_unique<Coal>("coal-convex-exact", convex, true));
  engines.push_back(std::make_unique<Coal>("coal-mesh", mesh, false));
}
