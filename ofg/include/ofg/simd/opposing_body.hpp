// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Part of kernels_body.hpp, compiled once per instruction set under the same rules: a portal
// through the vertices that oppose each other, of one pair. What it answers holds up to the pair's
// `gap`, which is more than single precision is off by; where that leaves a doubt it does not
// answer.

#define OFG_MEMBER inline __attribute__((always_inline))
struct Spot {
  float x, y, z;
};
OFG_INLINE Spot operator-(const Spot& a, const Spot& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
OFG_INLINE float inner(const Spot& a, const Spot& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
OFG_INLINE Spot outer(const Spot& a, const Spot& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A point of A - B, and the two that it is the difference of: y and z follow x after list_unit and
// twice that, in each body's axes. Copied member by member: as one object it was written in parts
// and read back whole at each step, for which a processor waits until the parts are in memory.
struct Corner {
  Spot m;
  const float *a, *b;
  Corner() = default;
  OFG_MEMBER Corner(const Spot& m_, const float* a_, const float* b_)
      : m{m_.x, m_.y, m_.z}, a(a_), b(b_) {}
  OFG_MEMBER Corner(const Corner& o) : m{o.m.x, o.m.y, o.m.z}, a(o.a), b(o.b) {}
  OFG_MEMBER Corner& operator=(const Corner& o) {
    m.x = o.m.x, m.y = o.m.y, m.z = o.m.z, a = o.a, b = o.b;
    return *this;
  }
};

// The point of a patch least along an axis, but for sixteen units of rounding: see least_of_cell.
OFG_INLINE int least_of_patch(const float* patch, const Spot& axis) {
  constexpr int w = OFG_BYTES / 4;
  const Wide ax = all(axis.x), ay = all(axis.y), az = all(axis.z);
  Mask number;
  for (int l = 0; l < w; ++l) number[l] = l;
  Wide low = {};
  for (int i = 0; i < list_unit; i += w) {
    const Wide v = ax * load(patch + i) + ay * load(patch + list_unit + i) +
                   az * load(patch + 2 * list_unit + i);
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
  return bits & (list_unit - 1);
}

OFG_INLINE Spot spot_of(const float* x) { return {x[0], x[list_unit], x[2 * list_unit]}; }

// The tetrahedron of v0 and three corners holds the origin, farther than the gap from each face:
// holds_origin of verified_pose.hpp in single precision, 16 units of 2^-24 for 16 of 2^-53. Lengths
// are measured by sums of sizes of components, which are no less.
OFG_INLINE float size_of(const Spot& a) {
  return (a.x < 0 ? -a.x : a.x) + (a.y < 0 ? -a.y : a.y) + (a.z < 0 ? -a.z : a.z);
}
OFG_INLINE int side_of_origin(const Spot& p, const Spot& q, const Spot& r, float gap) {
  const Spot e = q - p, f = r - p, n = outer(e, f);
  const float height = inner(n, p), sure = height < 0 ? -height : height;
  const float doubt = gap * size_of(n) + 0x1p-20f * size_of(e) * size_of(f) * (size_of(p) + gap);
  return !(sure > doubt) ? 0 : height > 0 ? 1 : -1;
}
OFG_INLINE bool holds(const Spot& v0, const Corner* v, float gap) {
  const int s = side_of_origin(v[0].m, v[1].m, v[2].m, gap);
  return s != 0 && side_of_origin(v0, v[2].m, v[1].m, gap) == s &&
         side_of_origin(v0, v[0].m, v[2].m, gap) == s &&
         side_of_origin(v0, v[1].m, v[0].m, gap) == s;
}

struct OpposedSearch {
  const OpposedPair& q;
  Opposed& out;
  float posed[2][3 * list_unit];  // the patches in B's axes, A's with `between`
  bool whole;                     // supports are those of the whole bodies

  OpposedSearch(const OpposedPair& pair, Opposed& result) : q(pair), out(result) {}

  OFG_MEMBER Spot place(const Spot& p) const {
    return {(q.r[0] * p.x + q.r[1] * p.y + q.r[2] * p.z) + q.between[0],
            (q.r[3] * p.x + q.r[4] * p.y + q.r[5] * p.z) + q.between[1],
            (q.r[6] * p.x + q.r[7] * p.y + q.r[8] * p.z) + q.between[2]};
  }

  OFG_MEMBER void pose_patches() {
    constexpr int w = OFG_BYTES / 4;
    for (int i = 0; i < list_unit; i += w) {
      const Wide x = load(q.patch_a + i), y = load(q.patch_a + list_unit + i),
                 z = load(q.patch_a + 2 * list_unit + i);
      for (int j = 0; j < 3; ++j) {
        store(posed[0] + j * list_unit + i,
              (q.r[3 * j] * x + q.r[3 * j + 1] * y + q.r[3 * j + 2] * z) + q.between[j]);
        store(posed[1] + j * list_unit + i, q.size_b * load(q.patch_b + j * list_unit + i));
      }
    }
  }

  OFG_MEMBER Corner of_patches(const Spot& d) {
    out.distances += 2 * list_unit;
    const int i = least_of_patch(posed[0], {-d.x, -d.y, -d.z}), j = least_of_patch(posed[1], d);
    return {spot_of(posed[0] + i) - spot_of(posed[1] + j), q.patch_a + i, q.patch_b + j};
  }

  Corner of_bodies(const Spot& d) {
    ++out.supports;
    const float back[3] = {-(q.r[0] * d.x + q.r[3] * d.y + q.r[6] * d.z),
                           -(q.r[1] * d.x + q.r[4] * d.y + q.r[7] * d.z),
                           -(q.r[2] * d.x + q.r[5] * d.y + q.r[8] * d.z)};
    const float axis[3] = {d.x, d.y, d.z};
    const float *a = extreme_at(q.map_a, back), *b = extreme_at(q.map_b, axis);
    const Spot p = place(spot_of(a)), o = spot_of(b);
    return {{p.x - q.size_b * o.x, p.y - q.size_b * o.y, p.z - q.size_b * o.z}, a, b};
  }

  OFG_MEMBER bool behind(const Spot& s, const Spot& d) const {
    const float at = inner(s, d);
    return at < 0 && at * at > q.gap * q.gap * inner(d, d);
  }

  // The corner farthest along d, of the patches while these do for a search: `least` is how far
  // past `base` it has to be. True where a plane across d keeps the bodies apart.
  OFG_MEMBER bool ends(const Spot& d, const Spot& base, float least, Corner& s) {
    s = whole ? of_bodies(d) : of_patches(d);
    if (!whole && (inner(s.m, d) < 0 || !(inner(s.m - base, d) > least))) {
      // The selection claims that it is over: ask the whole bodies. If they object, their vertices
      // join the portal, and every later one is looked for in the whole.
      if (!q.complete) {
        const Corner t = of_bodies(d);
        if (inner(t.m, d) > inner(s.m, d)) s = t, ++out.growths, whole = true;
      }
    }
    if (!behind(s.m, d)) return false;
    out.axis[0] = d.x, out.axis[1] = d.y, out.axis[2] = d.z;
    return true;
  }

  int run() {
    const Spot v0{q.between[0] + q.inside[0], q.between[1] + q.inside[1],
                  q.between[2] + q.inside[2]};
    whole = q.whole;
    if (!whole) pose_patches();
    Corner v[3], s;
    Spot d{-v0.x, -v0.y, -v0.z};
    int corners = 0;  // known; with two of them the ray does not yet pass through a portal
    for (int step = 0; step < 24; ++step) {
      const float least = corners < 3 ? 0.0f : q.gap * size_of(d);
      const Spot base = corners < 3 ? v0 : v[0].m;
      if (ends(d, base, least, s)) return 1;
      if (!(inner(s.m - base, d) > least)) return 0;  // nothing more to gain
      if (corners < 2) {
        v[corners++] = s;
        if (corners == 1) {
          // The axis reflected at the corner that stands in its way: often it separates (Chung and
          // Wang 1996), and any other corner will do for a second.
          const float twice = 2 * inner(s.m, d) / inner(s.m, s.m);
          d = {d.x - twice * s.m.x, d.y - twice * s.m.y, d.z - twice * s.m.z};
        } else {
          d = outer(v[0].m - v0, s.m - v0);
          if (inner(d, v0) > 0) v[1] = v[0], v[0] = s, d = {-d.x, -d.y, -d.z};
        }
        continue;
      }
      if (corners == 2) {
        // s takes the place of the corner that it makes needless, or completes the portal.
        if (inner(outer(v[0].m, s.m), v0) < 0) {
          v[1] = s;
        } else if (inner(outer(s.m, v[1].m), v0) < 0) {
          v[0] = s;
        } else {
          v[2] = s, corners = 3;
        }
        if (corners == 2) {
          d = outer(v[0].m - v0, v[1].m - v0);
          continue;
        }
      } else {
        const Spot c = outer(s.m, v0);
        const bool one = inner(v[0].m, c) > 0, two = inner(v[1].m, c) > 0,
                   three = inner(v[2].m, c) > 0;
        v[one ? (two ? 0 : 2) : (three ? 1 : 0)] = s;
      }
      d = outer(v[1].m - v[0].m, v[2].m - v[0].m);
      if (!(inner(d, v[0].m) >= 0)) continue;
      ++out.portals;
      if (!holds(v0, v, q.gap)) continue;
      out.axis[0] = d.x, out.axis[1] = d.y, out.axis[2] = d.z;
      for (int i = 0; i < 3; ++i) {
        const Spot a = spot_of(v[i].a), b = spot_of(v[i].b);
        const float six[6] = {a.x, a.y, a.z, b.x, b.y, b.z};
        __builtin_memcpy(out.corners[i], six, sizeof six);
      }
      return 2;
    }
    return 0;
  }
};

// 1: apart, 2: the interiors meet, 0: not sure.
static int oppose(const OpposedPair& pair, Opposed& out) {
  OpposedSearch search(pair, out);
  return search.run();
}
#undef OFG_MEMBER
