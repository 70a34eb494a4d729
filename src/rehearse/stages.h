// The ladder of stages up which a program goes from a rehearsal to a real robot
// (docs/rehearsing.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "rehearse/judged.h"
#include "schema/yaml_document.h"

namespace understudy::rehearse {

// Limits that a program has to keep in a stage; one at least.
struct StageSpec {
  std::string name{};
  std::string where{};                   // "walk.yaml:12"
  std::optional<double> torque{};        // share of each motor's torque_limit, above 0 to 1
  std::optional<double> speed{};         // share of each motor's no_load_speed, above 0 to 1
  std::optional<double> joint_margin{};  // rad or m, from both ends of each joint's range
  std::optional<double> command_rate{};  // Hz of rt/lowcmd, at least, from its first message on
};

// Reads the list under `stages`. Throws ConfigError with file, line, key, what was expected and the
// nearest word.
std::vector<StageSpec> ReadStages(const schema::YamlValue& list);

// The limits of the stages, judged.
struct Ladder {
  std::vector<StageSpec> stages{};
  Expectations expect{};                // one a limit, named "crawl: torque"
  std::vector<std::size_t> stage_of{};  // by expectation
  std::vector<Ruling> rulings{};        // by expectation
  std::size_t held = 0;                 // stages, from the first on, all of whose limits hold
  std::string next_settings{};          // YAML for --config: the limits of the first that does not
                                        // hold, "" if all hold

  bool Holds(std::size_t stage) const;
};

// Judges the recording of a rehearsal by its stages. No stage holds if one of its expectations,
// judged in `judged`, failed or is open. Throws RecordError, ModelError.
Ladder JudgeLadder(const Recordings& recordings, const std::vector<StageSpec>& stages,
                   const config::Config& config, const Judged& judged);

// Returns "may go up to stage 'crawl', 1 of 3; next is 'walk'".
std::string LadderText(const Ladder& ladder);

// Returns the keys of a stage as rows of Markdown's table of scenario keys.
std::string StagesReference();

}  // namespace understudy::rehearse
