// What has to fit together across keys.
#pragma once

#include "config/config.h"
#include "config/reader.h"

namespace understudy::config {

// Throws ConfigError at the first thing that does not fit: what ValidateTerrain and ValidateRobot
// refuse; rates that are no whole number of physics steps, or that rt/lowstate's rate is no
// multiple of; a motion service or a pose that the robot has not. `places` tells where each key was
// set.
void Validate(const Config& config, const Places& places = {});

// The part of it about scene and terrain: row without patches, patches that nothing asks for, sizes
// too small.
void ValidateTerrain(const Config& config, const Places& places = {});

}  // namespace understudy::config
