// Reads single values of scenarios.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/yaml_document.h"

namespace understudy::rehearse {

// Throws ConfigError: "stand.yaml:3: key: expected what, got 'value'".
[[noreturn]] void Refuse(const config::YamlValue& value, const std::string& key,
                         const std::string& what);

// Throws ConfigError if the mapping has another key than these, with the nearest of them.
void RefuseOthers(const config::YamlValue& map, const std::vector<std::string>& known);

// Returns the value of an unquoted number, else nullopt.
std::optional<double> NumberOf(const config::YamlValue& value);

// Returns simulated seconds from 0 to 1000000. Throws ConfigError.
double SecondsOf(const config::YamlValue& value, const std::string& key);

// Returns a text of one line with 1 to `most` bytes. Throws ConfigError.
std::string LineOf(const config::YamlValue& value, const std::string& key, std::size_t most);

}  // namespace understudy::rehearse
