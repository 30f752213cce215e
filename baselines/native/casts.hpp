// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Bullet's three continuous convex casts on hulls, in doubles: two bodies in pieces, and the legs
// of their motions.
#pragma once
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace casts {

enum class Kind : int { subsimplex, gjk, continuous };

struct Options {
  Kind kind = Kind::continuous;
  double margin = -1;  // of each hull; a negative one leaves what Bullet gives it
  // 0: the start pose is not tested before the cast. Else these units for that test: EPA wants
  // bodies of about 1, and misses one cube within another where they are 8192 times as large.
  double start_unit = 0;
  int halvings = 0;  // of a leg whose cast reports that it did not converge
};

// Where both bodies are at the two ends of a leg.
struct Leg {
  btTransform from_a, to_a, from_b, to_b;

  // A leg of no length in the middle of this one.
  Leg middle() const {
    const btTransform a = between(from_a, to_a), b = between(from_b, to_b);
    return {a, a, b, b};
  }

 private:
  static btTransform between(const btTransform& from, const btTransform& to) {
    btVector3 velocity, spin;
    btTransform at;
    btTransformUtil::calculateVelocity(from, to, 1, velocity, spin);
    btTransformUtil::integrateTransform(from, velocity, spin, 0.5, at);
    return at;
  }
};

// btContinuousConvexCollision reports here that it gave up; what it returns then is "clear".
struct Result final : btConvexCast::CastResult {
  bool failed = false;
  void reportFailure(int, int) override { failed = true; }
};

struct Answer {
  bool hit;
  double time;  // share of the step
};

using Hulls = std::vector<std::unique_ptr<btConvexHullShape>>;

using Points = std::vector<btVector3>;

inline std::unique_ptr<btConvexHullShape> hull(const Points& points, double unit, double margin) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const auto& point : points) shape->addPoint(unit * point, false);
  if (margin >= 0) shape->setMargin(margin);
  shape->recalcLocalAabb();
  return shape;
}

class Question {
 public:
  // a, b: the points of each piece.
  Question(const Options& options, const std::vector<Points>& a, const std::vector<Points>& b,
           std::vector<Leg> legs)
      : options_(options), a_(hulls(a, 1)), b_(hulls(b, 1)), legs_(std::move(legs)) {
    if (options_.start_unit > 0)
      start_a_ = hulls(a, options_.start_unit), start_b_ = hulls(b, options_.start_unit);
  }

  // The earliest impact over all pairs of pieces, leg after leg.
  Answer ask() {
    if (options_.start_unit > 0 && overlap_at_start()) return {true, 0};
    for (std::size_t i = 0; i < legs_.size(); ++i)
      if (const double first = leg(legs_[i], options_.halvings); first <= 1)
        return {true, (double(i) + std::max(first, 0.0)) / double(legs_.size())};
    return {false, 0};
  }

 private:
  Hulls hulls(const std::vector<Points>& pieces, double unit) const {
    Hulls made;
    for (const auto& points : pieces) made.push_back(hull(points, unit, options_.margin * unit));
    return made;
  }

  // The share of the leg after which the first pieces meet; more than 1 for none.
  double leg(const Leg& at, int halvings) {
    double first = BT_LARGE_FLOAT;
    for (const auto& a : a_)
      for (const auto& b : b_) first = std::min(first, pair(*a, *b, at, halvings));
    return first;
  }

  double pair(const btConvexHullShape& a, const btConvexHullShape& b, const Leg& at, int halvings) {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    btSubsimplexConvexCast subsimplex(&a, &b, &simplex);
    btGjkConvexCast gjk(&a, &b, &simplex);
    btContinuousConvexCollision continuous(&a, &b, &simplex, &epa);
    btConvexCast* const all[] = {&subsimplex, &gjk, &continuous};
    Result result;
    const auto cast = all[int(options_.kind)];
    if (cast->calcTimeOfImpact(at.from_a, at.to_a, at.from_b, at.to_b, result))
      return result.m_fraction;
    if (!result.failed || !halvings) return BT_LARGE_FLOAT;
    const Leg middle = at.middle();
    const Leg early{at.from_a, middle.from_a, at.from_b, middle.from_b};
    const Leg late{middle.from_a, at.to_a, middle.from_b, at.to_b};
    const double first = pair(a, b, early, halvings - 1);
    if (first <= 1) return first / 2;
    const double second = pair(a, b, late, halvings - 1);
    return second <= 1 ? (1 + second) / 2 : BT_LARGE_FLOAT;
  }

  bool overlap_at_start() {
    btTransform at_a = legs_.front().from_a, at_b = legs_.front().from_b;
    at_a.setOrigin(options_.start_unit * at_a.getOrigin());
    at_b.setOrigin(options_.start_unit * at_b.getOrigin());
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    for (const auto& a : start_a_)
      for (const auto& b : start_b_) {
        btGjkPairDetector detector(a.get(), b.get(), &simplex, &epa);
        btGjkPairDetector::ClosestPointInput input;
        input.m_transformA = at_a;
        input.m_transformB = at_b;
        btPointCollector found;
        detector.getClosestPoints(input, found, nullptr);
        if (!found.m_hasResult || found.m_distance <= 0) return true;
      }
    return false;
  }

  Options options_;
  Hulls a_, b_, start_a_, start_b_;
  std::vector<Leg> legs_;
};

}  // namespace casts
