// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Python's way to the first contact of moving bodies, proved.
#pragma once
#include "ofg/verified_sweep.hpp"
#include "verified.hpp"

namespace verified_sweep {

namespace nb = nanobind;
using namespace nb::literals;
using given::Doubles;
using given::require;
using ofg::verified::Impact;

inline ofg::Motion motion_of(const double* m) {
  return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, m[6], {m[7], m[8], m[9]}};
}

// The fields of ofg.Impacts.
inline nb::tuple in_arrays(const std::vector<Impact>& impacts) {
  const std::size_t n = impacts.size();
  double* latest;
  bool* proved;
  auto all_latest = returned::array<double>({n}, latest);
  auto all_proved = returned::array<bool>({n}, proved);
  for (std::size_t i = 0; i < n; ++i) latest[i] = impacts[i].latest, proved[i] = impacts[i].proved;
  const std::vector<ofg::Answer> answers(impacts.begin(), impacts.end());
  return nb::make_tuple(returned::in_arrays(answers), all_latest, all_proved);
}

// The convex pieces of a body that is no closed surface.
inline const ofg::verified::Hulls& pieces_of(const verified::Solid& body) {
  require(!body.solid.is_closed(), "a body must have convex pieces");
  return body.solid.pieces;
}

inline nb::tuple ask_many(const verified::Solid& solid_a, const verified::Solid& solid_b,
                          Doubles pa, Doubles pb, Doubles ma, Doubles mb, int threads) {
  using namespace given;
  const auto &a = pieces_of(solid_a), &b = pieces_of(solid_b);
  const std::size_t n = pa.shape(0);
  check_poses(pa, n, "poses_a"), check_poses(pb, n, "poses_b");
  check_motions(ma, n, "motions_a"), check_motions(mb, n, "motions_b");
  require(threads >= 1 && threads <= returned::most_threads,
          "threads must be 1 to " + std::to_string(returned::most_threads));
  std::vector<Impact> impacts(n);
  {
    nb::gil_scoped_release released;
    returned::in_parts(n, threads, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i)
        impacts[i] = ofg::verified::sweep(a, b, returned::pose_of(pa.data() + pose_columns * i),
                                          returned::pose_of(pb.data() + pose_columns * i),
                                          motion_of(ma.data() + motion_columns * i),
                                          motion_of(mb.data() + motion_columns * i));
    });
  }
  return in_arrays(impacts);
}

// One query, ready to be asked again and again: what a harness times.
struct Prepared {
  nb::object keep_a, keep_b;
  const ofg::verified::Hulls &a, &b;
  ofg::Pose pose_a, pose_b;
  ofg::Motion motion_a, motion_b;

  Prepared(nb::object oa, nb::object ob, Doubles poses, Doubles motions)
      : keep_a(oa),
        keep_b(ob),
        a(pieces_of(verified::Prepared::solid_of(oa))),
        b(pieces_of(verified::Prepared::solid_of(ob))) {
    given::check_poses(poses, 2, "poses"), given::check_motions(motions, 2, "motions");
    pose_a = returned::pose_of(poses.data());
    pose_b = returned::pose_of(poses.data() + given::pose_columns);
    motion_a = motion_of(motions.data());
    motion_b = motion_of(motions.data() + given::motion_columns);
  }

  nb::tuple call() const {
    const Impact x = ofg::verified::sweep(a, b, pose_a, pose_b, motion_a, motion_b);
    return nb::make_tuple(x.hit, x.time);
  }
};

inline void add_to(nb::module_& m) {
  nb::class_<Prepared>(m, "PreparedVerifiedSweep")
      .def(nb::init<nb::object, nb::object, Doubles, Doubles>(), "a"_a, "b"_a, "poses"_a,
           "motions"_a)
      .def("__call__", &Prepared::call, "(hit, time)");
  m.def("verified_sweep_many", &ask_many, "a"_a, "b"_a, "poses_a"_a, "poses_b"_a, "motions_a"_a,
        "motions_b"_a, "threads"_a);
}

}  // namespace verified_sweep
