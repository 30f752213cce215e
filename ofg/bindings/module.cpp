// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Python's way into the core: arrays in, arrays out, the interpreter lock released while asking.
#include <nanobind/nanobind.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "given.hpp"
#include "ofg/article.hpp"
#include "ofg/batch.hpp"
#include "ofg/brute_force.hpp"
#include "returned.hpp"
#include "spheres.hpp"
#include "verified.hpp"
#include "verified_sweep.hpp"

namespace nb = nanobind;
using namespace nb::literals;

using namespace given;
using namespace returned;

namespace {

// A body in both precisions; in float only where its size is in float's range.
struct Solid {
  ofg::Body<double> fine;
  ofg::Body<float> coarse;
  bool has_coarse;

  Solid(Doubles v, Ints f, bool convex, const std::vector<Doubles>& pv,
        const std::vector<Ints>& pf) {
    check_mesh(v, f);
    require(pv.size() == pf.size(), "piece_vertices and piece_faces must be of one length");
    for (std::size_t i = 0; i < pv.size(); ++i) check_mesh(pv[i], pf[i]);
    double most = largest(v.data(), v.size());
    has_coarse = smallest_float <= most;
    for (const auto& piece : pv) most = std::fmax(most, largest(piece.data(), piece.size()));
    has_coarse &= most <= longest_float;
    fill(fine, v, f, convex, pv, pf);
    if (has_coarse) fill(coarse, v, f, convex, pv, pf);
  }

  void check(bool single) const {
    require(!single || has_coarse, "a body is too small or too large for single precision");
  }

  template <class T>
  static void fill(ofg::Body<T>& body, const Doubles& v, const Ints& f, bool convex,
                   const std::vector<Doubles>& pv, const std::vector<Ints>& pf) {
    body.whole = ofg::Mesh<T>(v.data(), v.shape(0), f.data(), f.shape(0), convex);
    for (std::size_t i = 0; i < pv.size(); ++i)
      body.pieces.emplace_back(pv[i].data(), pv[i].shape(0), pf[i].data(), pf[i].shape(0), true);
    body.close();
  }

  template <class T>
  const ofg::Body<T>& as() const {
    if constexpr (std::is_same_v<T, float>)
      return coarse;
    else
      return fine;
  }
};

enum class Algorithm { ofg, brute_force, article };

Algorithm algorithm_of(int how) {
  require(how >= 0 && how <= 2, "algorithm must be 0 (OFG), 1 (brute force) or 2 (the article)");
  return Algorithm(how);
}

void check_options(const ofg::Options& o) {
  const bool words = int(o.toi) >= 0 && int(o.toi) < 4 && int(o.order) >= 0 && int(o.order) < 2 &&
                     int(o.broad) >= 0 && int(o.broad) < 2 && int(o.concave) >= 0 &&
                     int(o.concave) < 3 && int(o.nearest) >= 0 && int(o.nearest) < 2;
  const bool numbers = o.k >= 1 && o.selection_times >= 1 && o.selection_times <= 3 &&
                       o.piece_times >= 1 && o.piece_times <= 3 && o.iterations >= 1 &&
                       o.iterations <= 60;
  require(words && numbers && o.arc_tolerance >= 0 && o.arc_tolerance < 1,
          "an option is out of range");
}

template <class T>
ofg::Answer ask(Algorithm how, bool moving, const Solid& a, const Solid& b, const ofg::Track& track,
                const ofg::Options& o, ofg::Workspace<T>& w) {
  const auto &ba = a.as<T>(), &bb = b.as<T>();
  if (how == Algorithm::brute_force)
    return moving ? ofg::brute_force::sweep(ba, bb, track)
                  : ofg::brute_force::overlap(ba, bb, track);
  if (how == Algorithm::article)
    return moving ? ofg::article::sweep(ba, bb, track, o, w)
                  : ofg::article::overlap(ba, bb, track, o, w);
  return moving ? ofg::sweep(ba, bb, track, o, w) : ofg::overlap(ba, bb, track, o, w);
}

// What the first query would otherwise do: no query allocates after it.
template <class T>
void make_ready(const ofg::Body<T>& a, const ofg::Body<T>& b, const ofg::Options& o,
                ofg::Workspace<T>& w) {
  w.reserve(a, b);
  if (o.screens()) a.make_tables(), b.make_tables();
}

ofg::Motion motion_of(const double* m) {
  return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, m[6], {m[7], m[8], m[9]}};
}

// One query, ready to be asked again and again: what a harness times.
struct Prepared {
  nb::object keep_a, keep_b;
  const Solid &a, &b;
  ofg::Pose pose_a, pose_b;
  ofg::Motion motion_a, motion_b;
  ofg::Options options;
  Algorithm how;
  bool moving, single;

  // One for all, so that the memory of a query is as warm as in a loop over many; the interpreter
  // lock is held while it is used.
  template <class T>
  static ofg::Workspace<T>& workspace() {
    static ofg::Workspace<T> shared;
    return shared;
  }

