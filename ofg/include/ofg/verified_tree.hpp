// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A tree of oriented boxes, eight to a node, over the faces or the pieces of a body; and the pairs
// of items of two such trees whose boxes meet, the deepest first.
#pragma once
#include <algorithm>
#include <bit>

#include "simd/boxes.hpp"
#include "verified_box.hpp"

namespace ofg::verified {

// Points of each item, those of item i from first[i] to first[i + 1], relative to the body's centre
// in units of its radius.
struct Items {
  std::vector<Vec3<double>> points;
  std::vector<int> first{0}, name;

  void end(int named) { first.push_back(int(points.size())), name.push_back(named); }
  int size() const { return int(name.size()); }
};

class Tree {
 public:
  // A box is named by its slot: box_lanes times its node, and its lane. The first node has one.
  static constexpr int root = 0;

  Tree() = default;

  explicit Tree(const Items& items) {
    std::vector<int> order(std::size_t(items.size()));
    for (int i = 0; i < items.size(); ++i) {
      order[std::size_t(i)] = i;
      Vec3<double> sum;
      for (int j = items.first[std::size_t(i)]; j < items.first[std::size_t(i) + 1]; ++j)
        sum = sum + items.points[std::size_t(j)];
      middles_.push_back(sum *
                         (1.0 / (items.first[std::size_t(i) + 1] - items.first[std::size_t(i)])));
    }
    nodes_.push_back({});
    put(items, root, order.data(), items.size());
    middles_ = {};
  }

  const BoxNode& node(int i) const { return nodes_[std::size_t(i)]; }
  std::size_t bytes() const { return nodes_.size() * sizeof(BoxNode); }

 private:
  // The items' common box in this slot, and below it their tree. Every node but the last of a level
  // is full: its children hold as many items as trees of a height can.
  void put(const Items& items, int slot, int* order, int n) {
    set(slot, box_of([&](const auto& take) {
          for (int i = 0; i < n; ++i)
            for (int j = items.first[std::size_t(order[i])];
                 j < items.first[std::size_t(order[i]) + 1]; ++j)
              take(items.points[std::size_t(j)]);
        }));
    if (n == 1) return set_child(slot, ~items.name[std::size_t(order[0])]);
    const int at = int(nodes_.size());
    nodes_.push_back({});
    set_child(slot, at);
    int full = 1;
    while (full < (n + box_lanes - 1) / box_lanes) full *= box_lanes;
    int lane = 0;
    divide(order, n, full,
           [&](int* part, int size) { put(items, box_lanes * at + lane++, part, size); });
  }

  // Halves along the longest axis of the middles, at a multiple of `full`.
  template <class Take>
  void divide(int* order, int n, int full, const Take& take) {
    if (n <= full) return take(order, n);
    const int half = ((n + full - 1) / full + 1) / 2 * full;
    const auto middle = [&](int i) -> const Vec3<double>& { return middles_[std::size_t(i)]; };
    const Vec3<double> axis = box_of([&](const auto& point) {
                                for (int i = 0; i < n; ++i) point(middle(order[i]));
                              }).longest();
    std::nth_element(order, order + half, order + n,
                     [&](int i, int j) { return dot(axis, middle(i)) < dot(axis, middle(j)); });
    divide(order, half, full, take);
    divide(order + half, n - half, full, take);
  }

  // Coordinates are at most 1: with the centre and the axes rounded, a point of the box is off by
  // 5 units of 2^-24 along each axis, and the extent by 1: less than is added.
  void set(int slot, const Box& box) {
    BoxNode& node = nodes_[std::size_t(slot / box_lanes)];
    const int lane = slot % box_lanes;
    const double extent[3] = {box.extent.x, box.extent.y, box.extent.z};
    for (int i = 0; i < 3; ++i) {
      const float at[3] = {float(box.axis[i].x), float(box.axis[i].y), float(box.axis[i].z)};
      for (int k = 0; k < 3; ++k) node.axis[3 * i + k][lane] = at[k];
      node.extent[i][lane] = float(extent[i] + 0x1p-20);
    }
    node.centre[0][lane] = float(box.centre.x), node.centre[1][lane] = float(box.centre.y),
    node.centre[2][lane] = float(box.centre.z);
  }
  void set_child(int slot, int child) {
    nodes_[std::size_t(slot / box_lanes)].child[slot % box_lanes] = child;
  }

