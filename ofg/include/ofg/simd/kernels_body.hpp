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

// Halves against halves: by registers while there are two lanes of 16 bytes or more, then by shuffles.
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

// Position of each of n in the order by distance, and of equals by face; n padded to whole registers.
template <class T>
OFG_INLINE void ranks(const T* d, const typename IntOf<T>::type* face, int n, typename IntOf<T>::type* rank) {
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

// The k <= block_faces nearest faces to a point, nearest first, equal distances in the order of the faces. Blocks of faces whose
// box is farther than the k-th nearest in the best block are not looked at. Returns the number of candidates left in
// `found`; if it is more than most_ranked they are not sorted, and the caller must.
template <class T>
static int nearest(const BlockView<T>& b, const T* p, int k, NearestScratch<T>& s, Candidate<T>* found, int* evaluated) {
  using Int = typename IntOf<T>::type;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  if (b.blocks == 1) {
    Int rank[block_faces];
    T d[block_faces];
    distances(b.x, b.y, b.z, block_faces, p, d);
    ranks(d, b.face, b.faces, rank);
    for (int i = 0; i < b.faces; ++i) found[i].distance = d[i], found[i].face = int(b.face[i]);  // stays where NaNs have no rank
    for (int i = 0; i < b.faces; ++i)  // those beyond k are written where nobody looks
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
    // Squared distance to the block's box. Each rounding is monotone, so it never exceeds that of a centre in the box.
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
    distances(b.x + best * block_faces, b.y + best * block_faces, b.z + best * block_faces, block_faces, p, s.distance);
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
  for (int i = 0; i < n; ++i)  // those beyond k are written where nobody looks
    found[rank[i]].distance = s.distance[i], found[rank[i]].face = int(s.face[i]);
  return n < k ? n : k;
}

// The least product of n points (a multiple of lanes) with an axis, and the first point that has it.
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
    const auto dx = load(x + i) - px, dy = load(y + i) - py, dz = load(z + i) - pz, d = dx * dx + dy * dy + dz * dz;
    most = d > most ? d : most;
  }
  T far = most[0];
  for (int l = 1; l < w; ++l) far = most[l] > far ? most[l] : far;
  return far;
}

// Lambdas would not inherit the target of the region: plain functions do.
template <class T>
struct Packed {
  typename Lane<T>::V x, y, z;
};
template <class T>
OFG_INLINE Packed<T> minus(const Packed<T>& a, const Packed<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
OFG_INLINE typename Lane<T>::V times(const Packed<T>& a, const Packed<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
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
OFG_INLINE typename Lane<T>::V gap_along(const Packed<T>& axis, const Packed<T>& s, const Packed<T>& t, const Packed<T>& u,
                                         const Packed<T>& p, const Packed<T>& q) {
  using V = typename Lane<T>::V;
  const V a = times<T>(axis, s), b = times<T>(axis, t), c = times<T>(axis, u), d = times<T>(axis, p), e = times<T>(axis, q),
          zero = {};
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
    const Packed<T> tb{load(t.c[3] + i), load(t.c[4] + i), load(t.c[5] + i)},
        tc{load(t.c[6] + i), load(t.c[7] + i), load(t.c[8] + i)};
    const Packed<T> ua{all(s[0]), all(s[1]), all(s[2])}, ub{all(s[3]), all(s[4]), all(s[5])}, uc{all(s[6]), all(s[7]), all(s[8])};
    const Packed<T> b = minus<T>(tb, o), c = minus<T>(tc, o), sa = minus<T>(ua, o), sb = minus<T>(ub, o), sc = minus<T>(uc, o);
    const Packed<T> m = turned<T>(b, c), k = turned<T>(minus<T>(sb, sa), minus<T>(sc, sa));
    const I r = (gap_along<T>(m, sa, sb, sc, b, c) > slack * sum_of_sizes<T>(m)) |
                (gap_along<T>(k, sa, sb, sc, b, c) > slack * sum_of_sizes<T>(k));
    for (int l = 0; l < w; ++l) apart[i + l] = r[l] != 0;
  }
}

// Are two triangles kept apart by a product of their edges or, in one plane, by the normal of an edge within it? The last fifteen
// axes of triangles_meet, an axis a lane; s and t as there: relative to t's first corner. If so, `best` is the axis with the
// widest gap, from t to s: it may keep more apart than these two.
template <class T>
static bool edges_apart(const T* s, const T* t, T slack, T* best) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  const T e[9] = {s[3] - s[0], s[4] - s[1], s[5] - s[2], s[6] - s[3], s[7] - s[4],
                  s[8] - s[5], s[0] - s[6], s[1] - s[7], s[2] - s[8]};
  const T f[9] = {t[3] - t[0], t[4] - t[1], t[5] - t[2], t[6] - t[3], t[7] - t[4],
                  t[8] - t[5], t[0] - t[6], t[1] - t[7], t[2] - t[8]};
  const T g[3] = {s[6] - s[0], s[7] - s[1], s[8] - s[2]}, h[3] = {t[6] - t[0], t[7] - t[1], t[8] - t[2]};
  const T n[3] = {e[1] * g[2] - e[2] * g[1], e[2] * g[0] - e[0] * g[2], e[0] * g[1] - e[1] * g[0]};
  const T m[3] = {f[1] * h[2] - f[2] * h[1], f[2] * h[0] - f[0] * h[2], f[0] * h[1] - f[1] * h[0]};
  // The factors of each axis: nine e x f, three n x e, three m x f, and the first again to fill up.
  alignas(64) T left[3][16], right[3][16];
  for (int c = 0; c < 3; ++c) {
    T *l = left[c], *r = right[c];
    l[0] = l[1] = l[2] = l[15] = e[c], l[3] = l[4] = l[5] = e[3 + c], l[6] = l[7] = l[8] = e[6 + c];
    r[0] = r[3] = r[6] = r[15] = f[c], r[1] = r[4] = r[7] = f[3 + c], r[2] = r[5] = r[8] = f[6 + c];
    l[9] = l[10] = l[11] = n[c], r[9] = e[c], r[10] = e[3 + c], r[11] = e[6 + c];
    l[12] = l[13] = l[14] = m[c], r[12] = f[c], r[13] = f[3 + c], r[14] = f[6 + c];
  }
  const Packed<T> sa{all(s[0]), all(s[1]), all(s[2])}, sb{all(s[3]), all(s[4]), all(s[5])}, sc{all(s[6]), all(s[7]), all(s[8])};
  const Packed<T> tb{all(t[3]), all(t[4]), all(t[5])}, tc{all(t[6]), all(t[7]), all(t[8])};
  alignas(64) T width[16];
  for (int i = 0; i < 16; i += w) {
    const Packed<T> axis = turned<T>({load(left[0] + i), load(left[1] + i), load(left[2] + i)},
                                     {load(right[0] + i), load(right[1] + i), load(right[2] + i)});
    const auto gap = gap_along<T>(axis, sa, sb, sc, tb, tc), size = sum_of_sizes<T>(axis);
    const typename Lane<T>::I away = gap > slack * size;
    const typename Lane<T>::V none = {};
    store(width + i, away ? gap / size : none);
    store(left[0] + i, axis.x), store(left[1] + i, axis.y), store(left[2] + i, axis.z);
  }
  int widest = -1;
  T most = 0;
  for (int l = 0; l < 16; ++l)
    if (width[l] > most) most = width[l], widest = l;
  if (widest < 0) return false;
  const T sign =
      (left[0][widest] * (s[0] - t[0]) + left[1][widest] * (s[1] - t[1]) + left[2][widest] * (s[2] - t[2])) < 0 ? T(-1) : T(1);
  for (int c = 0; c < 3; ++c) best[c] = sign * left[c][widest];
  return true;
}

