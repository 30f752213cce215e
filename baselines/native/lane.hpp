// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The native lane: engines asked from C++, timed against each other by `lane` (main.cpp).
//
// Each engine is a plugin of its own (a shared library), opened apart from the others: they carry
// copies of the same dependencies in different versions, and one that is not installed is simply
// not built.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// What the CMake file says of a plugin: the instruction set it is compiled for, and who built the
// library.
#ifndef LANE_ISA
#define LANE_ISA "generic"
#endif
#ifndef LANE_BUILD
#define LANE_BUILD "built here"
#endif

namespace lane {

struct Body {
  std::vector<double> vertices;     // 3 n
  std::vector<std::int32_t> faces;  // 3 m
  double radius = 0;                // of its frame's origin to the farthest vertex
  bool convex = true;               // else a closed mesh, or the faces of all pieces
  std::vector<Body> pieces;         // convex, of a union alone
  std::size_t n() const { return vertices.size() / 3; }
  std::size_t m() const { return faces.size() / 3; }
};

struct Pose {
  std::array<double, 4> q;  // w x y z, of length 1
  std::array<double, 3> p;

  std::array<double, 9> matrix() const {  // row by row
    const auto [w, x, y, z] = q;
    return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
            2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  }
};

enum class Question : std::uint32_t { overlap, translation, motion };

struct Case {
  std::uint32_t a, b;
  Question question;
  Pose pose_a, pose_b;
  std::array<double, 3> displacement, axis;  // axis of length 1
  double angle;

  // Where A is at a share t of the step; it turns about its own origin.
  Pose at(double t) const {
    Pose pose = pose_a;
    for (int i = 0; i < 3; ++i) pose.p[i] += t * displacement[i];
    if (angle == 0) return pose;
    const double s = std::sin(angle * t / 2), w = std::cos(angle * t / 2);
    const double x = s * axis[0], y = s * axis[1], z = s * axis[2];
    const auto [a, b, c, d] = pose_a.q;
    pose.q = {w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c,
              w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a};
    return pose;
  }
};

struct Verdict {
  bool hit;
  double time = std::nan("");
};

// How a cell is asked. cold: every pair of bodies once. warm: many poses of one pair, call by call.
// batch: the same in one call. coherent: poses along a trajectory, with what the engine remembers.
enum class Mode { cold, warm, batch, coherent };

// One engine in one configuration. `build` makes what a user makes once per body and per case;
// `ask` and `ask_many` are timed, the rest is not.
struct Engine {
  explicit Engine(std::string n) : name(std::move(n)) {}
  virtual ~Engine() = default;
  virtual bool answers(Question question) const { return question == Question::overlap; }
  virtual bool stands(Mode mode) const { return mode != Mode::batch; }
  virtual bool takes_meshes() const { return false; }  // closed and not convex
  virtual bool takes_hulls() const { return true; }
  virtual bool takes_unions() const { return false; }
  virtual void build(const std::vector<Body>& bodies, const std::vector<Case>& cases) = 0;
  virtual bool refuses(std::size_t) const { return false; }  // a case, once it is built
  virtual Verdict ask(std::size_t i) = 0;
  virtual void ask_many(std::size_t, std::size_t, Verdict*) {}  // n cases from the first on
  virtual void turn() {}                                        // before its turn in each round
  virtual void forget() {}  // what it remembers, before each trajectory
  // The method whose unit of units.csv it gets.
  virtual std::string asked_as() const { return name.substr(0, name.find(' ')); }
  virtual long long bytes() const { return -1; }  // of all its bodies, once built; -1: unknown

  const std::string name;  // of the method of the Python lane that asks the same, if there is one
  std::string isa = LANE_ISA, build_of = LANE_BUILD;
  double length = 0;  // the unit of units.csv: radius that the smaller body gets; 0: as stated
};

// One that stands only where poses follow each other closely, as it remembers the last.
struct Remembering : Engine {
  using Engine::Engine;
  bool stands(Mode mode) const override { return mode == Mode::coherent; }
};

// One that tests surfaces: each pair of bodies once, as it is far slower than hulls. A union is the
// faces of all its pieces.
struct Surfaces : Engine {
  using Engine::Engine;
  bool stands(Mode mode) const override { return mode == Mode::cold; }
  bool takes_meshes() const override { return true; }
  bool takes_unions() const override { return true; }
};

// One that tests the pieces of unions. Convex bodies are asked elsewhere.
struct Unions : Engine {
  using Engine::Engine;
  bool stands(Mode mode) const override { return mode == Mode::cold; }
  bool takes_hulls() const override { return false; }
  bool takes_unions() const override { return true; }
};

using Engines = std::vector<std::unique_ptr<Engine>>;

}  // namespace lane

// What a plugin defines.
extern "C" void lane_engines(lane::Engines& engines);
