// A first scenario for one's program (`rehearse --init`).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace understudy::commands {

// Writes a scenario that runs `command` with the standard set, says what to do next and returns the
// exit code. Throws ConfigError if the file is there already.
int WriteFirstScenario(const std::filesystem::path& file, const std::vector<std::string>& command);

}  // namespace understudy::commands
