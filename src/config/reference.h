// Says what keys there are.
#pragma once

#include <string>
#include <vector>

namespace understudy::config {

// One Markdown table per section: key, unit, allowed values, default, meaning. Keys are dotted, as
// --set takes them; [] in a key stands for the index of a list element.
std::string ConfigReference();

// All keys of that table, in its order.
std::vector<std::string> ConfigKeys();

}  // namespace understudy::config
