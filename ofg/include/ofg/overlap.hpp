// Discrete OFG: do two meshes meet at one pair of poses? Steps numbered as in the article.
#pragma once
#include "containment.hpp"
#include "selection.hpp"

namespace ofg {
namespace detail {

// Bound on the coordinates, in B's frame, of all that is tested.
template <class T>
T scale_of(const Mesh<T>& a, const Mesh<T>& b, const Vec3<T>& p) {
  return std::fmax(a.extent + length(p), b.extent);
}

inline bool spheres_apart(const Vec3<double>& between, double sum) { return dot(between, between) > sum * sum; }

// Step 8: face against face, the nearest first, until two meet. After the first row, one plane between the two selections
// settles all other pairs, if there is one; the planes of the faces settle most of what is left.
template <class T>
bool faces_meet(const Selection<T>& a, const Selection<T>& b, T scale, Workspace<T>& w, Answer& answer) {
  const T slack = rounding<T> * scale;
  const TriangleView<T> faces = b.view();
  for (int i = 0; i < a.size(); ++i) {
    if (i == 1) {
      Vec3<T> axis = a.triangle(0).a - b.triangle(0).a;
      const auto least = [&](const Vec3<T>& v) { return a.least(v, w.scratch.data(), 0, 1) - b.least(-v, w.scratch.data(), 0, 1); };
      if (separated(axis, 4 * slack, least)) {
        answer.counts.face_pairs += std::int64_t(a.size() - 1) * b.size();
        return false;
      }
    }
    const Triangle<T> t = a.triangle(i);
    const T corners[9] = {t.a.x, t.a.y, t.a.z, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z};
    kernels<T>.planes_apart(faces, b.padded(), corners, slack, w.flags.data());
    for (int j = 0; j < b.size(); ++j) {
      ++answer.counts.face_pairs;
      if (w.flags[std::size_t(j)]) continue;
      ++answer.counts.full_tests;
      if (!triangles_meet(t, b.triangle(j), scale)) continue;
      answer.face_a = a.near[std::size_t(i)].face, answer.face_b = b.near[std::size_t(j)].face;
      return true;
    }
  }
  return false;
}

template <class T>
bool holds(const Mesh<T>& a, const Mesh<T>& b, const Transform<T>& a_to_b, const Options& o, Answer& answer) {
  if (!o.containment || !one_inside_other(a, b, a_to_b)) return false;
  answer.found = Found::inside;
  return true;
}

}  // namespace detail

// Convex or not, `a` and `b` are tested as surfaces (with `containment` as solids). Does not allocate once `w` has room for both.
template <class T>
Answer overlap(const Mesh<T>& a, const Mesh<T>& b, const Track& track, const Options& o, Workspace<T>& w) {
  Answer answer;
  Counts& counts = answer.counts;
  counts.spheres = counts.steps = 1;
  const Transform<double> pose = track.at(0);
  const Vec3<double> apart = pose(Vec3<double>(a.centre)) - Vec3<double>(b.centre);
  const double slack = rounding<T> * (length(pose.p) + a.extent + b.extent);
  if (detail::spheres_apart(apart, double(a.radius) + double(b.radius) + slack)) return answer;  // 1
  const Transform<T> to_b(pose), to_a(pose.inverse());
  if (detail::holds(a, b, to_b, o, answer)) {
    answer.hit = true;
    return answer;
  }
  const Vec3<T> centre_b = to_a(b.centre);
  select(a, &centre_b, 1, o, b.radius, w, w.a, counts);  // 2, 3, 7
  const Vec3<T> centre_a = to_b(w.a.centre);
  select(b, &centre_a, 1, o, w.a.radius, w, w.b, counts);  // 4, 5, 7
  ++counts.spheres;
  if (detail::spheres_apart(Vec3<double>(centre_a - w.b.centre), double(w.a.radius) + double(w.b.radius) + slack)) return answer;  // 6
  gather(a, to_b, w.a);
  gather(b, w.b);
  answer.hit = detail::faces_meet(w.a, w.b, detail::scale_of(a, b, to_b.p), w, answer);  // 8
  if (answer.hit) answer.found = Found::start;
  return answer;
}

}  // namespace ofg
