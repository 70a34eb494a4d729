// Campaigns of rehearsals: the options of `rehearse` for a scenario with `vary`, and what they do.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "rehearse/run_campaign.h"
#include "rehearse/scenario.h"

namespace understudy::commands {

// As typed.
struct CampaignArguments {
  std::size_t jobs = 0;  // 0: as many as there are cores, half of them with a program
  std::string shard;
  std::string keep = "failures";
  bool again = false;
  std::optional<double> limit;     // wall s, also of a rehearsal that is not one of many
  std::vector<std::string> merge;  // folders
};

// Adds --jobs, --shard, --keep, --again and --merge. `arguments` must outlive parsing.
void AddCampaignOptions(CLI::App* app, CampaignArguments* arguments);

// Throws ConfigError if an option is given that only a campaign has: `file` is none.
void RequireNone(const CampaignArguments& arguments, const std::filesystem::path& file);

struct CampaignRequest {
  std::filesystem::path file;
  std::string written;  // the scenario, as typed
  rehearse::VariedScenario varied;
  rehearse::ScenarioOptions options;
  std::vector<std::string> words;  // options that every run has
  std::filesystem::path out;
  bool host_network = false;
  bool json = false;
};

// Plays it, tells it and returns the exit code of `rehearse`: of the runs of this shard.
int CampaignCommand(const CampaignRequest& request, const CampaignArguments& arguments);

// Merges the folders into `out` and prints the sums.
int MergeCommand(const CampaignArguments& arguments, const std::string& out, bool json);

}  // namespace understudy::commands
