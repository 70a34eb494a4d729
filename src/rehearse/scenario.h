// Reads scenarios: what a rehearsal plays, and what is expected of it
// (docs/reference/scenarios.md).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/load.h"
#include "rehearse/expectations.h"
#include "rehearse/program.h"
#include "rehearse/stages.h"
#include "rehearse/vary.h"
#include "schema/yaml_document.h"
#include "script/script.h"

namespace understudy::rehearse {

struct Scenario {
  std::filesystem::path file;
  std::string name{};
  std::string about{};
  config::Config config{};
  script::Script script{};
  std::optional<Program> program{};
  bool simulated_clock = false;  // of the program
  Expectations expect{};
  std::vector<StageSpec> stages{};  // may be empty
  std::optional<Plan> plan{};       // of a campaign
  std::size_t run = 0;              // the run of it that this is; 0 without a plan
  std::vector<Setting> settings{};  // of that run
};

// What the command line adds.
struct ScenarioOptions {
  std::vector<std::string> command{};  // of the program under test, in place of the scenario's
  std::vector<std::string> sets{};     // KEY=VALUE
  std::size_t run = 0;                 // of a campaign; 0: none was chosen
  bool simulated_clock = false;        // also where the scenario does not say so
  std::map<std::string, std::string> typed{};  // as config::Layers has it
};

// Returns whether a document is a scenario, or only expectations: a mapping with the key `expect`.
bool IsScenario(const schema::YamlValue& document);

// Reads a scenario; of one with `vary` the run that was chosen, else the first. Such a run has its
// number as seed unless something gives or varies one. Time is as fast as possible and the network
// lo of domain 0 unless it says otherwise. Throws ConfigError with file, line, key, what was
// expected and the nearest word.
Scenario LoadScenario(const std::filesystem::path& file, const ScenarioOptions& options = {});

// A scenario as a whole campaign has it: with `$name` as it is written.
struct VariedScenario {
  std::string name{}, about{};
  Plan plan;
};

// Returns nullopt for a scenario without `vary`. Throws ConfigError.
std::optional<VariedScenario> LoadVaried(const std::filesystem::path& file);

// The same of a file that was read before, for the results of a campaign: `name` is for errors.
Plan PlanOf(const std::string& text, const std::string& name);

// Reads every scenario that Plan::Samples() has of a campaign, so that errors are found before
// it starts. Throws ConfigError with the number of the run.
void CheckRuns(const std::filesystem::path& file, const Plan& plan, const ScenarioOptions& options);

// What a recording is judged by.
struct Standard {
  Expectations expect{};
  std::vector<StageSpec> stages{};  // may be empty
  config::Config config{};          // of the robot or robots
};

// Reads only what is expected, of a scenario or of a file with nothing else; of one with `vary` by
// run `run`, 0 for the first. If it names no robot, `robot` with its revision is meant, "" if that
// is not known either. Throws ConfigError.
Standard LoadStandard(const std::filesystem::path& file, const std::string& robot,
                      const std::string& revision, std::size_t run = 0);

// Returns the keys of a scenario as Markdown.
std::string ScenarioReference();

}  // namespace understudy::rehearse
