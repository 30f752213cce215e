// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Compiled once per instruction set: included by boxes.hpp inside a region with that target, with
// OFG_ISA as the namespace and OFG_BYTES as the width of its registers. The rules are those of
// kernels_body.hpp: no standard library, the same roundings at every width.
namespace ofg::OFG_ISA {

// Along the three axes of the node and the three of the single box. Margins are in the posed
// extents of the single box.
static inline unsigned boxes_meet(const BoxNode& node, const PosedBox& box, float* depth) {
  typedef float V __attribute__((vector_size(OFG_BYTES)));
  typedef int I __attribute__((vector_size(OFG_BYTES)));
  constexpr int w = OFG_BYTES / 4;
  unsigned found = 0;
  for (int l = 0; l < box_lanes; l += w) {
    V d[3], e[3], least = {};
    for (int i = 0; i < 3; ++i) {
      d[i] = *reinterpret_cast<const V*>(node.centre[i] + l) * box.size - box.centre[i];
      e[i] = *reinterpret_cast<const V*>(node.extent[i] + l) * box.size;
    }
    const auto along = [&](V at, V reach) {
      const V far = at < 0 ? -at : at;
      return reach - far;
    };
    for (int i = 0; i < 3; ++i) {
      const V gap = along(d[i], e[i] + box.extent[i]);
      least = i == 0 ? gap : gap < least ? gap : least;
    }
    for (int i = 0; i < 3; ++i) {
      const V at = d[0] * box.r[i] + d[1] * box.r[3 + i] + d[2] * box.r[6 + i],
              reach = e[0] * box.size_of_r[i] + e[1] * box.size_of_r[3 + i] +
                      e[2] * box.size_of_r[6 + i] + box.own[i];
      const V gap = along(at, reach);
      least = gap < least ? gap : least;
    }
    *reinterpret_cast<V*>(depth + l) = least;
    const I in = (least >= 0) & (*reinterpret_cast<const I*>(node.child + l) != 0);
    for (int i = 0; i < w; ++i) found |= unsigned(in[i] & 1) << (l + i);
  }
  return found;
}

}  // namespace ofg::OFG_ISA
