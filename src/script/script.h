// Reads scripts: YAML lists of timed events for a robot (docs/scripts.md).
#pragma once

#include <filesystem>
#include <vector>

#include "config/yaml_document.h"
#include "emulator/request.h"

namespace understudy::script {

// Returns whether a document is a script: a mapping with the key `script`.
bool IsScript(const config::YamlValue& document);

// Return the events of a list, or of the document or file `script: [...]`, in order of time, events
// of the same time in the file's order. Throw ConfigError with file, line, key, what was expected
// and what was found.
std::vector<emulator::ScriptEvent> ReadEvents(const config::YamlValue& list);
std::vector<emulator::ScriptEvent> ReadScript(const config::YamlValue& document);
std::vector<emulator::ScriptEvent> LoadScript(const std::filesystem::path& file);

}  // namespace understudy::script
