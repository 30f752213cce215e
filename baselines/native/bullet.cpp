// Bullet in doubles, as pybullet is built: its GJK with EPA on hulls.
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "lane.hpp"

namespace {

constexpr double margin = 0.001;  // what pybullet gives its hulls

struct Depth final : btDiscreteCollisionDetectorInterface::Result {
  double distance = BT_LARGE_FLOAT;
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3&, const btVector3&, btScalar depth) override { distance = depth; }
};

btTransform transform(const lane::Pose& p) { return btTransform(btQuaternion(p.q[1], p.q[2], p.q[3], p.q[0]), btVector3(p.p[0], p.p[1], p.p[2])); }

struct Bullet final : lane::Engine {
  const double threshold;  // a distance below it is an overlap
  std::vector<std::unique_ptr<btConvexHullShape>> shapes;
  std::vector<lane::Case> cases;
  std::vector<btTransform> a, b;
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver epa;

  Bullet(const char* name, double t) : Engine(name), threshold(t) {}

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    for (const auto& body : bodies) {
      auto shape = std::make_unique<btConvexHullShape>();
      for (std::size_t i = 0; i < body.n(); ++i)
        shape->addPoint(btVector3(body.vertices[3 * i], body.vertices[3 * i + 1], body.vertices[3 * i + 2]), false);
      shape->recalcLocalAabb();
      shape->optimizeConvexHull();
      shape->setMargin(margin);
      shapes.push_back(std::move(shape));
    }
    cases = asked;
    for (const auto& c : cases) a.push_back(transform(c.pose_a)), b.push_back(transform(c.pose_b));
  }

  lane::Verdict ask(std::size_t i) override {
    btGjkPairDetector detector(shapes[cases[i].a].get(), shapes[cases[i].b].get(), &simplex, &epa);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = a[i];
    input.m_transformB = b[i];
    input.m_maximumDistanceSquared = 4 * margin * margin;  // of the cores: farther apart is not asked about
    Depth result;
    detector.getClosestPoints(input, result, nullptr);
    return {result.distance < threshold};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Bullet>("bullet", 0.0));
  engines.push_back(std::make_unique<Bullet>("bullet-no-margin", -2 * margin));
}