// The plane of n faces (a multiple of lanes) that a cloud is farthest in front of: its normal and how far, by the sum of the
// sizes of the normal's components.
template <class T>
static T planes_gap(const TriangleView<T>& t, int n, const CloudView<T>& c, T* normal) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  T most = -__builtin_huge_valf();
  for (int i = 0; i < n; i += w) {
    const Packed<T> a{load(t.c[0] + i), load(t.c[1] + i), load(t.c[2] + i)};
    const Packed<T> b{load(t.c[3] + i), load(t.c[4] + i), load(t.c[5] + i)},
        d{load(t.c[6] + i), load(t.c[7] + i), load(t.c[8] + i)};
    const Packed<T> m = turned<T>(minus<T>(b, a), minus<T>(d, a));
    auto low = all(T(__builtin_huge_valf()));
    for (int j = 0; j < c.n; ++j) {
      const auto v = m.x * c.x[j] + m.y * c.y[j] + m.z * c.z[j];
      low = v < low ? v : low;
    }
    const auto gap = (low - times<T>(m, a)) / sum_of_sizes<T>(m);
    for (int l = 0; l < w; ++l)
      if (gap[l] > most) most = gap[l], normal[0] = m.x[l], normal[1] = m.y[l], normal[2] = m.z[l];
  }
  return most;
}

// Which of n triangles the segment from s[0..2] to s[3..5] surely misses: the signs that segment_meets takes, with its roundings.
// A segment in the plane of a triangle is left to segment_meets.
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
    const V ax = tax - px, ay = tay - py, az = taz - pz, bx = tbx - px, by = tby - py, bz = tbz - pz, cx = tcx - px,
            cy = tcy - py, cz = tcz - pz;
    const V least = slack * ((nx < zero ? -nx : nx) + (ny < zero ? -ny : ny) + (nz < zero ? -nz : nz));
    const V from = -(nx * ax + ny * ay + nz * az), to = (nx * dx + ny * dy + nz * dz) + from;
    const I one_side = ((from > least) & (to > least)) | ((from < -least) & (to < -least));
    const I in_plane = (from <= least) & (from >= -least) & (to <= least) & (to >= -least);
    const V u = (ay * bz - az * by) * dx + (az * bx - ax * bz) * dy + (ax * by - ay * bx) * dz;
    const V v = (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz;
    const V q = (cy * az - cz * ay) * dx + (cz * ax - cx * az) * dy + (cx * ay - cy * ax) * dz;
    const I inside = (((u >= zero) & (v >= zero) & (q >= zero)) | ((u <= zero) & (v <= zero) & (q <= zero))) &
                     ~((u == zero) & (v == zero) & (q == zero));
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

#include "portal_body.hpp"

template <class T>
Kernels<T> kernels() {
  return {nearest<T>,       support<T>,     farthest<T>,  planes_apart<T>, edges_apart<T>, planes_gap<T>,
          segments_miss<T>, boxes_apart<T>, transform<T>, extreme,         reflect,        portal,       pose_pairs};
}

#undef OFG_INLINE
}  // namespace ofg::OFG_ISA
