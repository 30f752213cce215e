// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The result of a query.
#pragma once
#include <cstdint>
#include <limits>

namespace ofg {

// Operations performed, by kind, so that the article's claims can be counted.
struct Counts {
  std::int64_t spheres = 0;     // pairs of spheres compared: steps 1 and 6
  std::int64_t distances = 0;   // from a point to a face or to a piece: steps 2 and 4
  std::int64_t face_pairs = 0;  // pairs of faces settled: step 8
  std::int64_t edge_faces = 0;  // virtual edges against faces
  std::int64_t edge_pairs = 0;  // moving edges against edges (a repair)
  std::int64_t full_tests = 0;  // the face_pairs that no cheap rejection settled
  std::int64_t evaluated =
      0;  // distances computed to settle `distances`: to boxes of blocks and to faces
  std::int64_t steps = 0;    // parts into which the step was divided, and halvings of a bisection
  std::int64_t growths = 0;  // of a verified selection: whole bodies that objected to it
  void add(const Counts& c) {
    spheres += c.spheres, distances += c.distances, face_pairs += c.face_pairs,
        edge_faces += c.edge_faces;
    edge_pairs += c.edge_pairs, full_tests += c.full_tests, evaluated += c.evaluated,
        steps += c.steps, growths += c.growths;
  }
};

// What was found to collide.
// within: faces at the end of a window within the step, into which arcs are divided
enum class Found : std::int8_t {
  nothing,
  start,
  end,
  edge_face,
  face_edge,
  edge_edge,
  inside,
  within
};

struct Answer {
  bool hit = false;
  double time = std::numeric_limits<double>::quiet_NaN();  // of impact, in [0, 1]; NaN where the
                                                           // method gives none
  Found found = Found::nothing;
  int face_a = -1, face_b = -1;    // the faces that met, in their pieces; -1 if no face did
  int piece_a = -1, piece_b = -1;  // the pieces tested last; -1 for an undivided mesh
  Counts counts;
};

}  // namespace ofg
