#include <mujoco.h>

#include <cstring>

#include "bench.hpp"

namespace {

// Two mocap bodies with a mesh each; the poses of the geoms are worked out beforehand, so that only the distance is timed.
struct World {
  mjModel* m;
  mjData* d;
  std::vector<double> frames;  // 24 a pair: positions and matrices of both geoms

  World(const Cell& cell, bool native) {
    mjSpec* spec = mj_makeSpec();
    const Hull* hulls[2] = {&cell.a, &cell.b};
    for (int i = 0; i < 2; ++i) {
      const char* name = i ? "b" : "a";
      mjsMesh* mesh = mjs_addMesh(spec, nullptr);
      mjs_setName(mesh->element, name);
      std::vector<float> v(hulls[i]->v.begin(), hulls[i]->v.end());
      mjs_setFloat(mesh->uservert, v.data(), int(v.size()));
      mjs_setInt(mesh->userface, hulls[i]->f.data(), int(hulls[i]->f.size()));
      mjsBody* body = mjs_addBody(mjs_findBody(spec, "world"), nullptr);
      body->mocap = 1;
      mjsGeom* geom = mjs_addGeom(body, nullptr);
      geom->type = mjGEOM_MESH;
      mjs_setString(geom->meshname, name);
    }
    m = mj_compile(spec, nullptr);
    if (!m) mju_error("MuJoCo refuses the meshes: %s", mjs_getError(spec));
    if (!native) m->opt.disableflags |= mjDSBL_NATIVECCD;
    d = mj_makeData(m);
    for (std::size_t i = 0; i < cell.poses.size(); i += 14) {
      for (int j = 0; j < 2; ++j) {
        std::memcpy(d->mocap_quat + 4 * j, &cell.poses[i + 7 * std::size_t(j)], 4 * sizeof(double));
        std::memcpy(d->mocap_pos + 3 * j, &cell.poses[i + 7 * std::size_t(j) + 4], 3 * sizeof(double));
      }
      mj_kinematics(m, d);
      frames.insert(frames.end(), d->geom_xpos, d->geom_xpos + 6);
      frames.insert(frames.end(), d->geom_xmat, d->geom_xmat + 18);
    }
  }

  long ask_all() const {
    long hits = 0;
    for (std::size_t i = 0; i < frames.size(); i += 24) {
      std::memcpy(d->geom_xpos, &frames[i], 6 * sizeof(double));
      std::memcpy(d->geom_xmat, &frames[i + 6], 18 * sizeof(double));
      hits += mj_geomDistance(m, d, 0, 1, 1e-10, nullptr) < 0;
    }
    return hits;
  }
};

}  // namespace

std::vector<Timed> mujoco_methods(const Cell& cell) {
  std::vector<Timed> out;
  for (const bool native : {true, false}) {
    const auto world = std::make_shared<World>(cell, native);
    out.push_back({native ? "MuJoCo native" : "MuJoCo libccd", [world](const Cell&) { return world->ask_all(); }});
  }
  return out;
}
