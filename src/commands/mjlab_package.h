// Writes a robot as a task of mjlab, which trains policies with MuJoCo Warp on graphics cards.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/config.h"

namespace understudy::commands {

// Writes a folder that is a Python package of that name: robot.xml, the model; figures.json, which
// has motors, noise, delay and what `config` draws at random; deploy.yaml, a copy of `definition`
// or, if that is empty, one of the robot's own gains and pose; and the code that makes a task of
// them (config/export/mjlab). Returns the draws that mjlab does not play, by their keys.
//
// Throws ModelError, SetupError where a file cannot be written, RecordError where the folder has
// something else, and ConfigError if the folder's
// name is none of a package, the robot does not walk on feet, or the definition does not fit it.
std::vector<std::string> WriteMjlabPackage(config::Config config,
                                           const std::filesystem::path& folder,
                                           const std::filesystem::path& definition);

}  // namespace understudy::commands
