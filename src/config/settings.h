// What the emulator takes of a configuration.
#pragma once

#include "config/config.h"
#include "emulator/settings.h"

namespace understudy::config {

// `config` has been validated.
emulator::WorldSettings WorldSettingsOf(const Config& config);
emulator::RobotSettings RobotSettingsOf(const Config& config);

}  // namespace understudy::config
