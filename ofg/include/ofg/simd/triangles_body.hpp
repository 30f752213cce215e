// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Part of kernels_body.hpp, compiled once per instruction set under the same rules: separation of
// triangles by planes, edges and segments.
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
// Along an axis, the distance of the triangle (s, t, u) from the triangle (origin, p, q): negative
// if they overlap.
template <class T>
OFG_INLINE typename Lane<T>::V gap_along(const Packed<T>& axis, const Packed<T>& s,
                                         const Packed<T>& t, const Packed<T>& u, const Packed<T>& p,
                                         const Packed<T>& q) {
  using V = typename Lane<T>::V;
  const V a = times<T>(axis, s), b = times<T>(axis, t), c = times<T>(axis, u),
          d = times<T>(axis, p), e = times<T>(axis, q), zero = {};
  const V ab = a < b ? a : b, ba = a > b ? a : b, de = d < e ? d : e, ed = d > e ? d : e;
  const V lo = ab < c ? ab : c, hi = ba > c ? ba : c, l = de < zero ? de : zero,
          h = ed > zero ? ed : zero;
  const V one = l - hi, two = lo - h;
  return one > two ? one : two;
}

// Which of n triangles (a multiple of lanes) are separated from triangle s by the plane of either:
// the first two axes of triangles_meet, with its roundings.
template <class T>
static void planes_apart(const TriangleView<T>& t, int n, const T* s, T slack,
                         unsigned char* apart) {
  using I = typename Lane<T>::I;
  constexpr int w = OFG_BYTES / int(sizeof(T));
  for (int i = 0; i < n; i += w) {
    const Packed<T> o{load(t.c[0] + i), load(t.c[1] + i), load(t.c[2] + i)};
    const Packed<T> tb{load(t.c[3] + i), load(t.c[4] + i), load(t.c[5] + i)},
        tc{load(t.c[6] + i), load(t.c[7] + i), load(t.c[8] + i)};
    const Packed<T> ua{all(s[0]), all(s[1]), all(s[2])}, ub{all(s[3]), all(s[4]), all(s[5])},
        uc{all(s[6]), all(s[7]), all(s[8])};
    const Packed<T> b = minus<T>(tb, o), c = minus<T>(tc, o), sa = minus<T>(ua, o),
                    sb = minus<T>(ub, o), sc = minus<T>(uc, o);
    const Packed<T> m = turned<T>(b, c), k = turned<T>(minus<T>(sb, sa), minus<T>(sc, sa));
    const I r = (gap_along<T>(m, sa, sb, sc, b, c) > slack * sum_of_sizes<T>(m)) |
                (gap_along<T>(k, sa, sb, sc, b, c) > slack * sum_of_sizes<T>(k));
    for (int l = 0; l < w; ++l) apart[i + l] = r[l] != 0;
  }
}

// Whether two triangles are separated by a product of their edges or, if coplanar, by the normal of
// an edge within the plane. The last fifteen axes of triangles_meet, one axis per lane; s and t as
// there: relative to t's first corner. If so, `best` is the axis with the widest gap, from t to s:
// it may separate more than these two.
template <class T>
static bool edges_apart(const T* s, const T* t, T slack, T* best) {
  constexpr int w = OFG_BYTES / int(sizeof(T));
  const T e[9] = {s[3] - s[0], s[4] - s[1], s[5] - s[2], s[6] - s[3], s[7] - s[4],
                  s[8] - s[5], s[0] - s[6], s[1] - s[7], s[2] - s[8]};
  const T f[9] = {t[3] - t[0], t[4] - t[1], t[5] - t[2], t[6] - t[3], t[7] - t[4],
                  t[8] - t[5], t[0] - t[6], t[1] - t[7], t[2] - t[8]};
  const T g[3] = {s[6] - s[0], s[7] - s[1], s[8] - s[2]},
          h[3] = {t[6] - t[0], t[7] - t[1], t[8] - t[2]};
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
  const Packed<T> sa{all(s[0]), all(s[1]), all(s[2])}, sb{all(s[3]), all(s[4]), all(s[5])},
      sc{all(s[6]), all(s[7]), all(s[8])};
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
  const T sign = (left[0][widest] * (s[0] - t[0]) + left[1][widest] * (s[1] - t[1]) +
                  left[2][widest] * (s[2] - t[2])) < 0
                     ? T(-1)
                     : T(1);
  for (int c = 0; c < 3; ++c) best[c] = sign * left[c][widest];
  return true;
}

// The plane of n faces (a multiple of lanes) that a cloud is farthest in front of: its normal and
// the distance, by the sum of the sizes of the normal's components.
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

// Which of n triangles the segment from s[0..2] to s[3..5] surely misses: the signs that
// segment_meets computes, with its roundings. A segment in the plane of a triangle is left to
// segment_meets.
template <class T>
static void segments_miss(const TriangleView<T>& t, int n, const T* s, T slack,
                          unsigned char* miss) {
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
    const V ex = tbx - tax, ey = tby - tay, ez = tbz - taz, fx = tcx - tax, fy = tcy - tay,
            fz = tcz - taz;
    const V nx = ey * fz - ez * fy, ny = ez * fx - ex * fz, nz = ex * fy - ey * fx;
    const V ax = tax - px, ay = tay - py, az = taz - pz, bx = tbx - px, by = tby - py,
            bz = tbz - pz, cx = tcx - px, cy = tcy - py, cz = tcz - pz;
    const V least =
        slack * ((nx < zero ? -nx : nx) + (ny < zero ? -ny : ny) + (nz < zero ? -nz : nz));
    const V from = -(nx * ax + ny * ay + nz * az), to = (nx * dx + ny * dy + nz * dz) + from;
    const I one_side = ((from > least) & (to > least)) | ((from < -least) & (to < -least));
    const I in_plane = (from <= least) & (from >= -least) & (to <= least) & (to >= -least);
    const V u = (ay * bz - az * by) * dx + (az * bx - ax * bz) * dy + (ax * by - ay * bx) * dz;
    const V v = (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz;
    const V q = (cy * az - cz * ay) * dx + (cz * ax - cx * az) * dy + (cx * ay - cy * ax) * dz;
    const I inside =
        (((u >= zero) & (v >= zero) & (q >= zero)) | ((u <= zero) & (v <= zero) & (q <= zero))) &
        ~((u == zero) & (v == zero) & (q == zero));
    const I r = one_side | (~inside & ~in_plane);
    for (int l = 0; l < w; ++l) miss[i + l] = r[l] != 0;
  }
}
