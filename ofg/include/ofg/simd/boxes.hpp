// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// One oriented box against the eight of a tree's node, compiled for each instruction set.
#pragma once
#include "kernels.hpp"

namespace ofg {

constexpr int box_lanes = 8;

// Oriented boxes relative to a body's centre in units of its radius: all c + sum of x_k a_k with
// |x_k| <= extent[k]; axis[3 k] to axis[3 k + 2] are a_k. child: of a lane, a node, or ~item; 0
// where the lane is empty.
struct alignas(32) BoxNode {
  float centre[3][box_lanes], extent[3][box_lanes], axis[9][box_lanes];
  int child[box_lanes];
};

// A box in the axes of the node's body, in units of the sum of the radii. extent: with the margin
// for rounding. size: of the node's body's radius.
struct PosedBox {
  float centre[3], extent[3], axis[9], size, margin;
};

}  // namespace ofg

#define OFG_ISA sse2
#define OFG_BYTES 16
#include "boxes_body.hpp"
#undef OFG_ISA
#undef OFG_BYTES

#ifdef OFG_HAS_X86
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#define OFG_ISA avx2
#define OFG_BYTES 32
#include "boxes_body.hpp"
#undef OFG_ISA
#undef OFG_BYTES
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

namespace ofg {

// Which of a node's boxes may meet the box, as bits, and by how much each at least reaches into it
// along the axis where that is least. depth: box_lanes numbers, aligned.
using BoxesMeet = unsigned (*)(const BoxNode&, const PosedBox&, float* depth);

inline BoxesMeet boxes_meet_of(Isa isa) {
#ifdef OFG_HAS_X86
  if (isa != Isa::sse2) return avx2::boxes_meet;
#endif
  (void)isa;
  return sse2::boxes_meet;
}

// As `kernels` is. set_boxes_isa: after set_isa.
inline BoxesMeet boxes_meet = boxes_meet_of(widest_isa());
inline bool set_boxes_isa(Isa isa) {
  if (int(isa) > int(widest_isa())) return false;
  boxes_meet = boxes_meet_of(isa);
  return true;
}

}  // namespace ofg
