// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A tree of bounding boxes, eight to a node, over the faces or the pieces of a body; and the pairs
// of items of two such trees whose boxes meet, the deepest first.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "simd/boxes.hpp"
#include "vector.hpp"

namespace ofg::verified {

struct Box {
  Vec3<double> lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};

  void add(const Vec3<double>& v) {
    lo = {std::fmin(lo.x, v.x), std::fmin(lo.y, v.y), std::fmin(lo.z, v.z)};
    hi = {std::fmax(hi.x, v.x), std::fmax(hi.y, v.y), std::fmax(hi.z, v.z)};
  }
  void add(const Box& b) { add(b.lo), add(b.hi); }
};

class Tree {
 public:
  // A box is named by its slot: box_lanes times its node, and its lane.
  static constexpr int root = 0;

  Tree() = default;

  // boxes: relative to the body's centre in units of its radius, of all that the items may name.
  Tree(std::vector<Box> boxes, std::vector<int> items) : boxes_(std::move(boxes)) {
    nodes_.push_back({});
    put(root, items.data(), int(items.size()));
    boxes_ = {};
  }

  const BoxNode& node(int i) const { return nodes_[std::size_t(i)]; }
  int child(int slot) const { return node(slot / box_lanes).child[slot % box_lanes]; }
  std::size_t bytes() const { return nodes_.size() * sizeof(BoxNode); }

 private:
  // The items' common box in this slot, and below it their tree. Every node but the last of a level
  // is full: its children hold as many items as trees of a height can.
  void put(int slot, int* items, int n) {
    Box box;
    for (int i = 0; i < n; ++i) box.add(boxes_[std::size_t(items[i])]);
    set(slot, box);
    if (n == 1) return set_child(slot, ~items[0]);
    const int at = int(nodes_.size());
    nodes_.push_back({});
    set_child(slot, at);
    int full = 1;
    while (full < (n + box_lanes - 1) / box_lanes) full *= box_lanes;
    int lane = 0;
    divide(items, n, full, [&](int* part, int size) { put(box_lanes * at + lane++, part, size); });
  }

  // Halves along the longest axis of the centres, at a multiple of `full`.
  template <class Take>
  void divide(int* items, int n, int full, const Take& take) {
    if (n <= full) return take(items, n);
    const int half = ((n + full - 1) / full + 1) / 2 * full;
    Box centres;
    for (int i = 0; i < n; ++i) centres.add(twice_centre(items[i]));
    const Vec3<double> d = centres.hi - centres.lo;
    const auto axis = d.x >= d.y && d.x >= d.z ? &Vec3<double>::x
                      : d.y >= d.z             ? &Vec3<double>::y
                                               : &Vec3<double>::z;
    std::nth_element(items, items + half, items + n, [&](int i, int j) {
      return twice_centre(i).*axis < twice_centre(j).*axis;
    });
    divide(items, half, full, take);
    divide(items + half, n - half, full, take);
  }

  Vec3<double> twice_centre(int item) const {
    const Box& b = boxes_[std::size_t(item)];
    return b.lo + b.hi;
  }

  // Coordinates are at most 1: the centre is rounded by 2^-24, the extent by less than is added.
  void set(int slot, const Box& box) {
    const Vec3<double> c = (box.lo + box.hi) * 0.5, e = (box.hi - box.lo) * 0.5;
    const double centre[3] = {c.x, c.y, c.z}, extent[3] = {e.x, e.y, e.z};
    BoxNode& node = nodes_[std::size_t(slot / box_lanes)];
    for (int i = 0; i < 3; ++i) {
      node.centre[i][slot % box_lanes] = float(centre[i]);
      node.extent[i][slot % box_lanes] = float(extent[i] + 0x1p-22);
    }
  }
  void set_child(int slot, int child) {
    nodes_[std::size_t(slot / box_lanes)].child[slot % box_lanes] = child;
  }

  std::vector<Box> boxes_;
  std::vector<BoxNode> nodes_;
};

// From one body's axes and centre to another's: x y is r x + between, in units of the sum of the
// radii. size_x, size_y: the radii of the two.
struct BoxPose {
  float r[9], between[3], size_x, size_y;

