// Gives a robot the hands that robot.hand_make chooses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "schema/yaml_document.h"

namespace understudy::config {

// Returns the layer that sets robot.hands as `asked` says: NAME for both sides, left:NAME or
// right:NAME for one, both after a comma; none for no hands. A name is one of `makes` and has a
// file in data_dir/config/hands. Of a file whose hands share messages, one side keeps its slots.
// `robot_models` are the robot's model and those of the robots that it extends: a model of its name
// in the folder `hands` beside the first of them that has one replaces a hand's. Throws
// ConfigError, which begins with the place of `asked`.
schema::YamlValue HandsOf(const schema::YamlValue& asked, const std::vector<std::string>& makes,
                          const std::vector<std::string>& robot_models,
                          const std::filesystem::path& data_dir);

}  // namespace understudy::config
