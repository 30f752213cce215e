// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The case file that baselines/native/casefile.py writes: little-endian, no padding.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

#include "lane.hpp"

namespace lane {

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "lane: %s\n", what.c_str());
  std::exit(2);
}

struct CaseFile {
  std::vector<Body> bodies;
  std::vector<Case> cases;
  std::uint32_t block;                    // so many cases, one after the other, are timed together
  std::map<std::string, double> lengths;  // of methods that are asked in a unit of their own
};

namespace detail {

struct Reader {
  std::ifstream in;
  template <class T>
  T one() {
    T x;
    many(&x, 1);
    return x;
  }
  template <class T>
  void many(T* to, std::size_t n) {
    if (!in.read(reinterpret_cast<char*>(to), std::streamsize(n * sizeof(T))))
      fail("the case file ends too early; write it anew.");
  }
};

inline void to_length_1(double* v, std::size_t n) {
  double square = 0;
  for (std::size_t i = 0; i < n; ++i) square += v[i] * v[i];
  if (square > 0)
    for (std::size_t i = 0; i < n; ++i) v[i] /= std::sqrt(square);
}

inline Pose read_pose(Reader& r) {
  Pose pose;
  r.many(pose.q.data(), 4);
  r.many(pose.p.data(), 3);
  to_length_1(pose.q.data(), 4);
  return pose;
}

inline Body read_body(Reader& r) {
  Body body;
  body.vertices.resize(3 * std::size_t(r.one<std::uint32_t>()));
  body.faces.resize(3 * std::size_t(r.one<std::uint32_t>()));
  body.convex = r.one<std::uint32_t>();
  const auto pieces = r.one<std::uint32_t>();
  body.radius = r.one<double>();
  r.many(body.vertices.data(), body.vertices.size());
  r.many(body.faces.data(), body.faces.size());
  for (std::uint32_t i = 0; i < pieces; ++i) body.pieces.push_back(read_body(r));
  return body;
}

inline Case read_case(Reader& r, std::size_t bodies) {
  Case c;
  c.a = r.one<std::uint32_t>(), c.b = r.one<std::uint32_t>();
  c.question = Question(r.one<std::uint32_t>());
  if (c.a >= bodies || c.b >= bodies)
    fail("a case names a body that is not in the file; write it anew.");
  c.pose_a = read_pose(r), c.pose_b = read_pose(r);
  r.many(c.displacement.data(), 3);
  r.many(c.axis.data(), 3);
  to_length_1(c.axis.data(), 3);
  c.angle = r.one<double>();
  return c;
}

}  // namespace detail

inline CaseFile read_case_file(const char* path) {
  detail::Reader r{std::ifstream(path, std::ios::binary)};
  if (!r.in) fail(std::string("case file ") + path + " cannot be read.");
  char magic[8];
  r.many(magic, 8);
  if (std::string(magic, 8) != "OFGLANE3")
    fail(std::string(path) + " is no case file of this native lane; baselines.native writes them.");
  CaseFile file;
  const auto bodies = r.one<std::uint32_t>(), cases = r.one<std::uint32_t>();
  file.block = r.one<std::uint32_t>();
  for (auto lengths = r.one<std::uint32_t>(); lengths; --lengths) {
    std::string name(r.one<std::uint32_t>(), ' ');
    r.many(name.data(), name.size());
    file.lengths[name] = r.one<double>();
  }
  for (std::uint32_t i = 0; i < bodies; ++i) file.bodies.push_back(detail::read_body(r));
  for (std::uint32_t i = 0; i < cases; ++i) file.cases.push_back(detail::read_case(r, bodies));
  if (!file.block || cases % file.block)
    fail(std::string(path) + " holds no whole number of blocks; write it anew.");
  return file;
}

}  // namespace lane
