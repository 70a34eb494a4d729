// Reads scenarios: what a rehearsal plays, and what is expected of it (docs/rehearsing.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/load.h"
#include "config/yaml_document.h"
#include "rehearse/expectations.h"
#include "script/script.h"

namespace understudy::rehearse {

// The program under test.
struct Program {
  std::vector<std::string> command{};  // empty: that of the command line
  double at = 0;                       // simulated s of its start
  std::optional<double> until{};       // simulated s at which it is ended
  bool kill = false;                   // by SIGKILL; else by SIGTERM, and SIGKILL 0.5 s after that
};

struct Scenario {
  std::filesystem::path file;
  std::string name{};
  std::string about{};
  config::Config config{};
  script::Script script{};
  std::optional<Program> program{};
  Expectations expect{};
};

// What the command line adds.
struct ScenarioOptions {
  std::vector<std::string> command{};  // of the program under test, in place of the scenario's
  std::vector<std::string> sets{};     // KEY=VALUE
};

// Returns whether a document is a scenario, or only expectations: a mapping with the key `expect`.
bool IsScenario(const config::YamlValue& document);

// Reads a scenario. Time is as fast as possible and the network lo of domain 0 unless it says
// otherwise. Throws ConfigError with file, line, key, what was expected and the nearest word.
Scenario LoadScenario(const std::filesystem::path& file, const ScenarioOptions& options = {});

// Reads only what is expected, of a scenario or of a file with nothing else. If it names no robot,
// `robot` with its revision is meant, "" if that is not known either. Throws ConfigError.
Expectations LoadExpectations(const std::filesystem::path& file, const std::string& robot,
                              const std::string& revision);

// Returns the keys of a scenario as Markdown.
std::string ScenarioReference();

}  // namespace understudy::rehearse
