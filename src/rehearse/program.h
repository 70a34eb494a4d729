// Reads what a scenario says of the program under test.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "schema/yaml_document.h"

namespace understudy::rehearse {

// The program under test.
struct Program {
  std::vector<std::string> command{};  // empty: that of the command line
  double at = 0;                       // simulated s of its start
  std::optional<double> until{};       // simulated s at which it is ended
  bool kill = false;                   // by SIGKILL; else by SIGTERM, and SIGKILL 0.5 s after that
  std::optional<double> limit{};  // simulated s from its start in which it has to end by itself
  double think = 0;               // s from the end of a sleep to its next message, on its own clock
};

// Reads the value of the key `program`. Throws ConfigError.
Program ReadProgram(const schema::YamlValue& value);

// Returns the time [simulated s] from its start in which the program has to end by itself; nullopt
// where something else ends the rehearsal.
std::optional<double> LimitOf(const Program& program, const config::Config& config);

// Returns the keys of a program as rows of Markdown's table of scenario keys.
std::string ProgramReference();

}  // namespace understudy::rehearse
