// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Bullet's continuous convex casts: a C interface, which `baselines/bullet_casts.py` loads, and
// engines of the native lane.
#include "casts.hpp"

#include <cstdint>

#include "lane.hpp"

namespace {

btTransform transform(const double* p) {  // position, then the quaternion (w, x, y, z)
  const btQuaternion turn(p[4], p[5], p[6], p[3]);
  return btTransform(turn.normalized(), btVector3(p[0], p[1], p[2]));
}

// sizes: the number of points of each of n pieces; points: all of them, 3 numbers each.
std::vector<casts::Points> pieces(const double* points, const std::int64_t* sizes, std::int64_t n) {
  std::vector<casts::Points> made(static_cast<std::size_t>(n));
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t k = 0; k < sizes[i]; ++k, points += 3)
      made[std::size_t(i)].emplace_back(points[0], points[1], points[2]);
  return made;
}

// A cast in the native lane, as the method of its name in bullet_casts.py asks it.
struct Cast final : lane::Engine {
  casts::Options options;
  const double leg_turn;  // the largest turn of one cast
  const bool exact;       // the start is tested, in bodies of radius 1
  std::vector<casts::Question> questions;

  Cast(const char* name, const casts::Options& o, double turn, bool e)
      : Engine(name), options(o), leg_turn(turn), exact(e) {}

  bool answers(lane::Question question) const override {
    return question == lane::Question::translation ||
           (question == lane::Question::motion && options.kind == casts::Kind::continuous);
  }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& cases) override {
    if (exact && length > 0) options.start_unit = 1 / length;
    for (const auto& c : cases)
      questions.emplace_back(options, std::vector<casts::Points>{points(bodies[c.a])},
                             std::vector<casts::Points>{points(bodies[c.b])}, legs(c));
  }

  lane::Verdict ask(std::size_t i) override {
    const auto [hit, time] = questions[i].ask();
    return {hit, hit ? time : std::nan("")};
  }

 private:
  static casts::Points points(const lane::Body& body) {
    casts::Points made;
    for (std::size_t i = 0; i < body.vertices.size(); i += 3)
      made.emplace_back(body.vertices[i], body.vertices[i + 1], body.vertices[i + 2]);
    return made;
  }

  static btTransform placed(const lane::Pose& p) {  // of length 1 already
    return btTransform(btQuaternion(p.q[1], p.q[2], p.q[3], p.q[0]),
                       btVector3(p.p[0], p.p[1], p.p[2]));
  }

  std::vector<casts::Leg> legs(const lane::Case& c) const {
    const int n = std::max(1, int(std::ceil(std::abs(c.angle) / leg_turn)));
    const btTransform b = placed(c.pose_b);
    std::vector<casts::Leg> path;
    for (int i = 0; i < n; ++i)
      path.push_back({placed(c.at(double(i) / n)), placed(c.at(double(i + 1) / n)), b, b});
    return path;
  }
};

}  // namespace

extern "C" {

int bullet_casts_version() { return btGetVersion(); }

// poses: 28 numbers a leg: A at its start and end, then B. The caller frees what he gets.
casts::Question* bullet_casts_make(int kind, double margin, double start_unit, int halvings,
                                   const double* points_a, const std::int64_t* sizes_a,
                                   std::int64_t n_a, const double* points_b,
                                   const std::int64_t* sizes_b, std::int64_t n_b,
                                   const double* poses, std::int64_t legs) {
  const casts::Options options{casts::Kind(kind), margin, start_unit, halvings};
  std::vector<casts::Leg> path;
  for (const double *p = poses, *end = poses + 28 * legs; p < end; p += 28)
    path.push_back({transform(p), transform(p + 7), transform(p + 14), transform(p + 21)});
  return new casts::Question(options, pieces(points_a, sizes_a, n_a),
                             pieces(points_b, sizes_b, n_b), std::move(path));
}

void bullet_casts_free(casts::Question* question) { delete question; }

// 1 for a hit, whose time as a share of the step it leaves at `time`.
int bullet_casts_ask(casts::Question* question, double* time) {
  const casts::Answer answer = question->ask();
  *time = answer.time;
  return answer.hit;
}
}

extern "C" void lane_engines(lane::Engines& engines) {
  using casts::Kind;
  constexpr double any = 1e300, eighth = M_PI / 4;  // turns
  const auto add = [&](const char* name, Kind kind, double margin, int halvings, double turn,
                       bool exact) {
    engines.push_back(
        std::make_unique<Cast>(name, casts::Options{kind, margin, 0, halvings}, turn, exact));
  };
  add("bullet-subsimplex-cast", Kind::subsimplex, -1, 0, any, false);
  add("bullet-gjk-cast", Kind::gjk, -1, 0, any, false);
  add("bullet-continuous-cast", Kind::continuous, -1, 0, any, false);
  add("bullet-subsimplex-cast-exact", Kind::subsimplex, 0, 0, any, true);
  add("bullet-gjk-cast-exact", Kind::gjk, 0.001, 0, any, true);
  add("bullet-continuous-cast-exact", Kind::continuous, 0, 20, eighth, true);
}
