// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// experiments.truth.prove._native: the prover's proposals. Nothing here is believed; the checker
// decides.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>

#include "prove.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using namespace truth;

using Array = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Faces = nb::ndarray<const int, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

// What enters is checked here, once for each body, whatever has been checked in Python.
constexpr size_t most_rows = 100'000'000;  // times three, an index of 32 bits still

static void require(bool fact, const char* words) {
  if (!fact) throw nb::value_error(words);
}
template <class Numbers>
static void check_finite(const Numbers& x, const char* words) {
  for (double c : x) require(std::isfinite(c), words);
}

static Vertices vertices_of(const Array& p) {
  require(p.shape(0) > 0 && p.shape(0) <= most_rows,
          "a body needs a vertex, and has too many at a hundred million");
  for (size_t i = 0; i < p.size(); ++i)
    require(std::isfinite(p.data()[i]), "vertices hold a number that is not finite");
  Vertices v(p.shape(0));
  for (size_t i = 0; i < v.size(); ++i) v[i] = {p(i, 0), p(i, 1), p(i, 2)};
  return v;
}

static void check_limit(double limit) {
  require(limit >= 0 && limit <= 1e15, "limit must lie in [0, 1e15]");
}

static nb::tuple pack(const Wide& w) {
  return nb::make_tuple(w.hi[0], w.hi[1], w.hi[2], w.lo[0], w.lo[1], w.lo[2]);
}
static nb::dict pack(const Common& c) {
  nb::dict out;
  out["point"] = pack(c.point);
  out["a"] = nb::make_tuple(c.piece_a, c.a[0], c.a[1], c.a[2], c.a[3]);
  out["b"] = nb::make_tuple(c.piece_b, c.b[0], c.b[1], c.b[2], c.b[3]);
  return out;
}
static nb::tuple pack(const Tree& tree,
                      int id = 0) {  // (segments, None or (side, cut, left, right))
  auto& node = tree.nodes[id];
  nb::list segments;
  for (auto& s : node.segments)
    segments.append(nb::make_tuple(s.end, std::string(1, s.frame), pack(s.n)));
  if (node.left < 0) return nb::make_tuple(segments, nb::none());
  return nb::make_tuple(segments, nb::make_tuple(std::string(1, node.side), node.cut,
                                                 pack(tree, node.left), pack(tree, node.right)));
}
static nb::dict pack(const Instant& i) {
  nb::dict out;
  out["label"] = i.label;
  if (i.label == "clear") out["gap"] = i.gap, out["tree"] = pack(i.tree);
  if (i.label == "hit") out["common"] = pack(i.common);
  return out;
}

NB_MODULE(_native, m) {
  nb::class_<Solid>(m, "Solid")
      .def_static("of_pieces",
                  [](const std::vector<Array>& pieces) {
                    require(!pieces.empty(), "a body needs a piece");
                    std::vector<Vertices> v;
                    for (auto& p : pieces) v.push_back(vertices_of(p));
                    return Solid(std::move(v));
                  })
      .def_static("of_mesh",
                  [](const Array& v, const Faces& f) {
                    require(f.shape(0) > 0 && f.shape(0) <= most_rows,
                            "a mesh needs a face, and has too many at a hundred million");
                    for (size_t i = 0; i < f.size(); ++i)
                      require(f.data()[i] >= 0 && size_t(f.data()[i]) < v.shape(0),
                              "faces name a vertex that is not there");
                    std::vector<std::array<int, 3>> faces(f.shape(0));
                    for (size_t i = 0; i < faces.size(); ++i)
                      faces[i] = {f(i, 0), f(i, 1), f(i, 2)};
                    return Solid(vertices_of(v), std::move(faces));
                  })
      .def_ro("order", &Solid::order);
  using Three = std::array<double, 3>;
  nb::class_<Mover>(m, "Mover")
      .def("__init__", [](Mover* self, std::array<double, 4> q, Three p, Three d, Three k,
                          double theta, Three about) {
        check_finite(q, "a quaternion holds a number that is not finite");
        require(q[0] || q[1] || q[2] || q[3], "a quaternion is zero, which is no rotation");
        for (auto& v : {p, d, k, about, Three{theta, 0, 0}})
          check_finite(v, "a motion holds a number that is not finite");
        new (self) Mover{q, p, d, k, theta, about};
      });
  nb::class_<Pair>(m, "Pair").def(
      "__init__", [](Pair* self, const Mover& a, const Mover& b) { new (self) Pair{a, b}; });
  nb::class_<Seed>(m, "Seed").def(
      "__init__", [](Seed* self, int number, double end) { new (self) Seed{number, end}; });
  m.def("instant", [](const Pair& pair, const Solid& A, const Solid& B, double t, double limit,
                      const Seeds& seeds) {
    require(t >= 0 && t <= 1, "t must lie in [0, 1]");
    check_limit(limit);
    Prover prover(pair, A, B, limit, seeds);
    Instant i = prover.at(t);
    auto out = pack(i);
    if (i.label == "hit") out["depth"] = prover.depth_at(t, i.common);
    out["spent"] = prover.effort().spent(), out["stuck"] = i.stuck;
    return out;
  });
  m.def("sweep",
        [](const Pair& pair, const Solid& A, const Solid& B, double limit, const Seeds& seeds) {
          check_limit(limit);
          Prover prover(pair, A, B, limit, seeds);
          Proof p = prover.sweep();
          nb::dict out;
          out["label"] = p.label, out["reason"] = p.reason, out["start"] = p.start,
          out["effort"] = prover.effort().done;
          out["stuck"] = p.stuck, out["spent"] = prover.effort().spent();
          out["t_lo"] = p.t_lo, out["t_hi"] = p.t_hi, out["gap"] = p.gap;
          if (p.label != "uncertain" && p.start == "clear") out["tree"] = pack(p.tree);
          if (p.label == "hit")
            out["common"] = pack(p.common), out["end"] = pack(p.end), out["depth"] = p.depth;
          return out;
        });
}
