// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Compiled once per instruction set: included by boxes.hpp inside a region with that target, with
// OFG_ISA as the namespace and OFG_BYTES as the width of its registers. The rules are those of
// kernels_body.hpp: no standard library, the same roundings at every width.
namespace ofg::OFG_ISA {

template <class V>
static inline __attribute__((always_inline)) V size_of_each(V x) {
  return x < 0 ? -x : x;
}

// Along the three axes of each box and the three of the single one.
static inline unsigned boxes_meet(const BoxNode& node, const PosedBox& box, float* depth) {
  typedef float V __attribute__((vector_size(OFG_BYTES)));
  typedef int I __attribute__((vector_size(OFG_BYTES)));
  constexpr int w = OFG_BYTES / 4;
  const float* p = box.axis;
  unsigned found = 0;
  for (int l = 0; l < box_lanes; l += w) {
    const auto at = [l](const float* x) { return *reinterpret_cast<const V*>(x + l); };
    V d[3], e[3], reach[3] = {}, least = {};
    for (int i = 0; i < 3; ++i) {
      d[i] = at(node.centre[i]) * box.size - box.centre[i];
      e[i] = at(node.extent[i]) * box.size;
    }
    for (int k = 0; k < 3; ++k) {
      const V x = at(node.axis[3 * k]), y = at(node.axis[3 * k + 1]), z = at(node.axis[3 * k + 2]);
      V own = e[k] + box.margin;
      for (int i = 0; i < 3; ++i) {
        const V turned = size_of_each(x * p[3 * i] + y * p[3 * i + 1] + z * p[3 * i + 2]);
        own += turned * box.extent[i], reach[i] += turned * e[k];
      }
      const V gap = own - size_of_each(x * d[0] + y * d[1] + z * d[2]);
      least = k == 0 ? gap : gap < least ? gap : least;
    }
    for (int i = 0; i < 3; ++i) {
      const V far = size_of_each(d[0] * p[3 * i] + d[1] * p[3 * i + 1] + d[2] * p[3 * i + 2]),
              gap = reach[i] + box.extent[i] - far;
      least = gap < least ? gap : least;
    }
    *reinterpret_cast<V*>(depth + l) = least;
    const I in = (least >= 0) & (*reinterpret_cast<const I*>(node.child + l) != 0);
    for (int i = 0; i < w; ++i) found |= unsigned(in[i] & 1) << (l + i);
  }
  return found;
}

}  // namespace ofg::OFG_ISA
