// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Part of kernels_body.hpp, compiled once per instruction set under the same rules: the nearest
// faces to a point.
// Squared distances from a point to n points, n a multiple of block_faces.
template <class T>
OFG_INLINE void distances(const T* x, const T* y, const T* z, int n, const T* p, T* out) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  const auto px = all(p[0]), py = all(p[1]), pz = all(p[2]);
  for (int i = 0; i < n; i += w) {
    const auto dx = load(x + i) - px, dy = load(y + i) - py, dz = load(z + i) - pz;
    store(out + i, dx * dx + dy * dy + dz * dz);
  }
}

// Position of each of n in the order by distance, and of equals by face; n padded to whole
// registers.
template <class T>
OFG_INLINE void ranks(const T* d, const typename IntOf<T>::type* face, int n,
                      typename IntOf<T>::type* rank) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  using I = typename Lane<T>::I;
  int sum = 0;
  for (int i = 0; i < n; i += w) {
    const auto di = load(d + i);
    I r = {};
    for (int j = 0; j < n; ++j) r -= all(d[j]) < di;
    __builtin_memcpy(rank + i, &r, sizeof r);
    for (int l = 0; l < w; ++l) sum += i + l < n ? int(r[l]) : 0;
  }
  if (2 * sum == n * (n - 1)) return;  // no two are equal
  for (int i = 0; i < n; i += w) {
    const auto di = load(d + i);
    I fi, r;
    __builtin_memcpy(&fi, face + i, sizeof fi);
    __builtin_memcpy(&r, rank + i, sizeof r);
    for (int j = 0; j < n; ++j) r -= (all(d[j]) == di) & ((I{} + face[j]) < fi);
    __builtin_memcpy(rank + i, &r, sizeof r);
  }
}

// The k-th smallest of the distances in a block.
template <class T>
OFG_INLINE T kth(const T* d, int k) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  using I = typename Lane<T>::I;
  auto best = all(T(__builtin_huge_valf()));
  for (int i = 0; i < block_faces; i += w) {
    const auto di = load(d + i);
    I r = {};
    for (int j = 0; j < block_faces; ++j) r -= all(d[j]) <= di;
    const auto enough = r >= (I{} + k) ? di : all(T(__builtin_huge_valf()));
    best = enough < best ? enough : best;
  }
  return least_lane<T>(best);
}

// The k <= block_faces nearest faces to a point, nearest first, equal distances in the order of the
// faces. Blocks of faces whose box is farther than the k-th nearest in the best block are skipped.
// Returns the number of candidates left in `found`; if it is more than most_ranked they are not
// sorted, and the caller must.
template <class T>
static int nearest(const BlockView<T>& b, const T* p, int k, NearestScratch<T>& s,
                   Candidate<T>* found, int* evaluated) {
  using Int = typename IntOf<T>::type;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  if (b.blocks == 1) {
    Int rank[block_faces];
    T d[block_faces];
    distances(b.x, b.y, b.z, block_faces, p, d);
    ranks(d, b.face, b.faces, rank);
    for (int i = 0; i < b.faces; ++i)
      found[i].distance = d[i], found[i].face = int(b.face[i]);  // unchanged if NaNs have no rank
    for (int i = 0; i < b.faces; ++i)  // those beyond k are written to unused memory
      found[rank[i]].distance = d[i], found[rank[i]].face = int(b.face[i]);
    *evaluated = b.faces;
    return b.faces < k ? b.faces : k;
  }
  T limit = __builtin_huge_valf();
  int n = 0, listed = 0;
  *evaluated = b.blocks;
  {
    const auto px = all(p[0]), py = all(p[1]), pz = all(p[2]);
    int best = 0;
    auto low = all(T(__builtin_huge_valf()));
    // Squared distance to the block's box. Each rounding is monotone, so it never exceeds that of a
    // centre in the box.
    const typename Lane<T>::V zero = {};
    for (int i = 0; i < b.blocks; i += w) {
      auto dx = load(b.lo[0] + i) - px, ex = px - load(b.hi[0] + i);
      auto dy = load(b.lo[1] + i) - py, ey = py - load(b.hi[1] + i);
      auto dz = load(b.lo[2] + i) - pz, ez = pz - load(b.hi[2] + i);
      dx = dx > ex ? dx : ex, dy = dy > ey ? dy : ey, dz = dz > ez ? dz : ez;
      dx = dx > zero ? dx : zero, dy = dy > zero ? dy : zero, dz = dz > zero ? dz : zero;
      const auto bound = dx * dx + dy * dy + dz * dz;
      low = bound < low ? bound : low;
      store(s.bound + i, bound);
    }
    const T least = least_lane<T>(low);
    while (best < b.blocks - 1 && !(s.bound[best] == least)) ++best;
    distances(b.x + best * block_faces, b.y + best * block_faces, b.z + best * block_faces,
              block_faces, p, s.distance);
    limit = kth(s.distance, k);
    for (int i = 0; i < b.blocks; ++i) {
      s.list[listed] = i;
      listed += s.bound[i] <= limit;
    }
  }
  for (int l = 0; l < listed; ++l) {
    const int first = s.list[l] * block_faces;
    T d[block_faces];
    distances(b.x + first, b.y + first, b.z + first, block_faces, p, d);
    *evaluated += block_faces;
    const int here = b.faces - first < block_faces ? b.faces - first : block_faces;
    for (int i = 0; i < here; ++i) {
      s.distance[n] = d[i];
      s.face[n] = b.face[first + i];
      n += d[i] <= limit;
    }
  }
  if (n > most_ranked) {
    for (int i = 0; i < n; ++i) found[i].distance = s.distance[i], found[i].face = int(s.face[i]);
    return n;
  }
  for (int i = n; i < n + w; ++i) s.distance[i] = __builtin_huge_valf(), s.face[i] = 0;
  Int rank[most_ranked + block_faces];
  ranks(s.distance, s.face, n, rank);
  for (int i = 0; i < n; ++i) found[i].distance = s.distance[i], found[i].face = int(s.face[i]);
  for (int i = 0; i < n; ++i)  // those beyond k are written to unused memory
    found[rank[i]].distance = s.distance[i], found[rank[i]].face = int(s.face[i]);
  return n < k ? n : k;
}
