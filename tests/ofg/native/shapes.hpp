// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Random closed meshes for the native tests, from round ones to such as no modeller would own up
// to.
#pragma once
#include <cstdint>
#include <random>
#include <vector>

#include "ofg/ofg.hpp"

struct Shape {
  std::vector<double> v;
  std::vector<std::int32_t> f;
};

// A sphere of `rings` by `sides`, each vertex moved by `roughness`, scaled to a box.
inline Shape sphere(int rings, int sides, double roughness, double sx, double sy, double sz,
                    std::mt19937_64& random) {
  std::uniform_real_distribution<double> noise(1 - roughness, 1 + roughness);
  Shape s;
  const auto push = [&](double x, double y, double z) {
    const double r = noise(random);
    s.v.insert(s.v.end(), {x * r * sx, y * r * sy, z * r * sz});
  };
  push(0, 0, 1);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double t = 3.14159265358979 * i / rings, p = 6.28318530717959 * j / sides;
      push(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
    }
  push(0, 0, -1);
  const int last = 1 + (rings - 1) * sides;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * sides + j % sides; };
  for (int j = 0; j < sides; ++j) {
    s.f.insert(s.f.end(), {0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i)
      s.f.insert(s.f.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1),
                             at(i, j + 1)});
    s.f.insert(s.f.end(), {last, at(rings - 1, j + 1), at(rings - 1, j)});
  }
  return s;
}

template <class T>
ofg::Body<T> body(const Shape& s, bool convex) {
  ofg::Body<T> b;
  b.whole = ofg::Mesh<T>(s.v.data(), s.v.size() / 3, s.f.data(), s.f.size() / 3, convex);
  if (convex) b.pieces = {b.whole};
  b.close();
  return b;
}
