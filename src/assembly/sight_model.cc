#include "assembly/sight_model.h"

#include <utility>

#include <malloc.h>

#include "config/model_files.h"
#include "physics/world_model.h"

namespace understudy::assembly {

std::vector<physics::PlacedRobot> PlacedRobots(const config::Config& config) {
  std::vector<physics::PlacedRobot> placed;
  for (const config::RobotConfig& robot : config.robots) {
    const auto& [x, y, yaw] = robot.start.at;
    placed.push_back({.spec = robot.spec,
                      .file = config::ModelFile(robot.spec),
                      .hands = config::HandModelFiles(robot.spec),
                      .prefix = config.PrefixOf(robot),
                      .x = x,
                      .y = y,
                      .yaw = yaw});
  }
  return placed;
}

SightModel::SightModel(config::Config config) : config_(std::move(config)) {}

std::shared_ptr<const mjModel> SightModel::Get() const {
  const std::lock_guard lock(mutex_);
  if (model_ == nullptr) {
    const config::SceneFile scene(config_.scene, config_.terrain);
    std::vector<std::string> looks;
    for (const config::RobotConfig& robot : config_.robots) looks.push_back(robot.look);
    model_ = physics::LoadSightModel(PlacedRobots(config_), {scene.sight(), config_.objects},
                                     config_.physics.timestep, looks);
    malloc_trim(0);  // compiling needs many times the memory of the result
  }
  return model_;
}

}  // namespace understudy::assembly
