// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Part of kernels_body.hpp, compiled once per instruction set under the same rules: a portal
// towards the origin through the difference of two point sets, for as many pairs at once as a
// register has lanes (Snethen, XenoCollide, in Game Programming Gems 7, 2008). Only the support
// function handles one pair at a time.
typedef Lane<float>::V Wide;
typedef Lane<float>::I Mask;
typedef Packed<float> Point;

OFG_INLINE Wide either(Mask m, Wide yes, Wide no) { return m ? yes : no; }
OFG_INLINE Point either(Mask m, const Point& yes, const Point& no) {
  return {m ? yes.x : no.x, m ? yes.y : no.y, m ? yes.z : no.z};
}
OFG_INLINE bool any(Mask m) {
  int lane[OFG_BYTES / 4], some = 0;
  __builtin_memcpy(lane, &m, sizeof m);
  for (int l = 0; l < OFG_BYTES / 4; ++l) some |= lane[l];
  return some;
}

// The cell of a cube map that contains each direction. Values that are not directions fall in some
// cell.
OFG_INLINE Mask cells_of(const Point& d, int side) {
  const Wide zero = {};
  const Wide sx = d.x < zero ? -d.x : d.x, sy = d.y < zero ? -d.y : d.y,
             sz = d.z < zero ? -d.z : d.z;
  const Mask x = (sx >= sy) & (sx >= sz), y = ~x & (sy >= sz);
  const Wide major = either(x, sx, either(y, sy, sz)), sign = either(x, d.x, either(y, d.y, d.z));
  const Wide half = all(0.5f * float(side)) / major, last = all(float(side - 1));
  Wide u = (either(x, d.y, either(y, d.z, d.x)) + major) * half,
       v = (either(x, d.z, either(y, d.x, d.y)) + major) * half;
  u = u > zero ? u : zero, v = v > zero ? v : zero;  // and what is not a number
  u = u < last ? u : last, v = v < last ? v : last;
  const Mask face = (x ? Mask{} : y ? Mask{} + 2 : Mask{} + 4) - (sign < zero);
  return (face * side + __builtin_convertvector(u, Mask)) * side + __builtin_convertvector(v, Mask);
}

// The point of a list least along an axis, up to sixteen units of rounding: its number is stored in
// the last bits of its product.
OFG_INLINE const float* least_of_cell_at(const SupportView& m, int cell, const float* axis) {
  constexpr int w = OFG_BYTES / 4;
  const float* list = m.points + 3 * list_unit * m.first[cell];
  const float* const end = m.points + 3 * list_unit * m.first[cell + 1];
  const Wide ax = all(axis[0]), ay = all(axis[1]), az = all(axis[2]);
  Mask number;
  for (int l = 0; l < w; ++l) number[l] = l;
  const float* found = list;
  float best = 0;
  for (const float* at = list; at < end; at += 3 * list_unit) {
    Wide low = {};
    for (int i = 0; i < list_unit; i += w) {
      const Wide v =
          ax * load(at + i) + ay * load(at + list_unit + i) + az * load(at + 2 * list_unit + i);
      Mask bits;
      __builtin_memcpy(&bits, &v, sizeof v);
      bits = (bits & ~(list_unit - 1)) | (number + i);
      Wide key;
      __builtin_memcpy(&key, &bits, sizeof key);
      low = i == 0 ? key : key < low ? key : low;
    }
    const float least = least_lane<float>(low);
    int bits;
    __builtin_memcpy(&bits, &least, sizeof bits);
    if (at == list || least < best) best = least, found = at + (bits & (list_unit - 1));
  }
  return found;
}
OFG_INLINE void least_of_cell(const SupportView& m, int cell, const float* axis, float* point) {
  const float* found = least_of_cell_at(m, cell, axis);
  point[0] = found[0], point[1] = found[list_unit], point[2] = found[2 * list_unit];
}

// The point of a set least along an axis: the lookup of cells_of for one direction.
OFG_INLINE const float* extreme_at(const SupportView& m, const float* axis) {
  const float d[3] = {-axis[0], -axis[1], -axis[2]};
  const float s[3] = {d[0] < 0 ? -d[0] : d[0], d[1] < 0 ? -d[1] : d[1], d[2] < 0 ? -d[2] : d[2]};
  const int major = s[0] >= s[1] && s[0] >= s[2] ? 0 : s[1] >= s[2] ? 1 : 2;
  const float half = 0.5f * float(m.side) / s[major], last = float(m.side - 1);
  int cell = 2 * major + (d[major] < 0);
  for (int i = 1; i < 3; ++i) {
    float u = (d[(major + i) % 3] + s[major]) * half;
    u = u > 0 ? u : 0.0f;  // and what is not a number
    cell = cell * m.side + int(u < last ? u : last);
  }
  return least_of_cell_at(m, cell, axis);
}
static void extreme(const SupportView& m, const float* axis, float* point) {
  const float* found = extreme_at(m, axis);
  point[0] = found[0], point[1] = found[list_unit], point[2] = found[2 * list_unit];
}

