// What the keys take that can change while a robot runs.
#pragma once

#include <vector>

#include "emulator/settings.h"

namespace understudy::config {

// Returns a key for each of emulator::LiveSettings(), in its order, with the unit, range and words
// by which the configuration is read.
std::vector<emulator::SettingKey> SettingKeys();

}  // namespace understudy::config
