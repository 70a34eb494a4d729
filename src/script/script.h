// Scripts: files that say what happens to a robot and when (docs/scripts.md).
#pragma once

#include <filesystem>
#include <vector>

#include "config/yaml_document.h"
#include "emulator/request.h"

namespace understudy::script {

// Whether a document is a script: a mapping with the key `script`.
bool IsScript(const config::YamlValue& document);

// The events of `script: [...]` in order of time; those of the same time in the file's order.
// Throws ConfigError with file, line, key, what was expected and what was found.
std::vector<emulator::ScriptEvent> ReadScript(const config::YamlValue& document);
std::vector<emulator::ScriptEvent> LoadScript(const std::filesystem::path& file);

}  // namespace understudy::script
