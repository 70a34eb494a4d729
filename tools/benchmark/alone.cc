#include "alone.h"

#include <stdexcept>

#include "config/load.h"
#include "config/model_files.h"
#include "physics/world_model.h"

namespace understudy::bench {
namespace {

physics::World PhysicsOf(const config::Config& config) {
  return {physics::LoadWorldModel({{config.robot, config::ModelFile(config.robot)}},
                                  config::SceneFile(config.scene, config.terrain).path(),
                                  config.physics.timestep),
          {{config.robot}}};
}

}  // namespace

Alone::Alone(const config::Config& config)
    : port_(robot::Rate(config.robot.rates.lowstate_hz, config.physics.timestep)),
      world_(PhysicsOf(config), config::WorldSettingsOf(config),
             {{.spec = config.robot, .settings = config::RobotSettingsOf(config), .port = &port_}},
             &inbox_) {}

void Alone::Ask(std::string_view name, const nlohmann::json& values) {
  const auto request = emulator::ReadRequest(name, values);
  if (!request) throw std::runtime_error(request.why());
  inbox_.Put(*request, emulator::Inbox::WallTime::max());
}

void Alone::Step() {
  if (world_.Tick({}) != physics::StepHealth::kFine) throw std::runtime_error("diverged");
}

}  // namespace understudy::bench
