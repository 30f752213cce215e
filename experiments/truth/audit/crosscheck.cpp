// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// An independent judge in CGAL's exact kernel: reads pairs of solids with rational coordinates,
// says whether they meet (closed). Built by `python -m experiments.truth.audit.crosscheck`; no part
// of the package. Input: cases until the end of the file, each
//   case: solid solid     solid: "C" m, then m hulls as n and n points     or "M" n, n points, f, f
//   triangles of indices
// Output: a line "0" (apart) or "1" (meet or touch or one inside the other) per case.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <iostream>
#include <string>
#include <vector>

using K = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = K::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
namespace PMP = CGAL::Polygon_mesh_processing;

static K::FT number() {
  std::string s;
  std::cin >> s;
  return K::FT(typename K::FT::ET(s.c_str()));
}
static std::vector<Point> points() {
  int n;
  std::cin >> n;
  std::vector<Point> p;
  for (int i = 0; i < n; ++i) {
    auto x = number(), y = number(), z = number();
    p.emplace_back(x, y, z);
  }
  return p;
}
static std::vector<Mesh> solid() {  // the closed surfaces of a body's pieces
  std::string kind;
  std::cin >> kind;
  std::vector<Mesh> out;
  if (kind == "C") {
    int m;
    std::cin >> m;
    for (int i = 0; i < m; ++i) {
      auto p = points();
      Mesh hull;
      CGAL::convex_hull_3(p.begin(), p.end(), hull);
      out.push_back(hull);
    }
    return out;
  }
  auto p = points();
  int f;
  std::cin >> f;
  std::vector<std::vector<std::size_t>> faces(f, std::vector<std::size_t>(3));
  for (auto& t : faces) std::cin >> t[0] >> t[1] >> t[2];
  Mesh mesh;
  PMP::orient_polygon_soup(p, faces);
  PMP::polygon_soup_to_polygon_mesh(p, faces, mesh);
  out.push_back(mesh);
  return out;
}
static bool holds_part(const Mesh& outer, const Mesh& inner) {
  CGAL::Side_of_triangle_mesh<Mesh, K> side(outer);
  std::vector<Mesh> parts;
  PMP::split_connected_components(inner, parts);
  for (auto& part : parts)
    if (side(part.point(*part.vertices().begin())) != CGAL::ON_UNBOUNDED_SIDE) return true;
  return false;
}
static bool meet(const Mesh& a, const Mesh& b) {
  return PMP::do_intersect(a, b) || holds_part(a, b) || holds_part(b, a);
}

int main() {
  std::string word;
  while (std::cin >> word) {
    auto a = solid(), b = solid();
    bool any = false;
    for (auto& x : a)
      for (auto& y : b) any = any || meet(x, y);
    std::cout << any << std::endl;
  }
}
