// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Counts what a query allocates once its workspace has been reserved: nothing. Prints the number.
#include <cstdio>
#include <cstdlib>
#include <new>

#include "shapes.hpp"

static long allocations = 0;
void* operator new(std::size_t n) {
  ++allocations;
  if (void* p = std::malloc(n ? n : 1)) return p;
  std::abort();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

template <class T>
long count() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  const ofg::Body<T> a = body<T>(sphere(12, 20, 0, 1, 1, 1, random), true),
                     b = body<T>(sphere(6, 9, 0.2, 2, 1, 0.3, random), false);
  ofg::Workspace<T> w;
  w.reserve(a, b);
  a.make_tables(), b.make_tables();
  ofg::Options repaired;
  repaired.nearest = ofg::Nearest::triangle, repaired.selection_times = 3,
  repaired.arc_tolerance = 1e-3;
  repaired.adaptive_k = repaired.both_vertices = repaired.edge_edge = repaired.containment =
      repaired.earliest = true;
  const long before = allocations;
  for (int i = 0; i < 200; ++i)
    for (int k : {1, 8, 40, 100000}) {
      ofg::Options written;
      written.k = k, written.toi = i % 2 ? ofg::Toi::velocity : ofg::Toi::bisection,
      written.concave = ofg::Concave(i % 3);
      const ofg::Pose p{{u(random), u(random), u(random), 1},
                        {2 * u(random), 2 * u(random), u(random)}},
          q{{1, u(random), 0, 0}, {}};
      const ofg::Motion m{
          {u(random), u(random), u(random)}, {u(random), 1, 0}, i % 4 ? u(random) : 0};
      for (const auto& o : {written, repaired}) {
        ofg::overlap(a, b, {p, q}, o, w);
        ofg::sweep(a, b, {p, q, m}, o, w);
      }
    }
  return allocations - before;
}

int main() {
  const long n = count<double>() + count<float>();
  std::printf("%ld\n", n);
  return n != 0;
}
