// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Verified Opposing Face Geometry of closed surfaces, in each instruction set of its boxes. Convex
// bodies are asked as surfaces too, as by the other engines' meshes.
#include "lane.hpp"
#include "ofg/verified_solid.hpp"

namespace {

struct Solids final : lane::Surfaces {
  const ofg::Isa kernels;
  std::vector<ofg::verified::Solid> bodies;
  std::vector<lane::Case> cases;
  std::vector<ofg::Pose> poses_a, poses_b;

  explicit Solids(ofg::Isa set) : Surfaces("ofg-verified-mesh"), kernels(set) {
    isa = set == ofg::Isa::sse2 ? "SSE2" : "AVX2";
  }

  static ofg::Pose pose(const lane::Pose& p) {
    return {{p.q[0], p.q[1], p.q[2], p.q[3]}, {p.p[0], p.p[1], p.p[2]}};
  }

  static ofg::verified::Solid solid(const lane::Body& body) {
    const auto& v = body.vertices;
    const auto& f = body.faces;
    std::vector<ofg::Vec3<double>> vertices;
    ofg::verified::Triangles faces;
    for (std::size_t i = 0; i < v.size(); i += 3) vertices.emplace_back(v[i], v[i + 1], v[i + 2]);
    for (std::size_t i = 0; i < f.size(); i += 3) faces.push_back({f[i], f[i + 1], f[i + 2]});
    return ofg::verified::Solid::closed(std::move(vertices), std::move(faces));
  }

  void build(const std::vector<lane::Body>& all, const std::vector<lane::Case>& asked) override {
    for (const auto& body : all) bodies.push_back(solid(body));
    cases = asked;
    for (const auto& c : cases)
      poses_a.push_back(pose(c.pose_a)), poses_b.push_back(pose(c.pose_b));
  }

  void turn() override { ofg::set_isa(kernels), ofg::set_boxes_isa(kernels); }

  lane::Verdict ask(std::size_t i) override {
    const auto &a = bodies[cases[i].a], &b = bodies[cases[i].b];
    return {ofg::verified::overlap(a, b, poses_a[i], poses_b[i]).hit};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  for (const auto isa : {ofg::Isa::sse2, ofg::Isa::avx2})
    if (ofg::set_isa(isa)) engines.push_back(std::make_unique<Solids>(isa));
}
