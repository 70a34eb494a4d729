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

// Returns the words that this key takes, of a switch true and false; none for one that takes
// numbers or any text, and for one that there is not.
std::vector<std::string> WordsOfKey(const std::string& key);

}  // namespace understudy::config
