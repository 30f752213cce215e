// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// What the core gives back to Python, and the threads that it asks with.
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <system_error>
#include <thread>
#include <vector>

#include "ofg/answer.hpp"
#include "ofg/motion.hpp"

namespace returned {

namespace nb = nanobind;

constexpr int most_threads = 256;
constexpr int columns = 9;

inline void count(const ofg::Counts& c, std::int64_t* to) {
  const std::int64_t all[columns] = {c.spheres,    c.distances,  c.face_pairs,
                                     c.edge_faces, c.edge_pairs, c.full_tests,
                                     c.evaluated,  c.steps,      c.growths};
  std::copy(all, all + columns, to);
}

inline ofg::Pose pose_of(const double* p) { return {{p[0], p[1], p[2], p[3]}, {p[4], p[5], p[6]}}; }

template <class T>
nb::ndarray<nb::numpy, T> array(std::vector<std::size_t> shape, T*& data) {
  std::size_t n = 1;
  for (auto s : shape) n *= s;
  data = new T[n ? n : 1];
  nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<T*>(p); });
  return nb::ndarray<nb::numpy, T>(data, shape.size(), shape.data(), owner);
}

// hit, time, found, faces, pieces, counts of n answers: the fields of ofg.Answers.
inline nb::tuple in_arrays(const std::vector<ofg::Answer>& answers) {
  const std::size_t n = answers.size();
  bool* hit;
  double* time;
  std::int8_t* found;
  std::int32_t *faces, *pieces;
  std::int64_t* counts;
  auto hits = array<bool>({n}, hit);
  auto times = array<double>({n}, time);
  auto founds = array<std::int8_t>({n}, found);
  auto all_faces = array<std::int32_t>({n, 2}, faces);
  auto all_pieces = array<std::int32_t>({n, 2}, pieces);
  auto all_counts = array<std::int64_t>({n, columns}, counts);
  for (std::size_t i = 0; i < n; ++i) {
    const ofg::Answer& x = answers[i];
    hit[i] = x.hit, time[i] = x.time, found[i] = std::int8_t(x.found);
    faces[2 * i] = x.face_a, faces[2 * i + 1] = x.face_b;
    pieces[2 * i] = x.piece_a, pieces[2 * i + 1] = x.piece_b;
    count(x.counts, counts + columns * i);
  }
  return nb::make_tuple(hits, times, founds, all_faces, all_pieces, all_counts);
}

// Calls range(from, to) for all of n in as many parts as there are to be threads.
template <class Range>
void in_parts(std::size_t n, int threads, Range range) {
  const std::size_t parts = std::min(std::size_t(threads), std::max<std::size_t>(n, 1));
  std::vector<std::thread> others;
  const auto part = [&](std::size_t i) { range(n * i / parts, n * (i + 1) / parts); };
  std::size_t started = 1;
  try {
    for (; started < parts; ++started) others.emplace_back(part, started);
  } catch (const std::system_error&) {
    // The machine has no more threads to give: this one does the rest.
  }
  part(0);
  for (std::size_t i = started; i < parts; ++i) part(i);
  for (auto& t : others) t.join();
}

}  // namespace returned
