// Compiled once per instruction set: included by kernels.hpp inside a region with that target, with OFG_ISA naming the namespace
// and OFG_BYTES the width of its registers. No standard library here: an inline function of it compiled for AVX-512 could
// be the copy that the linker keeps for all.
//
// Every kernel does the same roundings in the same order for each element whatever the width, and reduces by minimum only, so all
// instruction sets give the same answers to the last bit.
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
OFG_INLINE typename Lane<T>::V load(const T* p) { return *reinterpret_cast<const typename Lane<T>::U*>(p); }
template <class T>
OFG_INLINE void store(T* p, typename Lane<T>::V v) { *reinterpret_cast<typename Lane<T>::U*>(p) = v; }
template <class T>
OFG_INLINE typename Lane<T>::V all(T x) {
  typename Lane<T>::V v = {};
  return v + x;
}

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

// Position of each of n in the order by (distance, face); n a multiple of the width.
template <class T>
OFG_INLINE void ranks(const T* d, const typename Lane<T>::Int* face, int n, int used, typename Lane<T>::Int* rank) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  using I = typename Lane<T>::I;
  for (int i = 0; i < n; i += w) {
    const auto di = load(d + i);
    I fi, r = {};
    __builtin_memcpy(&fi, face + i, sizeof fi);
    for (int j = 0; j < used; ++j) {
      const auto dj = all(d[j]);
      const I fj = I{} + face[j];
      r -= (dj < di) | ((dj == di) & (fj < fi));
    }
    __builtin_memcpy(rank + i, &r, sizeof r);
  }
}

// The k <= block_faces nearest faces to a point, nearest first, equal distances in the order of the faces. Blocks of faces whose
// box is farther than the k-th nearest in the best block are not looked at. Returns the number of candidates left in
// `found`; if it is more than most_ranked they are not sorted, and the caller must.
template <class T>
static int nearest(const BlockView<T>& b, const T* p, int k, NearestScratch<T>& s, Candidate<T>* found, int* evaluated) {
  using Int = typename Lane<T>::Int;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  T limit = __builtin_huge_valf();
  int n = 0, listed = 1;
  s.list[0] = 0;
  *evaluated = b.blocks > 1 ? b.blocks : 0;
  if (b.blocks > 1) {
    const auto px = all(p[0]), py = all(p[1]), pz = all(p[2]);
    int best = 0;
    T least = __builtin_huge_valf();
    // Squared distance to the block's box. Each rounding is monotone, so it never exceeds that of a centre in the box.
    const typename Lane<T>::V zero = {};
    for (int i = 0; i < b.blocks; i += w) {
      auto dx = load(b.lo[0] + i) - px, ex = px - load(b.hi[0] + i);
      auto dy = load(b.lo[1] + i) - py, ey = py - load(b.hi[1] + i);
      auto dz = load(b.lo[2] + i) - pz, ez = pz - load(b.hi[2] + i);
      dx = dx > ex ? dx : ex, dy = dy > ey ? dy : ey, dz = dz > ez ? dz : ez;
      dx = dx > zero ? dx : zero, dy = dy > zero ? dy : zero, dz = dz > zero ? dz : zero;
      store(s.bound + i, dx * dx + dy * dy + dz * dz);
    }
    for (int i = 0; i < b.blocks; ++i)
      if (s.bound[i] < least) least = s.bound[i], best = i;
    Int rank[block_faces], order[block_faces];
    for (int i = 0; i < block_faces; ++i) order[i] = i;
    distances(b.x + best * block_faces, b.y + best * block_faces, b.z + best * block_faces, block_faces, p, s.distance);
    ranks(s.distance, order, block_faces, block_faces, rank);
    for (int i = 0; i < block_faces; ++i)
      if (rank[i] == k - 1) limit = s.distance[i];
    listed = 0;
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
  const int padded = (n + w - 1) / w * w;
  for (int i = n; i < padded; ++i) s.distance[i] = __builtin_huge_valf(), s.face[i] = 0;
  Int rank[most_ranked + block_faces];
  ranks(s.distance, s.face, padded, n, rank);
  for (int i = 0; i < n; ++i)
    if (rank[i] < k) found[rank[i]].distance = s.distance[i], found[rank[i]].face = int(s.face[i]);
  return n < k ? n : k;
}

// The point of n (a multiple of lanes) with the least product with an axis: the first of equals.
template <class T>
static T support(const T* x, const T* y, const T* z, int n, const T* axis, T* product, int* at) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  const auto ax = all(axis[0]), ay = all(axis[1]), az = all(axis[2]);
  auto low = all(T(__builtin_huge_valf()));
  for (int i = 0; i < n; i += w) {
    const auto v = ax * load(x + i) + ay * load(y + i) + az * load(z + i);
    store(product + i, v);
    low = v < low ? v : low;
  }
  T least = low[0];
  for (int l = 1; l < w; ++l) least = low[l] < least ? low[l] : least;
  int i = 0;
  while (i < n - 1 && !(product[i] == least)) ++i;
  *at = i;
  return least;
}