  std::vector<Vec3<double>> middles_;
  std::vector<BoxNode> nodes_;
};

// From one body's axes and centre to another's: x is r x + between, in units of the sum of the
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

  // In units u = 2^-24 of the sum of the radii; no coordinate here exceeds 2. r is off by u an
  // entry, so turned axes and centres by 8 u with their sums, `between` by 2 u and the differences
  // of centres by 14 u in all. Products of two such axes are off by 14 u, of an axis and a
  // difference, of a length up to 4, by 60 u; three products of extents by 50 u. The margin is 256
  // u.
  static constexpr float margin = 0x1p-16f;

  void place(const BoxNode& node, int lane, PosedBox& to) const {
    const auto turn = [this](const float* v, float* w) {
      for (int i = 0; i < 3; ++i)
        w[i] = r[3 * i] * v[0] + r[3 * i + 1] * v[1] + r[3 * i + 2] * v[2];
    };
    float c[3];
    for (int i = 0; i < 3; ++i) {
      c[i] = node.centre[i][lane] * size_x, to.extent[i] = node.extent[i][lane] * size_x + margin;
      const float axis[3] = {node.axis[3 * i][lane], node.axis[3 * i + 1][lane],
                             node.axis[3 * i + 2][lane]};
      turn(axis, to.axis + 3 * i);
    }
    turn(c, to.centre);
    for (int i = 0; i < 3; ++i) to.centre[i] += between[i];
    to.size = size_y, to.margin = margin;
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
  PosedBox box;
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
    const bool open_b = child_a < 0 || (child_b >= 0 && extent(node_b, lane_b) * forth.size_y >=
                                                            extent(node_a, lane_a) * forth.size_x);
    alignas(32) float depth[box_lanes];
    unsigned found;
    if (open_b) {
      forth.place(node_a, lane_a, box);
      found = boxes_meet(b.node(child_b), box, depth);
    } else {
      back.place(node_b, lane_b, box);
      found = boxes_meet(a.node(child_a), box, depth);
    }
    pairs += box_lanes;
    const int first = n;
    for (; found; found &= found - 1) {
      const int lane = std::countr_zero(found);
      int i = n++;  // the deepest comes last, and is taken first
      const auto lane_at = [&](int j) { return (open_b ? stack[j].b : stack[j].a) % box_lanes; };
      for (; i > first && depth[lane_at(i - 1)] > depth[lane]; --i) stack[i] = stack[i - 1];
      stack[i] =
          open_b ? Pair{at.a, box_lanes * child_b + lane} : Pair{box_lanes * child_a + lane, at.b};
    }
  }
  return false;
}

// Calls `take` with the items whose boxes a ray along x may meet that ends four radii on. margin:
// of where it runs, besides rounding.
template <class Take>
void meet_ray(const Tree& tree, const Vec3<double>& from, double margin, std::int64_t& pairs,
              const Take& take) {
  const float half = 3, wide = float(margin) + BoxPose::margin;
  const PosedBox ray{{float(from.x) + half, float(from.y), float(from.z)},
                     {half + wide, wide, wide},
                     {1, 0, 0, 0, 1, 0, 0, 0, 1},
                     1,
                     4 * BoxPose::margin};
  int stack[12 * box_lanes], n = 0;
  stack[n++] = Tree::root;
  while (n > 0) {
    const BoxNode& node = tree.node(stack[--n]);
    alignas(32) float depth[box_lanes];
    pairs += box_lanes;
    for (unsigned found = boxes_meet(node, ray, depth); found; found &= found - 1) {
      const int child = node.child[std::countr_zero(found)];
      if (child < 0)
        take(~child);
      else
        stack[n++] = child;
    }
  }
}

}  // namespace ofg::verified
