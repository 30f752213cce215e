// Opposing Face Geometry from its own headers.
#include "ofg/ofg.hpp"

#include "lane.hpp"

namespace {

ofg::Pose pose(const lane::Pose& p) { return {{p.q[0], p.q[1], p.q[2], p.q[3]}, {p.p[0], p.p[1], p.p[2]}}; }

struct Ofg final : lane::Engine {
  ofg::Options options;
  std::vector<ofg::Body<double>> bodies;
  std::vector<lane::Case> cases;
  ofg::Workspace<double> workspace;

  Ofg(int k) : Engine("ofg k=" + std::to_string(k)) { options.k = k; }
  bool answers(lane::Question) const override { return true; }

  void build(const std::vector<lane::Body>& all, const std::vector<lane::Case>& asked) override {
    bodies.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      bodies[i].whole = ofg::Mesh<double>(all[i].vertices.data(), all[i].n(), all[i].faces.data(), all[i].m(), true);
      bodies[i].close();
    }
    cases = asked;
    for (const auto& c : cases) workspace.reserve(bodies[c.a], bodies[c.b]);
  }

  lane::Verdict ask(std::size_t i) override {
    const lane::Case& c = cases[i];
    const auto& [d, k] = std::pair(c.displacement, c.axis);
    const ofg::Track track(pose(c.pose_a), pose(c.pose_b), {{d[0], d[1], d[2]}, {k[0], k[1], k[2]}, c.angle}, {});
    const ofg::Answer x = c.question == lane::Question::overlap ? ofg::overlap(bodies[c.a], bodies[c.b], track, options, workspace)
                                                                : ofg::sweep(bodies[c.a], bodies[c.b], track, options, workspace);
    return {x.hit, x.time};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  for (int k : {4, 8, 16}) engines.push_back(std::make_unique<Ofg>(k));
}
