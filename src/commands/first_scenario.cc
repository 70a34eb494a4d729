#include "commands/first_scenario.h"

#include <cstdio>
#include <system_error>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/files.h"

namespace understudy::commands {

namespace fs = std::filesystem;

int WriteFirstScenario(const fs::path& file, const std::vector<std::string>& command) {
  std::error_code error;
  if (fs::exists(file, error)) {
    throw ConfigError(file.string() + ": is there already; choose another name, or remove it");
  }
  WriteFile(file,
            "# docs/rehearsing.md says what else one can ask for.\n"
            "scenario: " +
                std::string(file.stem()) +
                "\n"
                "robot: go2         # `understudy robots` lists them\n"
                "start: standing\n"
                "program:\n"
                "  command: " +
                nlohmann::json(command).dump() +
                "\n"
                "expect:\n"
                "  - safe           # upright, nothing refused, no damage beyond its limit\n"
                "  - eventually: program.exit_code is 0\n");
  std::printf("%s: a first scenario; next: understudy check %s; understudy rehearse %s\n",
              file.c_str(), file.c_str(), file.c_str());
  return 0;
}

}  // namespace understudy::commands
