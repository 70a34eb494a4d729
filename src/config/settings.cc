#include "config/settings.h"

namespace understudy::config {

emulator::WorldSettings WorldSettingsOf(const Config& config) {
  return {.speed = config.time.speed,
          .reset_on_divergence = config.physics.on_divergence == DivergenceAction::kReset};
}

emulator::RobotSettings RobotSettingsOf(const Config& config) {
  const std::string& pose =
      config.start.pose.empty() ? config.robot.default_start : config.start.pose;
  return {.sensors = config.sensors,
          .gate = config.gate,
          .motion = config.motion,
          .crane = config.crane,
          .start = robot::FindStartPose(pose).value_or(robot::StartPose::kLying)};
}

}  // namespace understudy::config
