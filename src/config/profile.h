// How good the sensors of a run are: files of configuration below config/profiles.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "schema/yaml_document.h"

namespace understudy::config {

using schema::YamlValue;

// The profile of a run that asks for none.
inline constexpr char kUsualProfile[] = "nominal";

// Returns the names of all profiles, sorted.
std::vector<std::string> ProfileNames(const std::filesystem::path& data_dir);

// Puts the profile that the last of `trees` asks for with the key `profile`, else the usual one, in
// its place among them: above the first `own`, which are the robot's, where one after these asks
// for it, else below all, so that a robot's file may refine what it chooses. Returns its name, and
// "" if nothing asks for one and there is none. Throws ConfigError for an unknown one.
std::string AddProfile(const std::filesystem::path& data_dir, std::size_t own,
                       std::vector<YamlValue>* trees);

}  // namespace understudy::config
