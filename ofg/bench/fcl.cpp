#include <fcl/fcl.h>

#include "bench.hpp"

// Convex against convex, overlap alone, by both of its solvers; transforms are made beforehand.
std::vector<Timed> fcl_methods(const Cell& cell) {
  const auto shape = [](const Hull& h) {
    auto v = std::make_shared<std::vector<fcl::Vector3d>>();
    for (std::size_t i = 0; i < h.v.size(); i += 3) v->push_back({h.v[i], h.v[i + 1], h.v[i + 2]});
    auto f = std::make_shared<std::vector<int>>();
    for (std::size_t i = 0; i < h.f.size(); i += 3) f->insert(f->end(), {3, h.f[i], h.f[i + 1], h.f[i + 2]});
    return std::make_shared<fcl::Convexd>(v, int(h.f.size() / 3), f);
  };
  const auto a = shape(cell.a), b = shape(cell.b);
  auto poses = std::make_shared<std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>>>();
  for (std::size_t i = 0; i < cell.poses.size(); i += 7) {
    const double* p = &cell.poses[i];
    fcl::Transform3d t = fcl::Transform3d::Identity();
    t.linear() = fcl::Quaterniond(p[0], p[1], p[2], p[3]).normalized().toRotationMatrix();
    t.translation() = fcl::Vector3d(p[4], p[5], p[6]);
    poses->push_back(t);
  }
  std::vector<Timed> out;
  for (const auto solver : {fcl::GST_LIBCCD, fcl::GST_INDEP})
    out.push_back({solver == fcl::GST_LIBCCD ? "FCL libccd" : "FCL indep", [=](const Cell&) {
                     fcl::CollisionRequestd request(1, false);
                     request.gjk_solver_type = solver;
                     long hits = 0;
                     for (std::size_t i = 0; i < poses->size(); i += 2) {
                       fcl::CollisionResultd result;
                       hits += fcl::collide(a.get(), (*poses)[i], b.get(), (*poses)[i + 1], request, result) > 0;
                     }
                     return hits;
                   }});
  return out;
}