// Lambdas would not inherit the target of the region: plain functions do.
template <class T>
struct Packed {
  typename Lane<T>::V x, y, z;
};
template <class T>
OFG_INLINE Packed<T> minus(const Packed<T>& a, const Packed<T>& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T>
OFG_INLINE typename Lane<T>::V times(const Packed<T>& a, const Packed<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T>
OFG_INLINE Packed<T> turned(const Packed<T>& a, const Packed<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
OFG_INLINE typename Lane<T>::V sum_of_sizes(const Packed<T>& a) {
  return (a.x < T(0) ? -a.x : a.x) + (a.y < T(0) ? -a.y : a.y) + (a.z < T(0) ? -a.z : a.z);
}
// Along an axis, how far the triangle (s, t, u) is from the triangle (origin, p, q): negative where they overlap.
template <class T>
OFG_INLINE typename Lane<T>::V gap_along(const Packed<T>& axis, const Packed<T>& s, const Packed<T>& t, const Packed<T>& u, const Packed<T>& p,
                                         const Packed<T>& q) {
  using V = typename Lane<T>::V;
  const V a = times<T>(axis, s), b = times<T>(axis, t), c = times<T>(axis, u), d = times<T>(axis, p), e = times<T>(axis, q), zero = {};
  const V ab = a < b ? a : b, ba = a > b ? a : b, de = d < e ? d : e, ed = d > e ? d : e;
  const V lo = ab < c ? ab : c, hi = ba > c ? ba : c, l = de < zero ? de : zero, h = ed > zero ? ed : zero;
  const V one = l - hi, two = lo - h;
  return one > two ? one : two;
}

// Which of n triangles (a multiple of lanes) are kept apart from triangle s by the plane of either: the first two axes of
// triangles_meet, with its roundings.
template <class T>
static void planes_apart(const TriangleView<T>& t, int n, const T* s, T slack, unsigned char* apart) {
  using I = typename Lane<T>::I;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  for (int i = 0; i < n; i += w) {
    const Packed<T> o{load(t.c[0] + i), load(t.c[1] + i), load(t.c[2] + i)};
    const Packed<T> tb{load(t.c[3] + i), load(t.c[4] + i), load(t.c[5] + i)}, tc{load(t.c[6] + i), load(t.c[7] + i), load(t.c[8] + i)};
    const Packed<T> ua{all(s[0]), all(s[1]), all(s[2])}, ub{all(s[3]), all(s[4]), all(s[5])}, uc{all(s[6]), all(s[7]), all(s[8])};
    const Packed<T> b = minus<T>(tb, o), c = minus<T>(tc, o), sa = minus<T>(ua, o), sb = minus<T>(ub, o), sc = minus<T>(uc, o);
    const Packed<T> m = turned<T>(b, c), k = turned<T>(minus<T>(sb, sa), minus<T>(sc, sa));
    const I r = (gap_along<T>(m, sa, sb, sc, b, c) > slack * sum_of_sizes<T>(m)) | (gap_along<T>(k, sa, sb, sc, b, c) > slack * sum_of_sizes<T>(k));
    for (int l = 0; l < w; ++l) apart[i + l] = r[l] != 0;
  }
}

// Which of n triangles the segment from s[0..2] to s[3..5] surely misses: the signs that segment_meets takes, with its roundings. A
// segment in the plane of a triangle is left to segment_meets.
template <class T>
static void segments_miss(const TriangleView<T>& t, int n, const T* s, T slack, unsigned char* miss) {
  using V = typename Lane<T>::V;
  using I = typename Lane<T>::I;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  const auto px = all(s[0]), py = all(s[1]), pz = all(s[2]);
  const auto dx = all(s[3]) - px, dy = all(s[4]) - py, dz = all(s[5]) - pz;
  const V zero = {};
  for (int i = 0; i < n; i += w) {
    const V tax = load(t.c[0] + i), tay = load(t.c[1] + i), taz = load(t.c[2] + i);
    const V tbx = load(t.c[3] + i), tby = load(t.c[4] + i), tbz = load(t.c[5] + i);
    const V tcx = load(t.c[6] + i), tcy = load(t.c[7] + i), tcz = load(t.c[8] + i);
    const V ex = tbx - tax, ey = tby - tay, ez = tbz - taz, fx = tcx - tax, fy = tcy - tay, fz = tcz - taz;
    const V nx = ey * fz - ez * fy, ny = ez * fx - ex * fz, nz = ex * fy - ey * fx;
    const V ax = tax - px, ay = tay - py, az = taz - pz, bx = tbx - px, by = tby - py, bz = tbz - pz, cx = tcx - px, cy = tcy - py, cz = tcz - pz;
    const V least = slack * ((nx < zero ? -nx : nx) + (ny < zero ? -ny : ny) + (nz < zero ? -nz : nz));
    const V from = -(nx * ax + ny * ay + nz * az), to = (nx * dx + ny * dy + nz * dz) + from;
    const I one_side = ((from > least) & (to > least)) | ((from < -least) & (to < -least));
    const I in_plane = (from <= least) & (from >= -least) & (to <= least) & (to >= -least);
    const V u = (ay * bz - az * by) * dx + (az * bx - ax * bz) * dy + (ax * by - ay * bx) * dz;
    const V v = (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz;
    const V q = (cy * az - cz * ay) * dx + (cz * ax - cx * az) * dy + (cx * ay - cy * ax) * dz;
    const I inside = ((u >= zero) & (v >= zero) & (q >= zero)) | ((u <= zero) & (v <= zero) & (q <= zero));
    const I r = one_side | (~inside & ~in_plane);
    for (int l = 0; l < w; ++l) miss[i + l] = r[l] != 0;
  }
}

// Which of n boxes are apart from one box (lo, hi) by more than slack.
template <class T>
static void boxes_apart(const BoxView<T>& b, int n, const T* box, T slack, unsigned char* apart) {
  using I = typename Lane<T>::I;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  for (int i = 0; i < n; i += w) {
    I r = {};
    for (int j = 0; j < 3; ++j) r |= (load(b.lo[j] + i) > all(box[3 + j] + slack)) | (load(b.hi[j] + i) < all(box[j] - slack));
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

template <class T>
Kernels<T> kernels() {
  return {nearest<T>, support<T>, planes_apart<T>, segments_miss<T>, boxes_apart<T>, transform<T>};
}

#undef OFG_INLINE
}  // namespace ofg::OFG_ISA