  Prepared(nb::object oa, nb::object ob, Doubles poses, Doubles motions, const ofg::Options& o,
           int how_, bool moving_, bool single_)
      : keep_a(oa),
        keep_b(ob),
        a(solid_of(oa)),
        b(solid_of(ob)),
        pose_a(pose_of(checked(poses, motions).data())),
        pose_b(pose_of(poses.data() + pose_columns)),
        motion_a(motion_of(motions.data())),
        motion_b(motion_of(motions.data() + motion_columns)),
        options(o),
        how(algorithm_of(how_)),
        moving(moving_),
        single(single_) {
    check_options(o);
    a.check(single), b.check(single);
    if (single)
      check_float(poses.data(), poses.data() + pose_columns, motions.data(),
                  motions.data() + motion_columns, 1);
    if (single)
      make_ready(a.coarse, b.coarse, options, workspace<float>());
    else
      make_ready(a.fine, b.fine, options, workspace<double>());
  }

  static const Solid& solid_of(nb::handle body) {
    require(nb::isinstance<Solid>(body), "a body must be a Solid of this module");
    return nb::cast<const Solid&>(body);
  }
  static const Doubles& checked(const Doubles& poses, const Doubles& motions) {
    check_poses(poses, 2, "poses");
    check_motions(motions, 2, "motions");
    return poses;
  }

  ofg::Answer answer() {
    const ofg::Track track(pose_a, pose_b, motion_a, motion_b);
    return single ? ask(how, moving, a, b, track, options, workspace<float>())
                  : ask(how, moving, a, b, track, options, workspace<double>());
  }
  nb::tuple call() {
    const ofg::Answer x = answer();
    return nb::make_tuple(x.hit, x.time);
  }
};

template <class T>
void ask_range(Algorithm how, bool moving, const Solid& a, const Solid& b, const double* pa,
               const double* pb, const double* ma, const double* mb, const ofg::Options& o,
               std::size_t from, std::size_t to, ofg::Answer* out) {
  ofg::Workspace<T> w;
  make_ready(a.as<T>(), b.as<T>(), o, w);
  if (how == Algorithm::ofg && !moving) {
    const auto *p = reinterpret_cast<const ofg::Pose*>(pa),
               *q = reinterpret_cast<const ofg::Pose*>(pb);
    ofg::overlap_many(a.as<T>(), b.as<T>(), p + from, q + from, to - from, o, w, out + from);
    return;
  }
  for (std::size_t i = from; i < to; ++i) {
    const ofg::Track track(pose_of(pa + pose_columns * i), pose_of(pb + pose_columns * i),
                           motion_of(ma + motion_columns * i), motion_of(mb + motion_columns * i));
    out[i] = ask(how, moving, a, b, track, o, w);
  }
}

nb::tuple ask_many(const Solid& a, const Solid& b, Doubles pa, Doubles pb, Doubles ma, Doubles mb,
                   const ofg::Options& o, int how, bool moving, bool single, int threads) {
  const std::size_t n = pa.shape(0);
  check_poses(pa, n, "poses_a"), check_poses(pb, n, "poses_b");
  check_motions(ma, n, "motions_a"), check_motions(mb, n, "motions_b");
  check_options(o);
  a.check(single), b.check(single);
  if (single) check_float(pa.data(), pb.data(), ma.data(), mb.data(), n);
  require(threads >= 1 && threads <= most_threads,
          "threads must be 1 to " + std::to_string(most_threads));
  const Algorithm algorithm = algorithm_of(how);
  std::vector<ofg::Answer> answers(n);
  {
    nb::gil_scoped_release released;
    const auto range = single ? ask_range<float> : ask_range<double>;
    in_parts(n, threads, [&](std::size_t from, std::size_t to) {
      range(algorithm, moving, a, b, pa.data(), pb.data(), ma.data(), mb.data(), o, from, to,
            answers.data());
    });
  }
  return in_arrays(answers);
}

}  // namespace

// Triangle against triangle, pair by pair: (n, 18) rows of six corners. For the tests.
template <class T>
nb::ndarray<nb::numpy, bool> triangles_meet(Doubles pairs) {
  check_width(pairs, 18, "pairs");
  check_finite(pairs, "pairs");
  bool* meet;
  auto out = array<bool>({pairs.shape(0)}, meet);
  for (std::size_t i = 0; i < pairs.shape(0); ++i) {
    const double* x = pairs.data() + 18 * i;
    T scale = 0;
    for (int j = 0; j < 18; ++j) scale = std::fmax(scale, std::abs(T(x[j])));
    const auto at = [&](int j) { return ofg::Vec3<T>(T(x[j]), T(x[j + 1]), T(x[j + 2])); };
    meet[i] = ofg::triangles_meet<T>({at(0), at(3), at(6)}, {at(9), at(12), at(15)}, scale);
  }
  return out;
}