// The open lanes, as a list: a branch on each lane would be mispredicted whenever one closes.
struct OpenLanes {
  int lane[OFG_BYTES / 4], count;
};
OFG_INLINE OpenLanes lanes_of(Mask open) {
  constexpr int w = OFG_BYTES / 4;
  OpenLanes found;
  int wanted[w];
  __builtin_memcpy(wanted, &open, sizeof open);
  found.count = 0;
  for (int l = 0; l < w; ++l) {
    found.lane[found.count] = l;
    found.count -= wanted[l];  // a mask is -1 or 0
  }
  return found;
}

// The points of a set least along one axis per lane, for the open lanes.
OFG_INLINE Point least(const SupportView& m, const Point& axis, const OpenLanes& open) {
  constexpr int w = OFG_BYTES / 4;
  const Mask cells = cells_of({-axis.x, -axis.y, -axis.z}, m.side);
  float a[3][w], p[3][w] = {};
  int cell[w];
  __builtin_memcpy(a[0], &axis.x, sizeof axis.x), __builtin_memcpy(a[1], &axis.y, sizeof axis.y),
      __builtin_memcpy(a[2], &axis.z, sizeof axis.z), __builtin_memcpy(cell, &cells, sizeof cells);
  for (int i = 0; i < open.count; ++i) {
    const int l = open.lane[i];
    const float one[3] = {a[0][l], a[1][l], a[2][l]};
    float q[3];
    least_of_cell(m, cell[l], one, q);
    p[0][l] = q[0], p[1][l] = q[1], p[2][l] = q[2];
  }
  return {load(p[0]), load(p[1]), load(p[2])};
}

// The lanes' pairs, as PosedPairs has them.
struct Pairs {
  Wide r[9];
  Point between;
  Wide size_b, gap;
};

// The point of A - B farthest along d.
OFG_INLINE Point support_of(const SupportView& a, const SupportView& b, const Pairs& q,
                            const Point& d, Mask open) {
  const Point back{-(q.r[0] * d.x + q.r[3] * d.y + q.r[6] * d.z),
                   -(q.r[1] * d.x + q.r[4] * d.y + q.r[7] * d.z),
                   -(q.r[2] * d.x + q.r[5] * d.y + q.r[8] * d.z)};
  const OpenLanes lanes = lanes_of(open);
  const Point s = least(a, back, lanes), t = least(b, d, lanes);
  return {(q.r[0] * s.x + q.r[1] * s.y + q.r[2] * s.z) + q.between.x - q.size_b * t.x,
          (q.r[3] * s.x + q.r[4] * s.y + q.r[5] * s.z) + q.between.y - q.size_b * t.y,
          (q.r[6] * s.x + q.r[7] * s.y + q.r[8] * s.z) + q.between.z - q.size_b * t.z};
}

// No point of A - B is as near to the origin, along d, as the gap: w is farthest along d.
OFG_INLINE Mask beyond(const Point& w, const Point& d, Wide gap) {
  const Wide at = times<float>(w, d);
  return (at < Wide{}) & (at * at > gap * gap * times<float>(d, d));
}

OFG_INLINE Pairs pairs_at(const PosedPairs& pairs, int from) {
  Pairs q;
  for (int i = 0; i < 9; ++i) q.r[i] = load(pairs.r[i] + from);
  q.between = {load(pairs.between[0] + from), load(pairs.between[1] + from),
               load(pairs.between[2] + from)};
  q.size_b = load(pairs.size_b + from), q.gap = load(pairs.gap + from);
  return q;
}

