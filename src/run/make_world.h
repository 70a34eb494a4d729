// The world of a run, from its configuration.
#pragma once

#include "config/config.h"
#include "mjcf/mujoco_handles.h"
#include "physics/world.h"
#include "robot/randomization.h"

namespace understudy::run {

struct MadeWorld {
  physics::World world;
  robot::Draws draws;  // what config->randomization asked for
};

// Compiles robot and scene, draws what is left to chance, and logs what is worth knowing of both.
// `config` becomes that of the run: it takes the names of a model that calls things otherwise, and
// the time step, delay and motors that were drawn. Throws ModelError.
MadeWorld MakeWorld(config::Config* config);

// The same world for whoever looks on (LoadSightModel), from the configuration that MakeWorld left.
// Takes some tens of ms, meshes of another hand longer. Throws ModelError.
mjcf::ModelHandle MakeSightModel(const config::Config& config);

}  // namespace understudy::run
