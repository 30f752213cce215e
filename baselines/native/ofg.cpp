// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Opposing Face Geometry from its own headers, in each instruction set of the machine; and how far
// its steps take.
#include "ofg/ofg.hpp"

#include "lane.hpp"
#include "ofg/batch.hpp"

namespace {

ofg::Pose pose(const lane::Pose& p) {
  return {{p.q[0], p.q[1], p.q[2], p.q[3]}, {p.p[0], p.p[1], p.p[2]}};
}

// `Last`: the step after which it stops.
template <class T, int Last = 8>
struct Ofg final : lane::Engine {
  const ofg::Isa kernels;
  const ofg::Options options;
  std::vector<ofg::Body<T>> bodies;
  std::vector<lane::Case> cases;
  std::vector<ofg::Pose> poses_a, poses_b;
  std::vector<ofg::Answer> answered;
  ofg::Workspace<T> workspace;

  Ofg(const std::string& name, ofg::Isa set, const ofg::Options& o)
      : Engine(name), kernels(set), options(o) {
    const char* const sets[] = {"SSE2", "AVX2", "AVX-512"};
    isa = sets[int(set)];
  }

  // Undivided meshes are what adaptive k is for; without it they are asked in pieces, elsewhere.
  bool takes_meshes() const override { return options.adaptive_k; }
  bool answers(lane::Question question) const override {
    return Last == 8 || question == lane::Question::overlap;
  }
  bool stands(lane::Mode mode) const override {
    if (Last < 8) return mode == lane::Mode::warm;
    return mode != lane::Mode::batch || options.screen;
  }

  void build(const std::vector<lane::Body>& all, const std::vector<lane::Case>& asked) override {
    turn();
    bodies.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const lane::Body& body = all[i];
      bodies[i].whole =
          ofg::Mesh<T>(body.vertices.data(), body.n(), body.faces.data(), body.m(), body.convex);
      bodies[i].close();
    }
    cases = asked;
    answered.resize(cases.size());
    for (const auto& c : cases) {
      workspace.reserve(bodies[c.a], bodies[c.b]);
      if (options.screens()) bodies[c.a].make_tables(), bodies[c.b].make_tables();
      poses_a.push_back(pose(c.pose_a)), poses_b.push_back(pose(c.pose_b));
    }
  }

  void turn() override { ofg::set_isa(kernels); }

  lane::Verdict ask(std::size_t i) override {
    const lane::Case& c = cases[i];
    const ofg::Body<T>&a = bodies[c.a], &b = bodies[c.b];
    if (Last < 8) {
      const ofg::Track still(poses_a[i], poses_b[i]);
      return {ofg::overlap<Last>(a.whole, b.whole, still, options, workspace).hit};
    }
    const auto& [d, k] = std::pair(c.displacement, c.axis);
    const ofg::Motion motion{{d[0], d[1], d[2]}, {k[0], k[1], k[2]}, c.angle};
    const ofg::Track track(poses_a[i], poses_b[i], motion, {});
    const ofg::Answer x = c.question == lane::Question::overlap
                              ? ofg::overlap(a, b, track, options, workspace)
                              : ofg::sweep(a, b, track, options, workspace);
    return {x.hit, x.time};
  }

  void ask_many(std::size_t first, std::size_t n, lane::Verdict* verdicts) override {
    const lane::Case& c = cases[first];
    ofg::overlap_many(bodies[c.a], bodies[c.b], &poses_a[first], &poses_b[first], n, options,
                      workspace, answered.data());
    for (std::size_t i = 0; i < n; ++i) verdicts[i] = {answered[i].hit};
  }
};

ofg::Options faces(int k) {
  ofg::Options o;
  o.k = k;
  return o;
}

// ofg.REPAIRS: "all".
ofg::Options repaired() {
  ofg::Options o;
  o.nearest = ofg::Nearest::triangle;
  o.concave = ofg::Concave::all_pairs;
  o.adaptive_k = o.both_vertices = o.edge_edge = o.containment = o.end_moment = o.earliest = true;
  o.selection_times = o.piece_times = 3;
  o.arc_tolerance = 1e-6;
  return o;
}

ofg::Options screened(ofg::Options o) {
  o.screen = true;
  return o;
}

template <class T>
void engines_of(ofg::Isa isa, const std::string& precision, lane::Engines& engines) {
  const auto add = [&]<int Last>(std::integral_constant<int, Last>, const std::string& name,
                                 const ofg::Options& o) {
    engines.push_back(std::make_unique<Ofg<T, Last>>(name + precision, isa, o));
  };
  const std::integral_constant<int, 8> all;
  for (const int k : {4, 8, 16}) {
    const std::string name = "ofg k=" + std::to_string(k);
    add(all, name, faces(k));
    add(all, name + " screen=True", screened(faces(k)));
    add(std::integral_constant<int, 1>(), name + " to step 1", faces(k));
    add(std::integral_constant<int, 3>(), name + " to step 3", faces(k));
    add(std::integral_constant<int, 6>(), name + " to step 6", faces(k));
  }
  add(all, "ofg k=8 repairs=all", repaired());
  add(all, "ofg k=8 repairs=all screen=True", screened(repaired()));
}

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  for (const auto isa : {ofg::Isa::sse2, ofg::Isa::avx2, ofg::Isa::avx512}) {
    if (!ofg::set_isa(isa)) continue;  // the machine lacks it
    engines_of<double>(isa, "", engines);
    engines_of<float>(isa, " precision=float", engines);
  }
}
