// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Compiled once per instruction set: included by kernels.hpp inside a region with that target, with
// OFG_ISA as the namespace and OFG_BYTES as the width of its registers. No standard library here:
// the linker could keep an inline function of it compiled for AVX-512 as the copy for all.
// Every kernel performs the same roundings in the same order for each element at every width, and
// reduces by minimum only, so all instruction sets give the same answers to the last bit.
namespace ofg::OFG_ISA {

template <class T>
struct Lane;
template <>
struct Lane<double> {
  typedef double V __attribute__((vector_size(OFG_BYTES)));
  typedef double U __attribute__((vector_size(OFG_BYTES), aligned(8)));
  typedef long long I __attribute__((vector_size(OFG_BYTES)));
  typedef long long Int;
};
template <>
struct Lane<float> {
  typedef float V __attribute__((vector_size(OFG_BYTES)));
  typedef float U __attribute__((vector_size(OFG_BYTES), aligned(4)));
  typedef int I __attribute__((vector_size(OFG_BYTES)));
  typedef int Int;
};

#define OFG_INLINE static inline __attribute__((always_inline))

template <class T>
OFG_INLINE typename Lane<T>::V load(const T* p) {
  return *reinterpret_cast<const typename Lane<T>::U*>(p);
}
template <class T>
OFG_INLINE void store(T* p, typename Lane<T>::V v) {
  *reinterpret_cast<typename Lane<T>::U*>(p) = v;
}
template <class T>
OFG_INLINE typename Lane<T>::V all(T x) {
  typename Lane<T>::V v = {};
  return v + x;
}

// Halves against halves: by registers while there are two lanes of 16 bytes or more, then by
// shuffles.
template <class T>
OFG_INLINE T least_lane(typename Lane<T>::V v) {
  typedef T Quarter __attribute__((vector_size(16)));
  Quarter part[OFG_BYTES / 16];
  __builtin_memcpy(part, &v, sizeof v);
  for (int step = OFG_BYTES / 32; step > 0; step /= 2)
    for (int i = 0; i < step; ++i) part[i] = part[i + step] < part[i] ? part[i + step] : part[i];
  Quarter q = part[0];
  if constexpr (sizeof(T) == 4) {
    const Quarter r = {q[2], q[3], q[0], q[1]};
    q = r < q ? r : q;
  }
  return q[1] < q[0] ? q[1] : q[0];
}

#include "nearest_body.hpp"

// The least product of n points (a multiple of lanes) with an axis, and the first point that has
// it.
template <class T>
OFG_INLINE T least_product(const T* x, const T* y, const T* z, int n, const T* axis, int* at) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  using I = typename Lane<T>::I;
  const auto ax = all(axis[0]), ay = all(axis[1]), az = all(axis[2]);
  auto low = ax * load(x) + ay * load(y) + az * load(z);
  I here = {}, where = {};
  for (int i = w; i < n; i += w) {
    const auto v = ax * load(x + i) + ay * load(y + i) + az * load(z + i);
    here += w;
    where = v < low ? here : where;
    low = v < low ? v : low;
  }
  // Least of the lanes, then the first lane that has it.
  const T least = least_lane<T>(low);
  typename Lane<T>::Int first = 1 << 30;
  for (int l = 0; l < w; ++l) {
    const typename Lane<T>::Int i = low[l] == least ? where[l] + l : 1 << 30;
    first = i < first ? i : first;
  }
  *at = first < n ? int(first) : 0;  // no lane is least where numbers overflowed to NaN
  return least;
}

// The point of cloud a less the point of cloud b that is least along an axis.
template <class T>
static void support(const CloudView<T>& a, const CloudView<T>& b, const T* axis, T* difference) {
  const T back[3] = {-axis[0], -axis[1], -axis[2]};
  int i, j;
  least_product(a.x, a.y, a.z, a.n, axis, &i);
  least_product(b.x, b.y, b.z, b.n, back, &j);
  difference[0] = a.x[i] - b.x[j], difference[1] = a.y[i] - b.y[j], difference[2] = a.z[i] - b.z[j];
}

// The greatest squared distance of n points (a multiple of lanes) from a point.
template <class T>
static T farthest(const T* x, const T* y, const T* z, int n, const T* p) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  const auto px = all(p[0]), py = all(p[1]), pz = all(p[2]);
  typename Lane<T>::V most = {};
  for (int i = 0; i < n; i += w) {
    const auto dx = load(x + i) - px, dy = load(y + i) - py, dz = load(z + i) - pz,
               d = dx * dx + dy * dy + dz * dz;
    most = d > most ? d : most;
  }
  T far = most[0];
  for (int l = 1; l < w; ++l) far = most[l] > far ? most[l] : far;
  return far;
}

#include "triangles_body.hpp"

// Which of n boxes are apart from one box (lo, hi) by more than slack.
template <class T>
static void boxes_apart(const BoxView<T>& b, int n, const T* box, T slack, unsigned char* apart) {
  using I = typename Lane<T>::I;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  for (int i = 0; i < n; i += w) {
    I r = {};
    for (int j = 0; j < 3; ++j)
      r |=
          (load(b.lo[j] + i) > all(box[3 + j] + slack)) | (load(b.hi[j] + i) < all(box[j] - slack));
    for (int l = 0; l < w; ++l) apart[i + l] = r[l] != 0;
  }
}

// Points moved in place, n a multiple of lanes.
template <class T>
static void transform(T* x, T* y, T* z, int n, const T* m, const T* p) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  for (int i = 0; i < n; i += w) {
    const auto a = load(x + i), b = load(y + i), c = load(z + i);
    store(x + i, (m[0] * a + m[1] * b + m[2] * c) + p[0]);
    store(y + i, (m[3] * a + m[4] * b + m[5] * c) + p[1]);
    store(z + i, (m[6] * a + m[7] * b + m[8] * c) + p[2]);
  }
}

#include "portal_body.hpp"

#include "opposing_body.hpp"

#include "proving_body.hpp"

#include "extremes_body.hpp"

template <class T>
Kernels<T> kernels() {
  return {nearest<T>,    support<T>,       farthest<T>,    planes_apart<T>, edges_apart<T>,
          planes_gap<T>, segments_miss<T>, boxes_apart<T>, transform<T>,    extreme,
          reflect,       portal,           pose_pairs,     oppose,          prove,
          extremes<T>};
}

#undef OFG_INLINE
}  // namespace ofg::OFG_ISA
