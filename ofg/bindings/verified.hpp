// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Python's way to verified overlap.
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/stl/vector.h>

#include "given.hpp"
#include "ofg/verified_batch.hpp"
#include "ofg/verified_solid.hpp"
#include "returned.hpp"

namespace verified {

namespace nb = nanobind;
using namespace nb::literals;
using given::Doubles;
using given::Ints;
using given::require;

// The convex pieces of a body, or its closed surface.
struct Solid {
  ofg::verified::Solid solid;

  Solid(const std::vector<Doubles>& vertices, const std::vector<Ints>& faces, bool closed)
      : solid(made(vertices, faces, closed)) {}

  static ofg::verified::Solid made(const std::vector<Doubles>& vertices,
                                   const std::vector<Ints>& faces, bool closed) {
    require(vertices.size() == faces.size() && !vertices.empty(),
            "vertices and faces must be of one length, and not empty");
    require(!closed || vertices.size() == 1, "a closed surface is one part");
    ofg::verified::Hulls pieces;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      given::check_mesh(vertices[i], faces[i]);
      const double* v = vertices[i].data();
      const std::int32_t* f = faces[i].data();
      std::vector<ofg::Vec3<double>> points;
      std::vector<std::array<int, 3>> triangles;
      for (std::size_t j = 0; j < 3 * vertices[i].shape(0); j += 3)
        points.push_back({v[j], v[j + 1], v[j + 2]});
      for (std::size_t j = 0; j < 3 * faces[i].shape(0); j += 3)
        triangles.push_back({f[j], f[j + 1], f[j + 2]});
      if (closed) return ofg::verified::Solid::closed(std::move(points), std::move(triangles));
      pieces.emplace_back(std::move(points), triangles);
      require(!pieces.back().flat, "a piece is flat: its interior is empty");
    }
    return ofg::verified::Solid(std::move(pieces));
  }

  double inner() const {
    require(!solid.is_closed(), "a closed surface has no inscribed ball");
    return solid.pieces[0].inner;
  }
};

using Cache = ofg::verified::Cache;

inline ofg::verified::Parts parts_of(bool selection) {
  ofg::verified::Parts parts;
  parts.selection = selection;
  return parts;
}

inline nb::tuple ask_many(const Solid& a, const Solid& b, Doubles pa, Doubles pb, Cache* cache,
                          bool selection, int threads) {
  const std::size_t n = pa.shape(0);
  given::check_poses(pa, n, "poses_a"), given::check_poses(pb, n, "poses_b");
  require(threads >= 1 && threads <= returned::most_threads,
          "threads must be 1 to " + std::to_string(returned::most_threads));
  require(!cache || threads == 1, "a cache is for one thread");
  std::vector<ofg::Answer> answers(n);
  const ofg::verified::Parts parts = parts_of(selection);
  const auto *p = pa.data(), *q = pb.data();
  const auto range = [&](std::size_t from, std::size_t to) {
    if (a.solid.is_convex() && b.solid.is_convex() && !cache && selection) {
      static_assert(sizeof(ofg::Pose) == given::pose_columns * sizeof(double));
      const auto *u = reinterpret_cast<const ofg::Pose*>(p),
                 *v = reinterpret_cast<const ofg::Pose*>(q);
      ofg::verified::overlap_many(a.solid.pieces[0], b.solid.pieces[0], u + from, v + from,
                                  to - from, answers.data() + from);
      for (std::size_t i = from; i < to; ++i) answers[i].piece_a = answers[i].piece_b = 0;
      return;
    }
    for (std::size_t i = from; i < to; ++i)
      answers[i] =
          ofg::verified::overlap(a.solid, b.solid, returned::pose_of(p + given::pose_columns * i),
                                 returned::pose_of(q + given::pose_columns * i), cache, parts);
  };
  if (cache) {
    range(0, n);  // holding the lock: nobody else has the cache meanwhile
  } else {
    nb::gil_scoped_release released;
    returned::in_parts(n, threads, range);
  }
  return returned::in_arrays(answers);
}

// One query, ready to be asked again and again: what a harness times.
struct Prepared {
  nb::object keep_a, keep_b;
  const Solid &a, &b;
  ofg::Pose pose_a, pose_b;
  ofg::verified::Parts parts;

  Prepared(nb::object oa, nb::object ob, Doubles poses, bool selection)
      : keep_a(oa), keep_b(ob), a(solid_of(oa)), b(solid_of(ob)), parts(parts_of(selection)) {
    given::check_poses(poses, 2, "poses");
    pose_a = returned::pose_of(poses.data());
    pose_b = returned::pose_of(poses.data() + given::pose_columns);
  }

  static const Solid& solid_of(nb::handle body) {
    require(nb::isinstance<Solid>(body), "a body must be a VerifiedSolid of this module");
    return nb::cast<const Solid&>(body);
  }

  nb::tuple call() const {
    const ofg::Answer x = ofg::verified::overlap(a.solid, b.solid, pose_a, pose_b, nullptr, parts);
    return nb::make_tuple(x.hit, x.time);
  }
};

inline void add_to(nb::module_& m) {
  nb::class_<Solid>(m, "VerifiedSolid")
      .def(nb::init<const std::vector<Doubles>&, const std::vector<Ints>&, bool>(), "vertices"_a,
           "faces"_a, "closed"_a)
      .def("inner", &Solid::inner)
      .def("table_bytes", [](const Solid& s) { return s.solid.bytes(); });
  nb::class_<Cache>(m, "Cache").def(nb::init<>());
  nb::class_<Prepared>(m, "PreparedVerified")
      .def(nb::init<nb::object, nb::object, Doubles, bool>(), "a"_a, "b"_a, "poses"_a,
           "selection"_a)
      .def("__call__", &Prepared::call, "(hit, time)");
  m.def("verified_many", &ask_many, "a"_a, "b"_a, "poses_a"_a, "poses_b"_a, "cache"_a.none(),
        "selection"_a, "threads"_a);
}

}  // namespace verified
