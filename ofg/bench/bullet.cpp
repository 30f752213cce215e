#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bench.hpp"

// Its two distance solvers on hulls without margin. The pair detector needs its penetration solver: without it 3 to 30 % of
// shallow overlaps come out as distances.
std::vector<Timed> bullet_methods(const Cell& cell) {
  const auto shape = [](const Hull& h) {
    auto s = std::make_shared<btConvexHullShape>();
    for (std::size_t i = 0; i < h.v.size(); i += 3)
      s->addPoint(btVector3(btScalar(h.v[i]), btScalar(h.v[i + 1]), btScalar(h.v[i + 2])), false);
    s->setMargin(0);
    s->recalcLocalAabb();
    return s;
  };
  const auto a = shape(cell.a), b = shape(cell.b);
  auto poses = std::make_shared<std::vector<btTransform>>();
  for (std::size_t i = 0; i < cell.poses.size(); i += 7) {
    const double* p = &cell.poses[i];
    const btQuaternion q{btScalar(p[1]), btScalar(p[2]), btScalar(p[3]), btScalar(p[0])};
    poses->emplace_back(q.normalized(), btVector3(btScalar(p[4]), btScalar(p[5]), btScalar(p[6])));
  }
  return {{"Bullet GjkPair",
           [=](const Cell&) {
             btVoronoiSimplexSolver simplex;
             btGjkEpaPenetrationDepthSolver depth;
             long hits = 0;
             for (std::size_t i = 0; i < poses->size(); i += 2) {
               btGjkPairDetector detector(a.get(), b.get(), &simplex, &depth);
               btGjkPairDetector::ClosestPointInput input;
               input.m_transformA = (*poses)[i], input.m_transformB = (*poses)[i + 1];
               btPointCollector out;
               detector.getClosestPoints(input, out, nullptr);
               hits += !out.m_hasResult || out.m_distance <= 0;
             }
             return hits;
           }},
          {"Bullet GjkEpa2", [=](const Cell&) {
             long hits = 0;
             for (std::size_t i = 0; i < poses->size(); i += 2) {
               btGjkEpaSolver2::sResults r;
               const btVector3 guess = (*poses)[i].getOrigin() - (*poses)[i + 1].getOrigin();
               hits += !btGjkEpaSolver2::Distance(a.get(), (*poses)[i], b.get(), (*poses)[i + 1], guess, r);
             }
             return hits;
           }}};
}
