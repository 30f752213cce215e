// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The spheres of verified overlap in front of a query of any other method.
#pragma once
#include "verified.hpp"

namespace spheres {

namespace nb = nanobind;
using namespace nb::literals;

// One query, ready to be asked again and again. `clear` and `hit` are what it returns where the
// spheres prove them; elsewhere it returns what `otherwise` does.
struct Prepared {
  nb::object keep_a, keep_b;
  const ofg::verified::Hull &a, &b;
  ofg::Pose pose_a, pose_b;
  nb::object clear, hit, otherwise;

  Prepared(nb::object oa, nb::object ob, given::Doubles poses, nb::object clear_, nb::object hit_,
           nb::object otherwise_)
      : keep_a(oa),
        keep_b(ob),
        a(only_piece(oa)),
        b(only_piece(ob)),
        clear(clear_),
        hit(hit_),
        otherwise(otherwise_) {
    given::check_poses(poses, 2, "poses");
    pose_a = returned::pose_of(poses.data());
    pose_b = returned::pose_of(poses.data() + given::pose_columns);
  }

  static const ofg::verified::Hull& only_piece(nb::handle body) {
    const ofg::verified::Solid& solid = verified::Prepared::solid_of(body).solid;
    given::require(solid.is_convex(), "a body must be one convex piece");
    return solid.pieces[0];
  }

  nb::object call() const {
    using ofg::verified::Verdict;
    const Verdict said = ofg::verified::by_spheres(a, b, pose_a, pose_b);
    return said == Verdict::apart ? clear : said == Verdict::meeting ? hit : otherwise();
  }
};

inline void add_to(nb::module_& m) {
  nb::class_<Prepared>(m, "PreparedSpheres")
      .def(nb::init<nb::object, nb::object, given::Doubles, nb::object, nb::object, nb::object>(),
           "a"_a, "b"_a, "poses"_a, "clear"_a, "hit"_a, "otherwise"_a)
      .def("__call__", &Prepared::call);
}

}  // namespace spheres
