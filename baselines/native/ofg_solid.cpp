// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Verified Opposing Face Geometry of closed meshes and of unions, in each instruction set. Convex
// bodies are asked elsewhere.
#include "lane.hpp"
#include "ofg/verified_solid.hpp"

namespace {

std::vector<ofg::Vec3<double>> vertices_of(const lane::Body& body) {
  const auto& v = body.vertices;
  std::vector<ofg::Vec3<double>> all;
  for (std::size_t i = 0; i < v.size(); i += 3) all.emplace_back(v[i], v[i + 1], v[i + 2]);
  return all;
}

ofg::verified::Triangles faces_of(const lane::Body& body) {
  const auto& f = body.faces;
  ofg::verified::Triangles all;
  for (std::size_t i = 0; i < f.size(); i += 3) all.push_back({f[i], f[i + 1], f[i + 2]});
  return all;
}

struct Solids final : lane::Unions {
  const ofg::Isa kernels;
  std::vector<ofg::verified::Solid> bodies;
  std::vector<lane::Case> cases;
  std::vector<ofg::Pose> poses_a, poses_b;

  explicit Solids(ofg::Isa set) : Unions("ofg-verified"), kernels(set) {
    const char* const sets[] = {"SSE2", "AVX2", "AVX-512"};
    isa = sets[int(set)];
  }

  bool takes_meshes() const override { return true; }

  static ofg::Pose pose(const lane::Pose& p) {
    return {{p.q[0], p.q[1], p.q[2], p.q[3]}, {p.p[0], p.p[1], p.p[2]}};
  }

  static ofg::verified::Solid solid(const lane::Body& body) {
    if (body.pieces.empty()) return ofg::verified::Solid::closed(vertices_of(body), faces_of(body));
    ofg::verified::Hulls pieces;
    for (const auto& piece : body.pieces) pieces.emplace_back(vertices_of(piece), faces_of(piece));
    return ofg::verified::Solid(std::move(pieces));
  }

  void build(const std::vector<lane::Body>& all, const std::vector<lane::Case>& asked) override {
    for (const auto& body : all) bodies.push_back(solid(body));
    cases = asked;
    for (const auto& c : cases)
      poses_a.push_back(pose(c.pose_a)), poses_b.push_back(pose(c.pose_b));
  }

  // A set that the boxes have no kernel of takes the widest that they have.
  void turn() override { ofg::set_isa(kernels), ofg::set_boxes_isa(kernels); }

  lane::Verdict ask(std::size_t i) override {
    const auto &a = bodies[cases[i].a], &b = bodies[cases[i].b];
    return {ofg::verified::overlap(a, b, poses_a[i], poses_b[i]).hit};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  for (const auto isa : {ofg::Isa::sse2, ofg::Isa::avx2, ofg::Isa::avx512})
    if (ofg::set_isa(isa)) engines.push_back(std::make_unique<Solids>(isa));  // the machine has it
}
