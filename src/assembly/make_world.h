// Makes a world from its configuration.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "assembly/sight_model.h"
#include "config/config.h"
#include "config/data_dir.h"  // so that a program built with the package finds its data
#include "emulator/world.h"
#include "physics/mujoco_world.h"
#include "robot/randomization.h"

namespace understudy::assembly {

// A line for a log.
struct Note {
  enum class Level : std::uint8_t { kDebug, kInfo, kWarning };
  Level level;
  std::string text;
};

struct MadePhysics {
  physics::MujocoWorld world;
  robot::Draws draws;       // values of config->randomization
  std::vector<Note> notes;  // on the models and the draws
  std::shared_ptr<const SightModel> sight;
};

// What was compiled of a configuration for one time step. Does not change, so threads may share it.
struct CompiledModel {
  mjcf::ModelHandle model;
  std::vector<robot::RobotSpec> specs;  // of the robots, with the names of the model
  std::vector<Note> notes;              // on the models
  std::shared_ptr<const physics::MujocoWorld::Scan> scan;  // null: the scene is none
};

// What the next worlds of a configuration take over from those before. Empty at first.
struct Reused {
  std::map<double, std::shared_ptr<const CompiledModel>> models;  // by time step [s]
  mjcf::DataHandle memory;  // of a world that is over; the next takes it
};

// Compiles robots and scene and draws the randomization. Updates `config` with the names of a
// third-party model and with the drawn seed, time step, delay and motors. `reused` serves
// further calls with configurations that differ in seeds alone; null: there are none.
// Throws ModelError.
MadePhysics MakePhysics(config::Config* config, Reused* reused = nullptr);

// Returns the ports of a robot by its number.
using PortsOf = std::function<emulator::Ports(std::size_t robot)>;

// Makes the world of a configuration on the physics that was made from it. Ports and `inbox` must
// outlive the world. Throws ConfigError for a planned fault that a robot cannot have.
std::unique_ptr<emulator::World> MakeWorld(physics::MujocoWorld physics,
                                           const config::Config& config, const PortsOf& ports,
                                           emulator::Inbox* inbox);

}  // namespace understudy::assembly
