// Bullet's continuous convex casts as a C interface, which `baselines/bullet_casts.py` loads.
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
  return new casts::Question(options, pieces(points_a, sizes_a, n_a), pieces(points_b, sizes_b, n_b),
                             std::move(path));
}

void bullet_casts_free(casts::Question* question) { delete question; }

// 1 for a hit, whose time as a share of the step it leaves at `time`.
int bullet_casts_ask(casts::Question* question, double* time) {
  const casts::Answer answer = question->ask();
  *time = answer.time;
  return answer.hit;
}
}

// `lane` opens every plugin. It times none of the casts yet.
extern "C" void lane_engines(lane::Engines&) {}
