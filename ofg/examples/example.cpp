// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Two boxes: do they touch now, and when do they meet if one flies and spins?
#include <array>
#include <cstdint>
#include <cstdio>

#include "ofg/ofg.hpp"

// A body is made once from vertices and outward triangles; the last argument promises that it is
// convex.
ofg::Body<double> box(double x, double y, double z) {
  std::array<double, 24> v;
  for (int i = 0; i < 8; ++i)
    v[3 * i] = i & 1 ? x : -x, v[3 * i + 1] = i & 2 ? y : -y, v[3 * i + 2] = i & 4 ? z : -z;
  const std::array<std::int32_t, 36> f = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                          2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  ofg::Body<double> body;
  body.whole = ofg::Mesh<double>(v.data(), 8, f.data(), 12, true);
  body.pieces = {body.whole};
  body.close();
  return body;
}

int main() {
  const ofg::Body<double> rod = box(2, 0.1, 0.1), wall = box(0.05, 5, 5);
  ofg::Workspace<double> memory;  // one per thread; after reserve no query allocates
  memory.reserve(rod, wall);

  const ofg::Pose start{{1, 0, 0, 0}, {-3, 0.2, 0.3}}, origin;
  ofg::Options article;
  article.k = 8;
  std::printf("now: %s\n",
              ofg::overlap(rod, wall, {start, origin}, article, memory).hit ? "hit" : "clear");

  ofg::Options repaired = article;
  repaired.adaptive_k = repaired.both_vertices = repaired.edge_edge = repaired.containment =
      repaired.earliest = true;
  repaired.selection_times = 3, repaired.arc_tolerance = 1e-6;
  const ofg::Motion motion{{6, 0, 0}, {0, 0, 1}, 3.0};  // flies along x, turning 3 radians about z
  for (const ofg::Options& options : {article, repaired}) {
    const ofg::Answer answer = ofg::sweep(rod, wall, {start, origin, motion}, options, memory);
    std::printf("step: %s at %.6f, face %d on face %d\n", answer.hit ? "hit" : "clear", answer.time,
                answer.face_a, answer.face_b);
  }
}
