// Reads single values of scenarios.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/yaml_reader.h"

namespace understudy::rehearse {

using schema::Refuse;
using schema::RefuseOthers;

// Returns the value of an unquoted number, else nullopt.
std::optional<double> NumberOf(const schema::YamlValue& value);

inline constexpr double kLatestTime = 1e6;  // simulated s; *assumed*

// Returns simulated seconds from 0 to kLatestTime. Throws ConfigError.
double SecondsOf(const schema::YamlValue& value, const std::string& key);

// Returns a text of one line with 1 to `most` bytes. Throws ConfigError.
std::string LineOf(const schema::YamlValue& value, const std::string& key, std::size_t most);

}  // namespace understudy::rehearse
