// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The inner loops, compiled for each instruction set, and the choice between them at run time.
#pragma once
#include <cstdlib>
#include <cstring>
#include <vector>

#include "../triangle.hpp"

namespace ofg {

constexpr int block_faces = 16;  // faces in a block: one or two registers of the widest set
template <class T>
constexpr int lanes =
    64 / int(sizeof(T));          // arrays are padded to a multiple of the widest register
constexpr int most_ranked = 128;  // candidates up to which counting ranks beats sorting

template <class T>
struct Candidate {
  T distance;  // squared
  int face;
  bool operator<(const Candidate& c) const {
    return distance < c.distance || (distance == c.distance && face < c.face);
  }
};

template <class T>
struct IntOf;
template <>
struct IntOf<double> {
  using type = long long;
};
template <>
struct IntOf<float> {
  using type = int;
};

// Face centres in blocks of neighbours, each with a bounding box of its centres. Padding lies
// infinitely far away.
template <class T>
struct BlockView {
  const T *x, *y, *z;
  const typename IntOf<T>::type* face;
  const T *lo[3], *hi[3];  // of the blocks
  int faces, blocks;
};

// Memory for `nearest`, as for its `found`: as many entries as the mesh has padded faces, and some.
template <class T>
struct NearestScratch {
  T *bound, *distance;
  int* list;
  typename IntOf<T>::type* face;
};

// n points, a multiple of lanes.
template <class T>
struct CloudView {
  const T *x, *y, *z;
  int n;
};

template <class T>
struct TriangleView {
  const T* c[9];  // ax, ay, az, bx, ..., cz: an array each
};

template <class T>
struct BoxView {
  const T *lo[3], *hi[3];
};

constexpr int list_unit =
    16;  // points in a list of a SupportMap: a register of the widest set in single precision

// For each cell of a cube map of directions, side x side on each of six faces, lists of the points
// extreme there.
struct SupportView {
  const float* points;
  const int* first;  // list of each cell; then the end
  int side;
};

// Pairs of posed bodies, in B's frame relative to B's centre, in units of the sum of their radii.
constexpr int most_posed = 64;
struct PosedPairs {
  float r[9][most_posed];        // the rotation of A, times its radius; by rows
  float between[3][most_posed];  // the centre of A
  float size_b[most_posed];      // radius of B
  float gap[most_posed];         // that separates them; below zero: unused
};

// Input of PosedPairs about two bodies, and the gap that counts: rounding (1 + way) + slack
// (extents + way), the way in units of the sum of the radii first and then as it is.
struct PairOfBodies {
  double centre_a[3], centre_b[3], radius_a, radius_b, rounding, slack, extents;
};

// One pair as PosedPairs has it, and the vertices that oppose each other: list_unit of each body in
// units of its radius, in its axes.
struct OpposedPair {
  const float *patch_a, *patch_b;
  SupportView map_a, map_b;
  bool complete;  // no body has a vertex outside its patch
  bool whole;     // supports are those of the whole bodies from the start
  float r[9], between[3], size_b, gap;
  float inside[3];  // what leads from `between` to the start of the ray, inside A - B
};

// axis: of the plane that keeps them apart, or out of the portal. corners: of a portal that holds
// the origin, of A and of B each in its axes, as patches are. What was looked at: vertices of
// patches along an axis, portals, supports of the whole bodies, and how many of these objected.
struct Opposed {
  float axis[3], corners[3][6];
  int distances, portals, supports, growths;
};

// Of PosedPairs: 1 apart, 2 meeting, 0 not sure; the axis of what proved it; supports of the whole
// bodies.
struct Proved {
  unsigned char verdict[most_posed];
  float axis[3][most_posed];
  int supports[most_posed];
};

template <class T>
struct Kernels {
  int (*nearest)(const BlockView<T>&, const T* point, int k, NearestScratch<T>&,
                 Candidate<T>* found, int* evaluated);
  void (*support)(const CloudView<T>& a, const CloudView<T>& b, const T* axis, T* difference);
  T (*farthest)(const T* x, const T* y, const T* z, int n, const T* point);
  void (*planes_apart)(const TriangleView<T>&, int n, const T* triangle, T slack,
                       unsigned char* apart);
  bool (*edges_apart)(const T* s, const T* t, T slack, T* best);
  T (*planes_gap)(const TriangleView<T>&, int n, const CloudView<T>&, T* normal);
  void (*segments_miss)(const TriangleView<T>&, int n, const T* segment, T slack,
                        unsigned char* miss);
  void (*boxes_apart)(const BoxView<T>&, int n, const T* box, T slack, unsigned char* apart);
  void (*transform)(T* x, T* y, T* z, int n, const T* rows, const T* shift);
  void (*extreme)(const SupportView&, const float* axis, float* point);
  void (*reflect)(const SupportView& a, const SupportView& b, const PosedPairs&, int n, int axes,
                  unsigned char* verdict);
  void (*portal)(const SupportView& a, const SupportView& b, const PosedPairs&, int n,
                 unsigned char* verdict);
  void (*pose_pairs)(const PairOfBodies&, const double* poses_a, const double* poses_b, int n,
                     PosedPairs&);
  int (*oppose)(const OpposedPair&, Opposed&);
  void (*prove)(const SupportView& a, const SupportView& b, const PosedPairs&, int n,
                const float* inside, Proved&);
  void (*extremes)(const CloudView<T>& a, const T* axis_a, const CloudView<T>& b, const T* axis_b,
                   int* at);
};

}  // namespace ofg

#define OFG_ISA sse2
#define OFG_BYTES 16
#include "kernels_body.hpp"
#undef OFG_ISA
#undef OFG_BYTES

#if defined(__x86_64__) && defined(__GNUC__)
#define OFG_HAS_X86 1
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#define OFG_ISA avx2
#define OFG_BYTES 32
#include "kernels_body.hpp"
#undef OFG_ISA
#undef OFG_BYTES
#ifdef __clang__
#pragma clang attribute pop
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512dq,avx512bw"))), \
                             apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq,avx512bw")
#endif
#define OFG_ISA avx512
#define OFG_BYTES 64
#include "kernels_body.hpp"
#undef OFG_ISA
#undef OFG_BYTES
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

namespace ofg {

enum class Isa {
  sse2,
  avx2,
  avx512
};  // "sse2" is plain 16-byte vectors on machines that are not x86

inline Isa widest_isa() {
#ifdef OFG_HAS_X86
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    return Isa::avx512;
  if (__builtin_cpu_supports("avx2")) return Isa::avx2;
#endif
  return Isa::sse2;
}

template <class T>
Kernels<T> kernels_of(Isa isa) {
#ifdef OFG_HAS_X86
  if (isa == Isa::avx512) return avx512::kernels<T>();
  if (isa == Isa::avx2) return avx2::kernels<T>();
#endif
  (void)isa;
  return sse2::kernels<T>();
}

// The kernels in use: those of the widest instruction set of the machine, or those chosen by
// set_isa.
template <class T>
inline Kernels<T> kernels = kernels_of<T>(widest_isa());

// For tests and measurements; not while another thread runs queries. False if the machine lacks it.
inline bool set_isa(Isa isa) {
  if (int(isa) > int(widest_isa())) return false;
  kernels<float> = kernels_of<float>(isa);
  kernels<double> = kernels_of<double>(isa);
  return true;
}

}  // namespace ofg
