// What a timed method is: made once for two meshes and all poses, then asked pair by pair in one loop.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

struct Hull {
  std::vector<double> v;
  std::vector<std::int32_t> f;
};

// n pairs: rotation (row by row) and position of A, then of B.
struct Cell {
  std::string name;
  Hull a, b;
  std::vector<double> poses;  // 14 a pair: quaternion (w, x, y, z), position; twice
  std::size_t size() const { return poses.size() / 14; }
};

struct Timed {
  std::string name;
  std::function<long(const Cell&)> ask_all;  // hits
};

std::vector<Timed> fcl_methods(const Cell&);
std::vector<Timed> bullet_methods(const Cell&);
std::vector<Timed> mujoco_methods(const Cell&);
std::vector<Timed> lane_methods(const Cell&, const std::vector<const char*>& plugins);  // of baselines/native
