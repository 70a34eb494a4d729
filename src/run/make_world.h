// Makes the world of a run from its configuration.
#pragma once

#include "config/config.h"
#include "mjcf/mujoco_handles.h"
#include "physics/world.h"
#include "robot/randomization.h"

namespace understudy::run {

struct MadeWorld {
  physics::World world;
  robot::Draws draws;  // values of config->randomization
};

// Compiles robot and scene, draws the randomization and logs notes about both. Updates `config`
// with the names of a third-party model and with the drawn time step, delay and motors. Throws
// ModelError.
MadeWorld MakeWorld(config::Config* config);

// Makes the same world for viewers (LoadSightModel), from the configuration that MakeWorld updated.
// Takes some tens of ms, with large meshes longer. Throws ModelError.
mjcf::ModelHandle MakeSightModel(const config::Config& config);

}  // namespace understudy::run
