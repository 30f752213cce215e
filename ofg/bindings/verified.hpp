// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Python's way to verified overlap.
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/stl/vector.h>

#include "given.hpp"
#include "ofg/verified_batch.hpp"
#include "ofg/verified_union.hpp"
#include "returned.hpp"

namespace verified {

namespace nb = nanobind;
using namespace nb::literals;
using given::Doubles;
using given::Ints;
using given::require;

// The convex pieces of a body.
struct Hulls {
  ofg::verified::Hulls pieces;

  Hulls(const std::vector<Doubles>& vertices, const std::vector<Ints>& faces) {
    require(vertices.size() == faces.size() && !vertices.empty(),
            "vertices and faces must be of one length, and not empty");
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
      pieces.emplace_back(std::move(points), triangles);
      require(!pieces.back().flat, "a piece is flat: its interior is empty");
    }
  }

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& piece : pieces) sum += piece.opposing.bytes();
    return sum;
  }
};

using Cache = ofg::verified::Cache;

inline ofg::verified::Parts parts_of(bool selection) {
  ofg::verified::Parts parts;
  parts.selection = selection;
  return parts;
}

inline nb::tuple ask_many(const Hulls& a, const Hulls& b, Doubles pa, Doubles pb, Cache* cache,
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
    if (a.pieces.size() == 1 && b.pieces.size() == 1 && !cache && selection) {
      static_assert(sizeof(ofg::Pose) == given::pose_columns * sizeof(double));
      const auto *u = reinterpret_cast<const ofg::Pose*>(p),
                 *v = reinterpret_cast<const ofg::Pose*>(q);
      ofg::verified::overlap_many(a.pieces[0], b.pieces[0], u + from, v + from, to - from,
                                  answers.data() + from);
      for (std::size_t i = from; i < to; ++i) answers[i].piece_a = answers[i].piece_b = 0;
      return;
    }
    for (std::size_t i = from; i < to; ++i)
      answers[i] =
          ofg::verified::overlap(a.pieces, b.pieces, returned::pose_of(p + given::pose_columns * i),
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
  const Hulls &a, &b;
  ofg::Pose pose_a, pose_b;
  ofg::verified::Parts parts;

  Prepared(nb::object oa, nb::object ob, Doubles poses, bool selection)
      : keep_a(oa), keep_b(ob), a(hulls_of(oa)), b(hulls_of(ob)), parts(parts_of(selection)) {
    given::check_poses(poses, 2, "poses");
    pose_a = returned::pose_of(poses.data());
    pose_b = returned::pose_of(poses.data() + given::pose_columns);
  }

  static const Hulls& hulls_of(nb::handle body) {
    require(nb::isinstance<Hulls>(body), "a body must be Hulls of this module");
    return nb::cast<const Hulls&>(body);
  }

  nb::tuple call() const {
    const ofg::Answer x =
        ofg::verified::overlap(a.pieces, b.pieces, pose_a, pose_b, nullptr, parts);
    return nb::make_tuple(x.hit, x.time);
  }
};

inline void add_to(nb::module_& m) {
  nb::class_<Hulls>(m, "Hulls")
      .def(nb::init<const std::vector<Doubles>&, const std::vector<Ints>&>(), "vertices"_a,
           "faces"_a)
      .def("inner", [](const Hulls& h) { return h.pieces[0].inner; })
      .def("table_bytes", &Hulls::bytes);
  nb::class_<Cache>(m, "Cache").def(nb::init<>());
  nb::class_<Prepared>(m, "PreparedVerified")
      .def(nb::init<nb::object, nb::object, Doubles, bool>(), "a"_a, "b"_a, "poses"_a,
           "selection"_a)
      .def("__call__", &Prepared::call, "(hit, time)");
  m.def("verified_many", &ask_many, "a"_a, "b"_a, "poses_a"_a, "poses_b"_a, "cache"_a.none(),
        "selection"_a, "threads"_a);
}

}  // namespace verified
