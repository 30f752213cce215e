// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// FCL's shapes and transforms, of the lane's.
#pragma once
#include <fcl/fcl.h>

#include "lane.hpp"

namespace shapes {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

inline fcl::Vector3d point(const lane::Body& body, std::size_t i) {
  return {body.vertices[3 * i], body.vertices[3 * i + 1], body.vertices[3 * i + 2]};
}

inline Geometry convex(const lane::Body& body) {
  auto points = std::make_shared<std::vector<fcl::Vector3d>>();
  for (std::size_t i = 0; i < body.n(); ++i) points->push_back(point(body, i));
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto* f = body.faces.data(); f < body.faces.data() + body.faces.size(); f += 3)
    faces->insert(faces->end(), {3, f[0], f[1], f[2]});
  auto shape = std::make_shared<fcl::Convexd>(points, int(body.m()), faces);
  shape->computeLocalAABB();  // as a CollisionObject does
  return shape;
}

inline Geometry mesh(const lane::Body& body) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < body.n(); ++i) points.push_back(point(body, i));
  for (const auto* f = body.faces.data(); f < body.faces.data() + body.faces.size(); f += 3)
    triangles.emplace_back(f[0], f[1], f[2]);
  model->beginModel(int(triangles.size()), int(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  model->computeLocalAABB();
  return model;
}

inline fcl::Transform3d transform(const lane::Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  const auto m = pose.matrix();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.linear()(i, j) = m[std::size_t(3 * i + j)];
    t.translation()[i] = pose.p[std::size_t(i)];
  }
  return t;
}

}  // namespace shapes
