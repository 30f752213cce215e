// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// parry in doubles, through the C interface of the crate beside this file.
#include <cstddef>

#include "lane.hpp"

extern "C" {
struct ParryShape;
struct ParryManifolds;
ParryShape* parry_hull(const double* vertices, std::size_t n);
ParryShape* parry_mesh(const double* vertices, std::size_t n, const std::uint32_t* faces,
                       std::size_t m);
ParryShape* parry_compound(const double* const* vertices, const std::size_t* n, std::size_t pieces);
void parry_free(ParryShape*);
bool parry_overlap(const ParryShape* a, const lane::Pose* at, const ParryShape* b,
                   const lane::Pose* bt);
double parry_cast(const ParryShape* a, const lane::Pose* at, const double* d, const ParryShape* b,
                  const lane::Pose* bt);
double parry_cast_nonlinear(const ParryShape* a, const lane::Pose* at, const double* d,
                            const double* turn, const ParryShape* b, const lane::Pose* bt);
ParryManifolds* parry_manifolds();
void parry_manifolds_free(ParryManifolds*);
bool parry_manifolds_overlap(ParryManifolds*, const ParryShape* a, const lane::Pose* at,
                             const ParryShape* b, const lane::Pose* bt);
}

namespace {

template <class Base>
struct Shapes : Base {
  const bool mesh;
  std::vector<ParryShape*> shapes;
  std::vector<lane::Case> cases;

  Shapes(const char* name, bool m) : Base(name), mesh(m) {}
  ~Shapes() override {
    for (auto* shape : shapes)
      if (shape) parry_free(shape);
  }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    for (const auto& body : bodies) {
      const auto* faces = reinterpret_cast<const std::uint32_t*>(body.faces.data());
      shapes.push_back(mesh ? parry_mesh(body.vertices.data(), body.n(), faces, body.m())
                            : parry_hull(body.vertices.data(), body.n()));
    }
    cases = asked;
  }

  // Of some points parry makes no hull.
  bool refuses(std::size_t i) const override { return !a(i) || !b(i); }

  ParryShape* a(std::size_t i) const { return shapes[cases[i].a]; }
  ParryShape* b(std::size_t i) const { return shapes[cases[i].b]; }

  lane::Verdict ask(std::size_t i) override {
    return {parry_overlap(a(i), &cases[i].pose_a, b(i), &cases[i].pose_b)};
  }
};

struct Compounds final : Shapes<lane::Unions> {
  explicit Compounds(const char* name) : Shapes(name, false) {}

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    for (const auto& body : bodies) {
      std::vector<const double*> vertices;
      std::vector<std::size_t> n;
      for (const auto& piece : body.pieces)
        vertices.push_back(piece.vertices.data()), n.push_back(piece.n());
      shapes.push_back(parry_compound(vertices.data(), n.data(), n.size()));
    }
    cases = asked;
  }
};

struct Cast final : Shapes<lane::Engine> {
  std::vector<std::array<double, 3>> turns;

  Cast() : Shapes("parry-cast", false) {}
  bool answers(lane::Question question) const override {
    return question != lane::Question::overlap;
  }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    Shapes::build(bodies, asked);
    for (const auto& c : cases)
      turns.push_back({c.angle * c.axis[0], c.angle * c.axis[1], c.angle * c.axis[2]});
  }

  lane::Verdict ask(std::size_t i) override {
    const lane::Case& c = cases[i];
    const double time = c.question == lane::Question::translation
                            ? parry_cast(a(i), &c.pose_a, c.displacement.data(), b(i), &c.pose_b)
                            : parry_cast_nonlinear(a(i), &c.pose_a, c.displacement.data(),
                                                   turns[i].data(), b(i), &c.pose_b);
    return {time >= 0, time >= 0 ? time : std::nan("")};
  }
};

// What its narrow phase does with a pair that stays near: manifolds that start from the last ones.
struct Kept final : Shapes<lane::Remembering> {
  ParryManifolds* manifolds = parry_manifolds();

  explicit Kept(const char* name) : Shapes(name, false) {}
  ~Kept() override { parry_manifolds_free(manifolds); }

  void forget() override {
    parry_manifolds_free(manifolds);
    manifolds = parry_manifolds();
  }

  lane::Verdict ask(std::size_t i) override {
    return {parry_manifolds_overlap(manifolds, a(i), &cases[i].pose_a, b(i), &cases[i].pose_b)};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Shapes<lane::Engine>>("parry", false));
  engines.push_back(std::make_unique<Shapes<lane::Engine>>("parry-exact", false));
  engines.push_back(std::make_unique<Shapes<lane::Surfaces>>("parry-mesh", true));
  engines.push_back(std::make_unique<Compounds>("parry"));
  engines.push_back(std::make_unique<Cast>());
  engines.push_back(std::make_unique<Kept>("parry, kept manifold"));
  engines.push_back(std::make_unique<Kept>("parry-exact, kept manifold"));
}
