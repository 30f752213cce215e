// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Part of kernels_body.hpp, compiled once per instruction set under the same rules: the portal of
// portal_body.hpp for as many pairs as a register has lanes, with proofs on both sides.

OFG_INLINE Wide sizes(const Point& a) {
  const Wide zero = {};
  return (a.x < zero ? -a.x : a.x) + (a.y < zero ? -a.y : a.y) + (a.z < zero ? -a.z : a.z);
}
// On which side of three corners the origin is, by more than the gap: see side_of_origin.
OFG_INLINE void sides_of_origin(const Point& p, const Point& q, const Point& r, Wide gap,
                                Mask& above, Mask& below) {
  const Point e = minus<float>(q, p), f = minus<float>(r, p), n = turned<float>(e, f);
  const Wide height = times<float>(n, p);
  const Wide doubt = gap * sizes(n) + 0x1p-20f * sizes(e) * sizes(f) * (sizes(p) + gap);
  above &= height > doubt, below &= -height > doubt;
}

// The points of a set of one list least along one axis a lane: all lanes look at one point at a
// time.
OFG_INLINE Point least_of_one(const SupportView& m, const Point& axis) {
  Wide low = {};
  Point found = {};
  for (int i = 0; i < list_unit; ++i) {
    const Point p{all(m.points[i]), all(m.points[list_unit + i]), all(m.points[2 * list_unit + i])};
    const Wide v = times<float>(axis, p);
    const Mask less = i == 0 ? ~Mask{} : v < low;
    low = either(less, v, low), found = either(less, p, found);
  }
  return found;
}
OFG_INLINE Point least_of(const SupportView& m, bool one_list, const Point& axis, Mask open) {
  return one_list ? least_of_one(m, axis) : least(m, axis, lanes_of(open));
}

// As support_of; of_one: whether A's and B's points are one list each.
struct OneList {
  bool a, b;
};
OFG_INLINE Point farthest_of(const SupportView& a, const SupportView& b, OneList of_one,
                             const Pairs& q, const Point& d, Mask open) {
  const Point back{-(q.r[0] * d.x + q.r[3] * d.y + q.r[6] * d.z),
                   -(q.r[1] * d.x + q.r[4] * d.y + q.r[7] * d.z),
                   -(q.r[2] * d.x + q.r[5] * d.y + q.r[8] * d.z)};
  const Point s = least_of(a, of_one.a, back, open), t = least_of(b, of_one.b, d, open);
  return {(q.r[0] * s.x + q.r[1] * s.y + q.r[2] * s.z) + q.between.x - q.size_b * t.x,
          (q.r[3] * s.x + q.r[4] * s.y + q.r[5] * s.z) + q.between.y - q.size_b * t.y,
          (q.r[6] * s.x + q.r[7] * s.y + q.r[8] * s.z) + q.between.z - q.size_b * t.z};
}

// Of n pairs, n a multiple of the lanes of float: 1, apart by more than the gap; 2, a tetrahedron
// in A - B holds the origin by more than the gap; 0, not sure. inside: from `between` to the start
// of the rays. What proved it and how many supports that took are written beside.
static void prove(const SupportView& a, const SupportView& b, const PosedPairs& pairs, int n,
                  const float* inside, Proved& out) {
  constexpr int w = OFG_BYTES / 4, most_steps = 24;
  const Wide zero = {};
  const OneList of_one{a.side == 1 && a.first[1] == 1, b.side == 1 && b.first[1] == 1};
  for (int from = 0; from < n; from += w) {
    const Pairs q = pairs_at(pairs, from);
    const Point v0{q.between.x + inside[0], q.between.y + inside[1], q.between.z + inside[2]};
    Mask open = q.gap >= zero, apart, meet = {}, supports = -open - open;
    Point d{-v0.x, -v0.y, -v0.z}, axis = d;
    Point v1 = farthest_of(a, b, of_one, q, d, open);
    apart = open & beyond(v1, d, q.gap);
    open &= ~apart;
    // The axis reflected at the corner in its way: see OpposedSearch.
    const Wide twice = 2.0f * times<float>(v1, d) / times<float>(v1, v1);
    d = {d.x - twice * v1.x, d.y - twice * v1.y, d.z - twice * v1.z};
    Point v2 = farthest_of(a, b, of_one, q, d, open), v3 = v2;
    Mask out_now = open & beyond(v2, d, q.gap);
    axis = either(open, d, axis), apart |= out_now, open &= ~out_now;
    d = turned<float>(minus<float>(v1, v0), minus<float>(v2, v0));
    const Mask flip = times<float>(d, v0) > zero;
    const Point swap = v1;
    v1 = either(flip, v2, v1), v2 = either(flip, swap, v2);
    d = {either(flip, -d.x, d.x), either(flip, -d.y, d.y), either(flip, -d.z, d.z)};
    open &= times<float>(d, d) > zero;
    Mask seeking = open;
    for (int step = 0; step < most_steps && any(open); ++step) {
      axis = either(open, d, axis), supports -= open;
      const Point s = farthest_of(a, b, of_one, q, d, open);
      out_now = open & beyond(s, d, q.gap);
      apart |= out_now, open &= ~out_now;
      const Mask left = seeking & (times<float>(turned<float>(v1, s), v0) < zero);
      const Mask right = seeking & ~left & (times<float>(turned<float>(s, v2), v0) < zero);
      const Mask found = seeking & ~left & ~right;
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
      const Point corner = either(base, v0, v1);
      const Point e = either(base, minus<float>(v1, corner), minus<float>(v2, corner)),
                  f = either(base, minus<float>(v2, corner), minus<float>(v3, corner));
      d = turned<float>(e, f);
      open &= times<float>(d, d) > zero;
      const Mask before = open & ~base & (times<float>(d, v1) >= zero);
      if (!any(before)) continue;
      Mask above = before, below = before;
      sides_of_origin(v1, v2, v3, q.gap, above, below);
      sides_of_origin(v0, v3, v2, q.gap, above, below);
      sides_of_origin(v0, v1, v3, q.gap, above, below);
      sides_of_origin(v0, v2, v1, q.gap, above, below);
      const Mask holds = above | below;
      axis = either(holds, d, axis), meet |= holds, open &= ~holds;
    }
    const Mask verdict = (apart & 1) | (meet & 2);
    int said[w];
    __builtin_memcpy(said, &verdict, sizeof said);
    for (int l = 0; l < w; ++l) out.verdict[from + l] = (unsigned char)(said[l]);
    store(out.axis[0] + from, axis.x), store(out.axis[1] + from, axis.y),
        store(out.axis[2] + from, axis.z);
    __builtin_memcpy(out.supports + from, &supports, sizeof supports);
  }
}
