// What the emulator takes of a configuration.
#ifndef UNDERSTUDY_CONFIG_SETTINGS_H_
#define UNDERSTUDY_CONFIG_SETTINGS_H_

#include "config/config.h"
#include "emulator/settings.h"

namespace understudy::config {

// `config` has been validated.
emulator::WorldSettings WorldSettingsOf(const Config& config);
emulator::RobotSettings RobotSettingsOf(const Config& config);

}  // namespace understudy::config

#endif  // UNDERSTUDY_CONFIG_SETTINGS_H_