  BoxPose(const Mat3<double>& m, const Vec3<double>& t, double x, double y)
      : between{float(t.x), float(t.y), float(t.z)}, size_x(float(x)), size_y(float(y)) {
    for (int i = 0; i < 3; ++i) {
      const Vec3<double>& row = m.row[i];
      r[3 * i] = float(row.x), r[3 * i + 1] = float(row.y), r[3 * i + 2] = float(row.z);
    }
  }

  // In units u = 2^-24 of the sum of the radii, of which no coordinate here exceeds 2: the entries
  // of r are off by u, sums of three products by 5 u besides, `between` by 2 u, and each scaled
  // centre or extent by 2 u. Along an axis of the node all this is less than 20 u, along one of
  // the box less than 40 u. The margin is 128 u.
  static constexpr float margin = 0x1p-17f;

  void prepare(PosedBox& to) const {
    for (int i = 0; i < 9; ++i) to.r[i] = r[i], to.size_of_r[i] = std::fabs(r[i]);
    to.size = size_y;
  }

  void place(const BoxNode& node, int lane, PosedBox& to) const {
    float c[3], e[3];
    for (int i = 0; i < 3; ++i)
      c[i] = node.centre[i][lane] * size_x, e[i] = node.extent[i][lane] * size_x;
    for (int i = 0; i < 3; ++i) {
      const float *m = r + 3 * i, *s = to.size_of_r + 3 * i;
      to.centre[i] = m[0] * c[0] + m[1] * c[1] + m[2] * c[2] + between[i];
      to.extent[i] = s[0] * e[0] + s[1] * e[1] + s[2] * e[2] + margin;
      to.own[i] = e[i] + margin;
    }
  }
};

// Asks `meet(i, j)` of pairs of items whose boxes meet, until it says true; then true. forth: from
// A's axes to B's, back: the other way. pairs: of boxes compared.
template <class Meet>
bool meet_in_trees(const Tree& a, const Tree& b, const BoxPose& forth, const BoxPose& back,
                   std::int64_t& pairs, const Meet& meet) {
  struct Pair {
    int a, b;
  };
  // Each step takes one pair and adds no more than eight; a tree of 2^31 items has 12 levels.
  Pair stack[24 * box_lanes];
  int n = 0;
  stack[n++] = {Tree::root, Tree::root};
  PosedBox in_b, in_a;
  forth.prepare(in_b), back.prepare(in_a);
  while (n > 0) {
    const Pair at = stack[--n];
    const BoxNode &node_a = a.node(at.a / box_lanes), &node_b = b.node(at.b / box_lanes);
    const int lane_a = at.a % box_lanes, lane_b = at.b % box_lanes;
    const int child_a = node_a.child[lane_a], child_b = node_b.child[lane_b];
    if (child_a < 0 && child_b < 0) {
      if (meet(~child_a, ~child_b)) return true;
      continue;
    }
    const auto extent = [](const BoxNode& node, int lane) {
      return node.extent[0][lane] + node.extent[1][lane] + node.extent[2][lane];
    };
    const bool open_b =
        child_a < 0 || (child_b >= 0 && extent(node_b, lane_b) * forth.size_y >=
                                            extent(node_a, lane_a) * forth.size_x);
    alignas(32) float depth[box_lanes];
    unsigned found;
    if (open_b) {
      forth.place(node_a, lane_a, in_b);
      found = boxes_meet(b.node(child_b), in_b, depth);
    } else {
      back.place(node_b, lane_b, in_a);
      found = boxes_meet(a.node(child_a), in_a, depth);
    }
    pairs += box_lanes;
    const int first = n;
    for (; found; found &= found - 1) {
      const int lane = std::countr_zero(found);
      int i = n++;  // the deepest comes last, and is taken first
      const auto lane_at = [&](int j) { return (open_b ? stack[j].b : stack[j].a) % box_lanes; };
      for (; i > first && depth[lane_at(i - 1)] > depth[lane]; --i) stack[i] = stack[i - 1];
      stack[i] = open_b ? Pair{at.a, box_lanes * child_b + lane}
                        : Pair{box_lanes * child_a + lane, at.b};
    }
  }
  return false;
}

}  // namespace ofg::verified
