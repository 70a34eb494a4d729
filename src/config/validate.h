// Checks conditions that span several keys.
#pragma once

#include "config/config.h"
#include "schema/yaml_reader.h"

namespace understudy::config {

using schema::Places;

// For a configuration of one robot, as LoadConfig makes one of each robot of a world before it
// joins them. Throws ConfigError for the first failed condition: those of ValidateTerrain and
// ValidateRobot; periods of rates must be whole numbers of physics steps, and lowstate_hz a
// multiple of the other rates; objects must have names of their own; the robot must have the
// motion service, the pose and what is to fail. `places` has where each key was set.
void Validate(const Config& config, const Places& places = {});

// The conditions on scene and terrain: refuses row without patches, patches without row, and sizes
// that are too small.
void ValidateTerrain(const Config& config, const Places& places = {});

}  // namespace understudy::config