// Of n pairs, n a multiple of the lanes of float: 1, their hulls are apart by more than the gap; 0,
// no verdict. A few axes are tried: that of the centres, then each reflected at the point of A - B
// that refutes it (Chung and Wang 1996).
static void reflect(const SupportView& a, const SupportView& b, const PosedPairs& pairs, int n,
                    int axes, unsigned char* verdict) {
  constexpr int w = OFG_BYTES / 4;
  for (int from = 0; from < n; from += w) {
    const Pairs q = pairs_at(pairs, from);
    Mask open = q.gap >= Wide{}, apart = {};
    Point d{-q.between.x, -q.between.y, -q.between.z};
    for (int i = 0; i < axes && any(open); ++i) {
      const Point s = support_of(a, b, q, d, open);
      const Mask out = open & beyond(s, d, q.gap);
      apart |= out, open &= ~out;
      const Wide twice = 2.0f * times<float>(s, d) / times<float>(s, s);
      d = {d.x - twice * s.x, d.y - twice * s.y, d.z - twice * s.z};
    }
    int yes[w];
    __builtin_memcpy(yes, &apart, sizeof apart);
    for (int l = 0; l < w; ++l) verdict[from + l] = yes[l] ? 1 : 0;
  }
}

// As reflect, until it is settled; and 2: their hulls appear to meet.
static void portal(const SupportView& a, const SupportView& b, const PosedPairs& pairs, int n,
                   unsigned char* verdict) {
  constexpr int w = OFG_BYTES / 4, most_steps = 24;
  const Wide zero = {};
  for (int from = 0; from < n; from += w) {
    const Pairs q = pairs_at(pairs, from);
    const Point& v0 = q.between;
    Mask open = q.gap >= zero, apart, meet = {};
    Point d{-v0.x, -v0.y, -v0.z};
    Point v1 = support_of(a, b, q, d, open);
    apart = open & beyond(v1, d, q.gap);
    open &= ~apart;
    d = turned<float>(v1, v0);
    const Mask in_line =
        open & ~(times<float>(d, d) > all(1e-12f) * times<float>(v0, v0) * times<float>(v1, v1));
    meet |= in_line, open &= ~in_line;
    Point v2 = support_of(a, b, q, d, open), v3 = v2;
    Mask out = open & beyond(v2, d, q.gap);
    apart |= out, open &= ~out;
    d = turned<float>(minus<float>(v1, v0), minus<float>(v2, v0));
    const Mask flip = times<float>(d, v0) > zero;
    const Point swap = v1;
    v1 = either(flip, v2, v1), v2 = either(flip, swap, v2);
    d = {either(flip, -d.x, d.x), either(flip, -d.y, d.y), either(flip, -d.z, d.z)};
    Mask seeking = open;  // those whose ray does not yet pass through their portal
    for (int step = 0; step < most_steps && any(open); ++step) {
      const Point s = support_of(a, b, q, d, open);
      out = open & beyond(s, d, q.gap);
      apart |= out, open &= ~out;
      // Search phase: s joins v1 and v2, and replaces the one that becomes unnecessary.
      const Mask left = seeking & (times<float>(turned<float>(v1, s), v0) < zero);
      const Mask right = seeking & ~left & (times<float>(turned<float>(s, v2), v0) < zero);
      const Mask found = seeking & ~left & ~right;
      // Refinement phase: the portal moves out to s, unless there is nothing more to gain.
      const Mask refine = open & ~seeking;
      const Wide gain = times<float>(minus<float>(s, v1), d);
      open &= ~(refine & ~((gain > zero) & (gain * gain > q.gap * q.gap * times<float>(d, d))));
      const Point c = turned<float>(s, v0);
      const Mask one = times<float>(v1, c) > zero, two = times<float>(v2, c) > zero,
                 three = times<float>(v3, c) > zero;
      const Mask first = refine & ((one & two) | (~one & ~three)), second = refine & ~one & three,
                 third = refine & one & ~two;
      v1 = either(right | first, s, v1), v2 = either(left | second, s, v2),
      v3 = either(found | third, s, v3);
      seeking &= ~found;
      const Mask base = seeking;
      const Point corner = either(base, v0, v1);  // of the triangle whose normal is next
      const Point e = either(base, minus<float>(v1, corner), minus<float>(v2, corner)),
                  f = either(base, minus<float>(v2, corner), minus<float>(v3, corner));
      d = turned<float>(e, f);
      open &= times<float>(d, d) > zero;  // a portal without area gives no direction
      const Mask inside = open & ~base & (times<float>(d, v1) >= zero);
      meet |= inside, open &= ~inside;
    }
    int yes[w], maybe[w];
    __builtin_memcpy(yes, &apart, sizeof apart), __builtin_memcpy(maybe, &meet, sizeof meet);
    for (int l = 0; l < w; ++l) verdict[from + l] = yes[l] ? 1 : maybe[l] ? 2 : 0;
  }
}

