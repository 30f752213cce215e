// MuJoCo from its wheel: mj_geomDistance on mocap bodies, as the Python lane asks it.
#include <mujoco/mujoco.h>

#include <map>

#include "lane.hpp"

namespace {

struct Mujoco final : lane::Engine {
  struct World {
    mjModel* model;
    mjData* data;
  };
  const int disable;
  const double tolerance;
  std::map<std::pair<std::uint32_t, std::uint32_t>, World> worlds;
  std::vector<World> of;  // per case
  std::vector<lane::Case> cases;

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
    cases = asked;
    for (const auto& c : cases) {
      auto [it, fresh] = worlds.try_emplace({c.a, c.b});
      if (fresh) {
        mjSpec* spec = mj_makeSpec();
        spec->option.disableflags |= disable;
        if (tolerance > 0) spec->option.ccd_tolerance = tolerance, spec->option.ccd_iterations = 1000;
        add(spec, "a", bodies[c.a]);
        add(spec, "b", bodies[c.b]);
        it->second.model = mj_compile(spec, nullptr);
        if (!it->second.model) std::fprintf(stderr, "lane: mujoco: %s\n", mjs_getError(spec)), std::exit(2);
        it->second.data = mj_makeData(it->second.model);
        mj_deleteSpec(spec);
      }
      of.push_back(it->second);
    }
  }

  lane::Verdict ask(std::size_t i) override {
    const auto [model, data] = of[i];
    const lane::Case& c = cases[i];
    mju_copy3(data->mocap_pos, c.pose_a.p.data());
    mju_copy4(data->mocap_quat, c.pose_a.q.data());
    mju_copy3(data->mocap_pos + 3, c.pose_b.p.data());
    mju_copy4(data->mocap_quat + 4, c.pose_b.q.data());
    mj_kinematics(model, data);
    return {mj_geomDistance(model, data, 0, 1, 0, nullptr) < 0};
  }
};

}  // namespace

extern "C" void lane_engines(lane::Engines& engines) {
  engines.push_back(std::make_unique<Mujoco>("mujoco", 0, 0));
  engines.push_back(std::make_unique<Mujoco>("mujoco-exact", 0, 1e-12));
  engines.push_back(std::make_unique<Mujoco>("mujoco-libccd", mjDSBL_NATIVECCD, 0));
}
