// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Bullet in doubles, as pybullet is built: its GJK with EPA on hulls, as baselines/bullet.py asks
// it; its other solver of distances; and its pair algorithm with the manifold that it keeps.
#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "lane.hpp"

namespace {

constexpr double margin = 0.001;  // what pybullet gives its hulls

struct Depth final : btDiscreteCollisionDetectorInterface::Result {
  double distance = BT_LARGE_FLOAT;
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3&, const btVector3&, btScalar depth) override {
    distance = depth;
  }
};

btTransform transform(const lane::Pose& p) {
  return btTransform(btQuaternion(p.q[1], p.q[2], p.q[3], p.q[0]),
                     btVector3(p.p[0], p.p[1], p.p[2]));
}

std::unique_ptr<btConvexHullShape> hull(const lane::Body& body) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (std::size_t i = 0; i < body.vertices.size(); i += 3)
    shape->addPoint(btVector3(body.vertices[i], body.vertices[i + 1], body.vertices[i + 2]), false);
  shape->recalcLocalAabb();
  shape->optimizeConvexHull();
  shape->setMargin(margin);
  return shape;
}

template <class Base>
struct Hulls : Base {
  std::vector<std::unique_ptr<btConvexHullShape>> shapes;
  std::vector<lane::Case> cases;
  btAlignedObjectArray<btTransform> a, b;

  using Base::Base;

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    for (const auto& body : bodies) shapes.push_back(hull(body));
    cases = asked;
    for (const auto& c : cases) a.push_back(transform(c.pose_a)), b.push_back(transform(c.pose_b));
  }

  btConvexHullShape* shape_a(std::size_t i) { return shapes[cases[i].a].get(); }
  btConvexHullShape* shape_b(std::size_t i) { return shapes[cases[i].b].get(); }
};

struct Pair final : Hulls<lane::Engine> {
  const double threshold;  // a distance below it is an overlap
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver epa;

  Pair(const char* name, double t) : Hulls(name), threshold(t) {}

  lane::Verdict ask(std::size_t i) override {
    btGjkPairDetector detector(shape_a(i), shape_b(i), &simplex, &epa);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = a[int(i)];
    input.m_transformB = b[int(i)];
    input.m_maximumDistanceSquared = 4 * margin * margin;  // of the cores: no more is asked
    Depth result;
    detector.getClosestPoints(input, result, nullptr);
    return {result.distance < threshold};
  }
};

// btGjkEpaSolver2 on the cores, which have no margin.
struct Cores final : Hulls<lane::Engine> {
  Cores() : Hulls("bullet-gjkepa2") {}

  lane::Verdict ask(std::size_t i) override {
    btGjkEpaSolver2::sResults result;
    const btTransform &at_a = a[int(i)], &at_b = b[int(i)];
    const btVector3 guess = at_a.getOrigin() - at_b.getOrigin();
    return {!btGjkEpaSolver2::Distance(shape_a(i), at_a, shape_b(i), at_b, guess, result)};
  }
};

// What btCollisionWorld does with a pair that stays near: its algorithm, with a manifold of the
// contacts of the steps before.
struct Manifold final : Hulls<lane::Remembering> {
  const double threshold;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDispatcherInfo info;
  btCollisionObject of_a, of_b;
  btCollisionAlgorithm* algorithm = nullptr;

  Manifold(const char* name, double t) : Hulls(name), threshold(t) {}
  ~Manifold() override { forget(); }

  void forget() override {
    if (!algorithm) return;
    algorithm->~btCollisionAlgorithm();
    dispatcher.freeCollisionAlgorithm(algorithm);
    algorithm = nullptr;
  }

  lane::Verdict ask(std::size_t i) override {
    const btTransform &at_a = a[int(i)], &at_b = b[int(i)];
    of_a.setWorldTransform(at_a), of_b.setWorldTransform(at_b);
    btCollisionObjectWrapper wrapped_a(nullptr, shape_a(i), &of_a, at_a, -1, -1);
    btCollisionObjectWrapper wrapped_b(nullptr, shape_b(i), &of_b, at_b, -1, -1);
    if (!algorithm) {
      of_a.setCollisionShape(shape_a(i)), of_b.setCollisionShape(shape_b(i));
      algorithm =
          dispatcher.findAlgorithm(&wrapped_a, &wrapped_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    }
    btManifoldResult result(&wrapped_a, &wrapped_b);
    algorithm->processCollision(&wrapped_a, &wrapped_b, info, &result);
    const btPersistentManifold* kept = result.getPersistentManifold();
    for (int k = 0; kept && k < kept->getNumContacts(); ++k)
      if (kept->getContactPoint(k).getDistance() < threshold) return {true};
    return {false};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Pair>("bullet", 0.0));
  engines.push_back(std::make_unique<Pair>("bullet-no-margin", -2 * margin));
  engines.push_back(std::make_unique<Cores>());
  engines.push_back(std::make_unique<Manifold>("bullet, kept manifold", 0.0));
  engines.push_back(std::make_unique<Manifold>("bullet-no-margin, kept manifold", -2 * margin));
}
