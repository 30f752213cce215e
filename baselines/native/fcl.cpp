// FCL: convex and mesh overlap, conservative advancement for translations.
#include <fcl/fcl.h>

#include "lane.hpp"

namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry convex(const lane::Body& body) {
  auto points = std::make_shared<std::vector<fcl::Vector3d>>();
  for (std::size_t i = 0; i < body.n(); ++i) points->emplace_back(body.vertices[3 * i], body.vertices[3 * i + 1], body.vertices[3 * i + 2]);
  auto faces = std::make_shared<std::vector<int>>();
  for (std::size_t i = 0; i < body.m(); ++i) faces->insert(faces->end(), {3, body.faces[3 * i], body.faces[3 * i + 1], body.faces[3 * i + 2]});
  return std::make_shared<fcl::Convexd>(points, int(body.m()), faces);
}

Geometry mesh(const lane::Body& body) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < body.n(); ++i) points.emplace_back(body.vertices[3 * i], body.vertices[3 * i + 1], body.vertices[3 * i + 2]);
  for (std::size_t i = 0; i < body.m(); ++i) triangles.emplace_back(body.faces[3 * i], body.faces[3 * i + 1], body.faces[3 * i + 2]);
  model->beginModel(int(triangles.size()), int(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d transform(const lane::Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  const auto m = pose.matrix();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.linear()(i, j) = m[3 * i + j];
    t.translation()[i] = pose.p[i];
  }
  return t;
}

struct Fcl : lane::Engine {
  Geometry (*shape)(const lane::Body&);
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> a, b;
  std::vector<fcl::Transform3d> at, end;

  Fcl(const char* name, Geometry (*make)(const lane::Body&)) : Engine(name), shape(make) {}

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& cases) override {
    std::vector<Geometry> shapes;
    for (const auto& body : bodies) shapes.push_back(shape(body));
    for (const auto& c : cases) {
      at.push_back(transform(c.pose_a));
      end.push_back(at.back());
      for (int i = 0; i < 3; ++i) end.back().translation()[i] += c.displacement[i];
      a.push_back(std::make_unique<fcl::CollisionObjectd>(shapes[c.a], at.back()));
      b.push_back(std::make_unique<fcl::CollisionObjectd>(shapes[c.b], transform(c.pose_b)));
    }
  }
};

struct Overlap final : Fcl {
  using Fcl::Fcl;
  const fcl::CollisionRequestd request;

  lane::Verdict ask(std::size_t i) override {
    a[i]->setTransform(at[i]);
    fcl::CollisionResultd result;
    return {fcl::collide(a[i].get(), b[i].get(), request, result) > 0};
  }
};

struct Advancement final : Fcl {
  fcl::ContinuousCollisionRequestd request;

  Advancement() : Fcl("fcl-advancement-convex toc_err=0.0001 path=trans", convex) {
    request.num_max_iterations = 1000;
    request.ccd_motion_type = fcl::CCDM_TRANS;
    request.gjk_solver_type = fcl::GST_INDEP;
    request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  }
  bool answers(lane::Question question) const override { return question == lane::Question::translation; }

  lane::Verdict ask(std::size_t i) override {
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(a[i].get(), end[i], b[i].get(), b[i]->getTransform(), request, result);
    return {result.is_collide, result.is_collide ? result.time_of_contact : std::nan("")};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Overlap>("fcl-convex", convex));
  engines.push_back(std::make_unique<Overlap>("fcl-mesh", mesh));
  engines.push_back(std::make_unique<Advancement>());
}