OFG_INLINE void narrow(Lane<double>::V v, float* to) {
  typedef float Half __attribute__((vector_size(OFG_BYTES / 2)));
  const Half h = __builtin_convertvector(v, Half);
  __builtin_memcpy(to, &h, sizeof h);
}

// Four numbers a lane, in units of the power of two of the largest of them: see unit_of.
OFG_INLINE void in_units_of_largest(Lane<double>::V* q) {
  typedef Lane<double>::V V;
  V most = {};
  for (int j = 0; j < 4; ++j) {
    const V size = q[j] < 0.0 ? -q[j] : q[j];
    most = size > most ? size : most;
  }
  Lane<double>::I bits;
  __builtin_memcpy(&bits, &most, sizeof bits);
  bits = (2046 - (bits >> 52)) << 52;
  V unit;
  __builtin_memcpy(&unit, &bits, sizeof unit);
  for (int j = 0; j < 4; ++j) q[j] *= unit;
}

OFG_INLINE void rotation_of(const Lane<double>::V* q, Lane<double>::V* m) {
  const auto s = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const auto x = s * q[1], y = s * q[2], z = s * q[3];
  m[0] = 1.0 - (q[2] * y + q[3] * z), m[1] = q[1] * y - q[0] * z, m[2] = q[1] * z + q[0] * y;
  m[3] = q[1] * y + q[0] * z, m[4] = 1.0 - (q[1] * x + q[3] * z), m[5] = q[2] * z - q[0] * x;
  m[6] = q[1] * z - q[0] * y, m[7] = q[2] * z + q[0] * x, m[8] = 1.0 - (q[1] * x + q[2] * y);
}

// PosedPairs of poses in rows of seven, quaternion and position; with one division a rotation,
// which is near enough.
static void pose_pairs(const PairOfBodies& bodies, const double* poses_a, const double* poses_b,
                       int n, PosedPairs& out) {
  constexpr int w = OFG_BYTES / 8;
  typedef Lane<double>::V V;
  typedef Packed<double> P;
  double rows[14][most_posed];
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 7; ++j)
      rows[j][i] = poses_a[7 * i + j], rows[7 + j][i] = poses_b[7 * i + j];
  const int padded = (n + w - 1) / w * w;
  for (int j = 0; j < 14; ++j)
    for (int i = n; i < padded; ++i) rows[j][i] = 0;
  const double unit = 1 / (bodies.radius_a + bodies.radius_b), own = bodies.radius_a * unit;
  for (int i = 0; i < padded; i += w) {
    V p[4], q[4], r[4];
    for (int j = 0; j < 4; ++j) p[j] = load(rows[j] + i), q[j] = load(rows[7 + j] + i);
    in_units_of_largest(p), in_units_of_largest(q);
    // conj(q) p: from A's frame to B's
    r[0] = q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3];
    r[1] = q[0] * p[1] - q[1] * p[0] - q[2] * p[3] + q[3] * p[2];
    r[2] = q[0] * p[2] + q[1] * p[3] - q[2] * p[0] - q[3] * p[1];
    r[3] = q[0] * p[3] - q[1] * p[2] + q[2] * p[1] - q[3] * p[0];
    V m[9], back[9];
    rotation_of(r, m), rotation_of(q, back);
    const P d{load(rows[4] + i) - load(rows[11] + i), load(rows[5] + i) - load(rows[12] + i),
              load(rows[6] + i) - load(rows[13] + i)};
    const P shift{back[0] * d.x + back[3] * d.y + back[6] * d.z,
                  back[1] * d.x + back[4] * d.y + back[7] * d.z,
                  back[2] * d.x + back[5] * d.y + back[8] * d.z};
    const double *a = bodies.centre_a, *b = bodies.centre_b;
    const P x{((m[0] * a[0] + m[1] * a[1] + m[2] * a[2]) + shift.x - b[0]) * unit,
              ((m[3] * a[0] + m[4] * a[1] + m[5] * a[2]) + shift.y - b[1]) * unit,
              ((m[6] * a[0] + m[7] * a[1] + m[8] * a[2]) + shift.z - b[2]) * unit};
    const V gap = bodies.rounding * (1 + sum_of_sizes<double>(x)) +
                  bodies.slack * unit * (bodies.extents + sum_of_sizes<double>(shift));
    for (int j = 0; j < 9; ++j) narrow(m[j] * own, out.r[j] + i);
    narrow(x.x, out.between[0] + i), narrow(x.y, out.between[1] + i),
        narrow(x.z, out.between[2] + i);
    narrow(gap, out.gap + i);
    narrow(all(bodies.radius_b * unit), out.size_b + i);
  }
}
