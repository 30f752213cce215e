// The native lane: the same cases as the Python lane, asked of the libraries themselves.
//
// Each engine is a plugin of its own (a shared library), opened apart from the others: they carry copies of the same dependencies in
// different versions, and one that is not installed is simply not built.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lane {

struct Body {
  std::vector<double> vertices;  // 3 n
  std::vector<std::int32_t> faces;  // 3 m
  std::size_t n() const { return vertices.size() / 3; }
  std::size_t m() const { return faces.size() / 3; }
};

struct Pose {
  std::array<double, 4> q;  // w x y z, of length 1
  std::array<double, 3> p;

  std::array<double, 9> matrix() const {  // row by row
    const auto [w, x, y, z] = q;
    return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)};
  }
};

enum class Question : std::uint32_t { overlap, translation, motion };

struct Case {
  std::uint32_t a, b;
  Question question;
  Pose pose_a, pose_b;
  std::array<double, 3> displacement, axis;  // axis of length 1
  double angle;
};

struct Verdict {
  bool hit;
  double time = std::nan("");
};

// One engine in one configuration. `build` makes what a user makes once per body and per case; `ask` is timed.
struct Engine {
  explicit Engine(std::string n) : name(std::move(n)) {}
  virtual ~Engine() = default;
  virtual bool answers(Question question) const { return question == Question::overlap; }
  virtual void build(const std::vector<Body>& bodies, const std::vector<Case>& cases) = 0;
  virtual Verdict ask(std::size_t i) = 0;

  const std::string name;  // as the method of the Python lane that asks the same
};

using Engines = std::vector<std::unique_ptr<Engine>>;

}  // namespace lane

// What a plugin defines.
extern "C" void lane_engines(lane::Engines& engines);
