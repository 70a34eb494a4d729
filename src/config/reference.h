// Writes docs/config.md's tables of keys.
#pragma once

#include <string>
#include <vector>

namespace understudy::config {

// Returns one Markdown table per section: key, unit, allowed values, default, meaning. Keys are
// dotted, as in --set; [] in a key stands for the index of a list element.
std::string ConfigReference();

// Returns all keys of those tables, in their order.
std::vector<std::string> ConfigKeys();

}  // namespace understudy::config
