// Describes the keys of the configuration; writes docs/reference/config.md.
#pragma once

#include <string>
#include <vector>

#include "schema/entries.h"

namespace understudy::config {

// Returns one Markdown table per section: key, unit, allowed values, default, meaning. Keys are
// dotted, as in --set; [] in a key stands for the index of a list element.
std::string ConfigReference();

// Return all rows of those tables in order of appearance, and their keys.
std::vector<schema::Entry> ConfigEntries();
std::vector<std::string> ConfigKeys();

// Returns the row of each of emulator::LiveSettings(), the keys that can change while a robot runs,
// in its order.
const std::vector<schema::Entry>& SettingKeys();

// Returns the words that this key takes, of a switch false and true; none for one that takes
// numbers or any text, and for one that there is not.
std::vector<std::string> WordsOfKey(const std::string& key);

}  // namespace understudy::config