// The support function by table, relative to the centre in units of the radius: a point per axis.
// For the tests.
nb::ndarray<nb::numpy, double> least_points(const Solid& solid, Doubles axes) {
  check_width(axes, 3, "axes");
  double* points;
  auto out = array<double>({axes.shape(0), 3}, points);
  for (std::size_t i = 0; i < axes.shape(0); ++i) {
    float v[3], p[3];
    for (int j = 0; j < 3; ++j) v[j] = float(axes.data()[3 * i + std::size_t(j)]);
    ofg::kernels<double>.extreme(solid.fine.whole.supports().view(), v, p);
    for (int j = 0; j < 3; ++j) points[3 * i + std::size_t(j)] = p[j];
  }
  return out;
}

// Bounds on how far vertices of A seen from B, and those of B that meet A seen from A, stray over a
// share of the step. For the tests.
nb::tuple strays(const Solid& a, const Solid& b, Doubles poses, Doubles motions, double share) {
  check_poses(poses, 2, "poses"), check_motions(motions, 2, "motions");
  require(share >= 0 && share <= 1, "share must lie in [0, 1]");
  const double *p = poses.data(), *m = motions.data();
  const ofg::Track track(pose_of(p), pose_of(p + pose_columns), motion_of(m),
                         motion_of(m + motion_columns));
  return nb::make_tuple(ofg::detail::stray(a.fine.whole, track, share),
                        ofg::detail::stray_of_b(a.fine.whole, b.fine.whole, track, share));
}

NB_MODULE(_core, m) {
  m.def(
      "set_isa",
      [](int isa) {
        require(isa >= 0 && isa <= 2, "isa must be 0 (SSE2), 1 (AVX2) or 2 (AVX-512)");
        return ofg::set_isa(ofg::Isa(isa)) && ofg::set_boxes_isa(ofg::Isa(isa));
      },
      "isa"_a, "0: SSE2, 1: AVX2, 2: AVX-512. False where the machine lacks it.");
  m.def("widest_isa", [] { return int(ofg::widest_isa()); });
  m.attr("build") = OFG_BUILD;
  m.def("triangles_meet", &triangles_meet<double>, "pairs"_a);
  m.def("triangles_meet_float", &triangles_meet<float>, "pairs"_a);
  m.def("least_points", &least_points, "solid"_a, "axes"_a);
  m.def("strays", &strays, "a"_a, "b"_a, "poses"_a, "motions"_a, "share"_a);
  nb::class_<Solid>(m, "Solid")
      .def(nb::init<Doubles, Ints, bool, const std::vector<Doubles>&, const std::vector<Ints>&>(),
           "vertices"_a, "faces"_a, "convex"_a, "piece_vertices"_a, "piece_faces"_a);
  nb::class_<ofg::Options>(m, "Options")
      .def(nb::init<>())
      .def_rw("k", &ofg::Options::k)
      .def_prop_rw(
          "toi", [](const ofg::Options& o) { return int(o.toi); },
          [](ofg::Options& o, int v) { o.toi = ofg::Toi(v); })
      .def_prop_rw(
          "broad", [](const ofg::Options& o) { return int(o.broad); },
          [](ofg::Options& o, int v) { o.broad = ofg::Broad(v); })
      .def_prop_rw(
          "concave", [](const ofg::Options& o) { return int(o.concave); },
          [](ofg::Options& o, int v) { o.concave = ofg::Concave(v); })
      .def_prop_rw(
          "nearest", [](const ofg::Options& o) { return int(o.nearest); },
          [](ofg::Options& o, int v) { o.nearest = ofg::Nearest(v); })
      .def_prop_rw(
          "order", [](const ofg::Options& o) { return int(o.order); },
          [](ofg::Options& o, int v) { o.order = ofg::Order(v); })
      .def_rw("iterations", &ofg::Options::iterations)
      .def_rw("end_moment", &ofg::Options::end_moment)
      .def_rw("piece_times", &ofg::Options::piece_times)
      .def_rw("adaptive_k", &ofg::Options::adaptive_k)
      .def_rw("both_vertices", &ofg::Options::both_vertices)
      .def_rw("edge_edge", &ofg::Options::edge_edge)
      .def_rw("selection_times", &ofg::Options::selection_times)
      .def_rw("arc_tolerance", &ofg::Options::arc_tolerance)
      .def_rw("containment", &ofg::Options::containment)
      .def_rw("earliest", &ofg::Options::earliest)
      .def_rw("screen", &ofg::Options::screen);
  verified::add_to(m);
  verified_sweep::add_to(m);
  spheres::add_to(m);
  nb::class_<Prepared>(m, "Prepared")
      .def(nb::init<nb::object, nb::object, Doubles, Doubles, const ofg::Options&, int, bool,
                    bool>(),
           "a"_a, "b"_a, "poses"_a, "motions"_a, "options"_a, "algorithm"_a, "moving"_a, "single"_a)
      .def("__call__", &Prepared::call, "(hit, time)");
  m.def("ask_many", &ask_many, "a"_a, "b"_a, "poses_a"_a, "poses_b"_a, "motions_a"_a, "motions_b"_a,
        "options"_a, "algorithm"_a, "moving"_a, "single"_a, "threads"_a);
}
