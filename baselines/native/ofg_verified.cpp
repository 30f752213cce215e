// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Verified Opposing Face Geometry from its own headers, in each instruction set of the machine; and
// the same without a selection of opposing vertices, as baselines/ofg_verified.py asks both.
#include <malloc.h>

#include <map>

#include "lane.hpp"
#include "ofg/ofg.hpp"
#include "ofg/verified_batch.hpp"

namespace {

namespace verified = ofg::verified;

ofg::Pose pose(const lane::Pose& p) {
  return {{p.q[0], p.q[1], p.q[2], p.q[3]}, {p.p[0], p.p[1], p.p[2]}};
}

long long allocated() {
  const auto now = mallinfo2();
  return static_cast<long long>(now.uordblks + now.hblkhd);
}

template <class Base>
struct Hulls : Base {
  const ofg::Isa kernels;
  verified::Parts parts;
  std::vector<verified::Hull> hulls;
  std::vector<lane::Case> cases;
  std::vector<ofg::Pose> poses_a, poses_b;
  long long size = -1;

  Hulls(const std::string& name, ofg::Isa set, bool selection) : Base(name), kernels(set) {
    const char* const sets[] = {"SSE2", "AVX2", "AVX-512"};
    this->isa = sets[int(set)];
    parts.selection = selection;
  }

  void turn() override { ofg::set_isa(kernels); }
  long long bytes() const override { return size; }
  bool refuses(std::size_t i) const override { return a(i).flat || b(i).flat; }

  void build(const std::vector<lane::Body>& all, const std::vector<lane::Case>& asked) override {
    turn();
    const long long before = allocated();
    hulls.reserve(all.size());
    for (const auto& x : all)
      hulls.emplace_back(
          ofg::Mesh<double>(x.vertices.data(), x.n(), x.faces.data(), x.m(), x.convex));
    size = allocated() - before;
    cases = asked;
    for (const auto& c : cases)
      poses_a.push_back(pose(c.pose_a)), poses_b.push_back(pose(c.pose_b));
  }

  const verified::Hull& a(std::size_t i) const { return hulls[cases[i].a]; }
  const verified::Hull& b(std::size_t i) const { return hulls[cases[i].b]; }

  lane::Verdict said(std::size_t i, verified::Cache* cache) const {
    return {verified::overlap(a(i), b(i), poses_a[i], poses_b[i], cache, parts).hit};
  }
};

struct Alone final : Hulls<lane::Engine> {
  std::vector<ofg::Answer> answered;

  using Hulls::Hulls;

  // A batch has no selection to leave out.
  bool stands(lane::Mode mode) const override {
    return mode != lane::Mode::batch || parts.selection;
  }

  void build(const std::vector<lane::Body>& all, const std::vector<lane::Case>& asked) override {
    Hulls::build(all, asked);
    answered.resize(cases.size());
  }

  lane::Verdict ask(std::size_t i) override { return said(i, nullptr); }

  void ask_many(std::size_t first, std::size_t n, lane::Verdict* verdicts) override {
    verified::overlap_many(a(first), b(first), &poses_a[first], &poses_b[first], n,
                           answered.data());
    for (std::size_t i = 0; i < n; ++i) verdicts[i] = {answered[i].hit};
  }
};

// With what the last answer about a pair proved.
struct Cached final : Hulls<lane::Remembering> {
  std::vector<verified::Cache> caches;  // of each pair of bodies
  std::vector<std::size_t> pair;        // of each case

  using Hulls::Hulls;

  void build(const std::vector<lane::Body>& all, const std::vector<lane::Case>& asked) override {
    Hulls::build(all, asked);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> pairs;
    for (const auto& c : cases)
      pair.push_back(pairs.try_emplace({c.a, c.b}, pairs.size()).first->second);
    caches.resize(pairs.size());
  }

  void forget() override {
    for (auto& cache : caches) cache = {};
  }

  lane::Verdict ask(std::size_t i) override { return said(i, &caches[pair[i]]); }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  for (const auto isa : {ofg::Isa::sse2, ofg::Isa::avx2, ofg::Isa::avx512}) {
    if (!ofg::set_isa(isa)) continue;  // the machine lacks it
    for (const bool selection : {true, false}) {
      const std::string name = selection ? "ofg-verified" : "ofg-mpr";
      engines.push_back(std::make_unique<Alone>(name, isa, selection));
      engines.push_back(std::make_unique<Cached>(name + ", cache", isa, selection));
    }
  }
}
