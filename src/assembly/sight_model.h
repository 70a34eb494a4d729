// The model of a world as viewers see it.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "config/config.h"
#include "mjcf/mujoco_handles.h"
#include "physics/robot_body.h"

namespace understudy::assembly {

// Returns the robots of a configuration with their model files and places in the world, by number.
std::vector<physics::PlacedRobot> PlacedRobots(const config::Config& config);

// Compiles that model (physics::LoadSightModel) when it is first needed and shares it.
class SightModel {
 public:
  // `config` is the one that MakePhysics has updated.
  explicit SightModel(config::Config config);

  // Returns the model, from any thread but the tick's. The first call takes some tens of ms, with
  // large meshes longer. Throws ModelError.
  std::shared_ptr<const mjModel> Get() const;

 private:
  config::Config config_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const mjModel> model_;  // null before it is needed
};

}  // namespace understudy::assembly
