// Says what keys there are.
#ifndef UNDERSTUDY_CONFIG_REFERENCE_H_
#define UNDERSTUDY_CONFIG_REFERENCE_H_

#include <string>
#include <vector>

namespace understudy::config {

// One Markdown table per section: key, unit, allowed values, default, meaning. Keys are dotted, as
// --set takes them; [] in a key stands for the index of a list element.
std::string ConfigReference();

// All keys of that table, in its order.
std::vector<std::string> ConfigKeys();

}  // namespace understudy::config

#endif  // UNDERSTUDY_CONFIG_REFERENCE_H_
