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

double radius(const casts::Points& points) {
  double far = 0;
  for (const auto& point : points) far = std::max(far, point.length());
  return far;
}

// A cast in the native lane, of translations, as the method of its name in bullet_casts.py asks it.
struct Cast : lane::Engine {
  casts::Options options;
  std::vector<casts::Question> questions;

  Cast(const char* name, casts::Kind kind) : Engine(name) { options.kind = kind; }

  bool answers(lane::Question question) const override {
    return question == lane::Question::translation;
  }

  // The units that a case is asked in.
  virtual double unit(const casts::Points&, const casts::Points&) const { return 1; }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& cases) override {
    for (const auto& c : cases) {
      auto a = points(bodies[c.a]), b = points(bodies[c.b]);
      const double u = unit(a, b);
      for (auto* body : {&a, &b})
        for (auto& point : *body) point *= u;
      questions.emplace_back(options, std::vector<casts::Points>{a}, std::vector<casts::Points>{b},
                             std::vector<casts::Leg>{leg(c, u)});
    }
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

  // B is at the origin, as in units.py.
  static casts::Leg leg(const lane::Case& c, double u) {
    const auto turn = [](const auto& q) { return btQuaternion(q[1], q[2], q[3], q[0]); };
    const auto vector = [](const auto& v) { return btVector3(v[0], v[1], v[2]); };
    const btVector3 at = u * (vector(c.pose_a.p) - vector(c.pose_b.p));
    const btTransform a(turn(c.pose_a.q), at), b(turn(c.pose_b.q), btVector3(0, 0, 0));
    return {a, btTransform(a.getBasis(), at + u * vector(c.displacement)), b, b};
  }
};

struct Exact final : Cast {
  const double length;

  Exact(const char* name, casts::Kind kind, int power, double margin)
      : Cast(name, kind), length(std::exp2(power)) {
    options.margin = margin;
    options.start_unit = 1 / length;
    options.halvings = 20;
  }

  double unit(const casts::Points& a, const casts::Points& b) const override {
    return std::exp2(std::round(std::log2(length / std::min(radius(a), radius(b)))));
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
  const auto add = [&](auto engine) { engines.push_back(std::move(engine)); };
  add(std::make_unique<Cast>("bullet-subsimplex-cast", Kind::subsimplex));
  add(std::make_unique<Cast>("bullet-gjk-cast", Kind::gjk));
  add(std::make_unique<Cast>("bullet-continuous-cast", Kind::continuous));
  add(std::make_unique<Exact>("bullet-subsimplex-cast-exact", Kind::subsimplex, 15, 0));
  add(std::make_unique<Exact>("bullet-gjk-cast-exact", Kind::gjk, 18, 0.001));
  add(std::make_unique<Exact>("bullet-continuous-cast-exact", Kind::continuous, 15, 0));
}
