// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The options of a query. The defaults are Opposing Face Geometry as in Kara's article
// (GameDev.net, 2004).
#pragma once

namespace ofg {

enum class Toi { none, velocity, bisection, halving };
enum class Order { ends, steps };
enum class Broad { start, swept };
enum class Concave { object, undivided, all_pairs };
enum class Nearest { centre, triangle };

struct Options {
  int k = 8;                   // faces in a selection: the accuracy constant
  Toi toi = Toi::velocity;     // how the time of a virtual edge's hit is computed
  Broad broad = Broad::swept;  // step 1 at the start pose, or with spheres swept along the motion
  Concave concave = Concave::object;  // which pieces of a concave body are tested
  Order order = Order::ends;  // for sweeps: the ends before the virtual edges, or the article's
                              // list of steps read literally
  int iterations =
      20;  // maximum halvings: a bisection ends with a bracket of 2^-iterations of the step
  bool screen = false;  // a plane between the whole bodies settles "no" before the steps: the same
                        // answers, faster

  // Repairs of the article's method, each with its own switch; off in the article.
  Nearest nearest =
      Nearest::centre;      // select by distance to the face's centre, or to the face itself
  bool adaptive_k = false;  // k grows until no face left out can reach the other's bounding sphere
  bool both_vertices = false;  // virtual edges from the vertices of B as well
  bool edge_edge = false;      // moving edges of A against edges of B
  int selection_times =
      1;  // made at the start; 2: and at the end; 3: and where the centres pass closest
  double arc_tolerance =
      0;  // > 0: divide the step so that no chord deviates by more than this share of A's radius
  bool containment = false;  // one body inside the other counts
  bool end_moment = false;   // a hit found only at the end of a sweep gets its time by bisection
  int piece_times = 1;       // at which a sweep selects the two pieces; as selection_times
  bool earliest = false;     // the earliest of all hits instead of the first found

  // Whether a query may ask the tables of supports: a screen does, which adaptive k always has.
  bool screens() const { return screen || adaptive_k; }
};

}  // namespace ofg
