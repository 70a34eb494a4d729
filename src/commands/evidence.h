// What `rehearse` and `judge` have in common: the scenario, and the folder of recordings, verdicts
// and reports.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "config/config.h"
#include "rehearse/outputs.h"
#include "rehearse/rehearse.h"
#include "rehearse/scenario.h"

namespace understudy::commands {

// The command line of both.
struct JudgeArguments {
  std::string scenario;
  std::string out;
  std::string recording;  // judge only
  std::size_t run = 0;    // of a campaign; 0: none was chosen
  bool json = false;
  bool pictures = true;
};

// Adds what both have but scenario and recording. `arguments` must outlive parsing.
void AddJudgeOptions(CLI::App* app, JudgeArguments* arguments);

// Returns that file, or the one of that name in config/scenarios. Throws ConfigError.
std::filesystem::path FindScenario(const std::string& written);

// Returns the folder that --out names, or the usual one of a scenario or recording.
std::filesystem::path FolderOf(const std::string& out, const std::filesystem::path& scenario,
                               std::size_t run = 0);

// Makes the folder of a rehearsal. Reports of others are not replaced: throws ConfigError.
std::filesystem::path OwnFolder(const std::filesystem::path& folder);

// Returns "go2", or of several robots "left (go2), right (go2)".
std::string RobotsText(const config::Config& config);

// Returns the recordings of all robots; `file` is the one of a robot alone.
std::vector<std::filesystem::path> RecordingsOf(const std::filesystem::path& file,
                                                const config::Config& config);

// Judges the stages, if there are any, and writes the settings of the next into the folder.
std::optional<rehearse::Ladder> Climb(const rehearse::Recordings& recordings,
                                      const std::vector<rehearse::StageSpec>& stages,
                                      const config::Config& config, const rehearse::Judged& judged,
                                      const std::filesystem::path& folder);

// Draws those of a recording that has the simulation's truth, where they are asked for.
rehearse::Pictures PicturesFor(const JudgeArguments& arguments,
                               const rehearse::Expectations& expect, const rehearse::Judged& judged,
                               const config::Config& config,
                               const std::vector<std::filesystem::path>& recordings,
                               const std::filesystem::path& folder);

// Prints the verdicts and writes those for CI, programs and people. Returns the exit code.
int TellVerdicts(const rehearse::Occasion& occasion, const rehearse::Expectations& expect,
                 const rehearse::Judged& judged, const std::filesystem::path& folder, bool as_json);

}  // namespace understudy::commands
