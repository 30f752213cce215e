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

// Of n pairs, n a multiple of the lanes of float: 1, apart by more than the gap; 2, a tetrahedron
// in A - B holds the origin by more than the gap; 0, not sure. inside: from `between` to the start
// of the rays. What proved it and how many supports that took are written beside.
static void prove(const SupportView& a, const SupportView& b, const PosedPairs& pairs, int n,
                  const float* inside, Proved& out) {
  constexpr int w = OFG_BYTES / 4, most_steps = 24;
  const Wide zero = {};
  for (int from = 0; from < n; from += w) {
    const Pairs q = pairs_at(pairs, from);
    const Point v0{q.between.x + inside[0], q.between.y + inside[1], q.between.z + inside[2]};
    Mask open = q.gap >= zero, apart, meet = {}, supports = -open - open;
    Point d{-v0.x, -v0.y, -v0.z}, axis = d;
    Point v1 = support_of(a, b, q, d, open);
    apart = open & beyond(v1, d, q.gap);
    open &= ~apart;
    d = turned<float>(v1, v0);
    open &= times<float>(d, d) > zero;
    Point v2 = support_of(a, b, q, d, open), v3 = v2;
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
      const Point s = support_of(a, b, q, d, open);
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
