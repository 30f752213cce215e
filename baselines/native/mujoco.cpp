// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// MuJoCo from its wheel: mj_geomDistance on two geoms, as baselines/mujoco.py asks it.
//
// Where the geoms are is worked out beforehand, by mj_kinematics, as the transforms of the other
// engines are made beforehand.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "lane.hpp"

namespace {

using Frame = std::array<double, 24>;  // positions and matrices of both geoms

struct Mujoco final : lane::Engine {
  struct World {
    mjModel* model = nullptr;
    mjData* data = nullptr;
  };
  const int disable;
  const double tolerance;
  std::map<std::pair<std::uint32_t, std::uint32_t>, World> worlds;
  std::vector<World> of;      // per case
  std::vector<Frame> frames;  // per case

  Mujoco(const char* name, int flags, double t) : Engine(name), disable(flags), tolerance(t) {}
  ~Mujoco() override {
    for (auto& [pair, world] : worlds) mj_deleteData(world.data), mj_deleteModel(world.model);
  }

  static void add(mjSpec* spec, const char* name, const lane::Body& body) {
    mjsMesh* mesh = mjs_addMesh(spec, nullptr);
    const std::vector<float> points(body.vertices.begin(), body.vertices.end());
    mjs_setName(mesh->element, name);
    mjs_setFloat(mesh->uservert, points.data(), int(points.size()));
    mjs_setInt(mesh->userface, body.faces.data(), int(body.faces.size()));
    mjsBody* holder = mjs_addBody(mjs_findBody(spec, "world"), nullptr);
    holder->mocap = 1;
    mjsGeom* geom = mjs_addGeom(holder, nullptr);
    geom->type = mjGEOM_MESH;
    mjs_setString(geom->meshname, name);
  }

  void build(const std::vector<lane::Body>& bodies, const std::vector<lane::Case>& asked) override {
    for (const auto& c : asked) {
      auto [it, fresh] = worlds.try_emplace({c.a, c.b});
      if (fresh) {
        mjSpec* spec = mj_makeSpec();
        spec->option.disableflags |= disable;
        if (tolerance > 0)
          spec->option.ccd_tolerance = tolerance, spec->option.ccd_iterations = 1000;
        add(spec, "a", bodies[c.a]);
        add(spec, "b", bodies[c.b]);
        it->second.model = mj_compile(spec, nullptr);
        if (it->second.model) it->second.data = mj_makeData(it->second.model);
        mj_deleteSpec(spec);
      }
      of.push_back(it->second);
      frames.push_back(refuses(of.size() - 1) ? Frame() : placed(it->second, c));
    }
  }

  // The compiler refuses flat and tiny bodies.
  bool refuses(std::size_t i) const override { return !of[i].model; }

  static Frame placed(const World& world, const lane::Case& c) {
    const auto [model, data] = world;
    mju_copy3(data->mocap_pos, c.pose_a.p.data());
    mju_copy4(data->mocap_quat, c.pose_a.q.data());
    mju_copy3(data->mocap_pos + 3, c.pose_b.p.data());
    mju_copy4(data->mocap_quat + 4, c.pose_b.q.data());
    mj_kinematics(model, data);
    Frame frame;
    std::copy_n(data->geom_xpos, 6, frame.begin());
    std::copy_n(data->geom_xmat, 18, frame.begin() + 6);
    return frame;
  }

  lane::Verdict ask(std::size_t i) override {
    const auto [model, data] = of[i];
    std::memcpy(data->geom_xpos, frames[i].data(), 6 * sizeof(double));
    std::memcpy(data->geom_xmat, frames[i].data() + 6, 18 * sizeof(double));
    return {mj_geomDistance(model, data, 0, 1, 0, nullptr) < 0};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Mujoco>("mujoco", 0, 0));
  engines.push_back(std::make_unique<Mujoco>("mujoco-exact", 0, 1e-12));
  engines.push_back(std::make_unique<Mujoco>("mujoco-libccd", mjDSBL_NATIVECCD, 0));
}
