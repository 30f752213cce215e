// parry in doubles, through the C interface of the crate beside this file.
#include <cstdio>
#include <cstdlib>

#include "lane.hpp"

extern "C" {
struct ParryShape;
ParryShape* parry_hull(const double* vertices, std::size_t n);
ParryShape* parry_mesh(const double* vertices, std::size_t n, const std::uint32_t* faces, std::size_t m);
void parry_free(ParryShape*);
bool parry_overlap(const ParryShape* a, const lane::Pose* at, const ParryShape* b, const lane::Pose* bt);
double parry_cast(const ParryShape* a, const lane::Pose* at, const double* d, const ParryShape* b, const lane::Pose* bt);
double parry_cast_nonlinear(const ParryShape* a, const lane::Pose* at, const double* d, const double* turn, const ParryShape* b, const lane::Pose* bt);
}

namespace {

struct Parry final : lane::Engine {
  const bool cast, mesh;
  std::vector<ParryShape*> shapes;
  std::vector<lane::Case> cases;
  std::vector<std::array<double, 3>> turns;

  Parry(const char* name, bool c, bool m) : Engine(name), cast(c), mesh(m) {}
  ~Parry() override {
    for (auto* shape : shapes) parry_free(shape);
  }
  bool answers(lane::Question question) const override { return cast == (question != lane::Question::overlap); }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    for (const auto& body : bodies) {
      const auto* faces = reinterpret_cast<const std::uint32_t*>(body.faces.data());
      shapes.push_back(mesh ? parry_mesh(body.vertices.data(), body.n(), faces, body.m()) : parry_hull(body.vertices.data(), body.n()));
      if (!shapes.back()) std::fprintf(stderr, "lane: parry makes no shape of a body\n"), std::exit(2);
    }
    cases = asked;
    for (const auto& c : cases) turns.push_back({c.angle * c.axis[0], c.angle * c.axis[1], c.angle * c.axis[2]});
  }

  lane::Verdict ask(std::size_t i) override {
    const lane::Case& c = cases[i];
    const auto *a = shapes[c.a], *b = shapes[c.b];
    if (c.question == lane::Question::overlap) return {parry_overlap(a, &c.pose_a, b, &c.pose_b)};
    const double time = c.question == lane::Question::translation
                            ? parry_cast(a, &c.pose_a, c.displacement.data(), b, &c.pose_b)
                            : parry_cast_nonlinear(a, &c.pose_a, c.displacement.data(), turns[i].data(), b, &c.pose_b);
    return {time >= 0, time >= 0 ? time : std::nan("")};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Parry>("parry", false, false));
  engines.push_back(std::make_unique<Parry>("parry-mesh", false, true));
  engines.push_back(std::make_unique<Parry>("parry-cast", true, false));
}
