// What a rehearsal plays before it: the first of two runs, and the one that measures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands/campaign.h"
#include "commands/clock_options.h"
#include "commands/evidence.h"
#include "commands/network_options.h"
#include "commands/set_options.h"

namespace understudy::commands {

struct RehearseArguments : JudgeArguments, SetArguments {
  NetworkArguments network;
  ClockArguments clock;
  std::string log_level = "warn";
  bool to_the_end = false;
  bool twice = false;
  bool words = false;
  std::string init;  // the file of a first scenario; "": none
  CampaignArguments campaign;
  std::vector<std::string> command;
};

// The options that a run of a campaign has as the campaign has them.
std::vector<std::string> OptionsOf(const RehearseArguments& arguments);

// Adds the program and its arguments, if there are any, behind "--".
void AddCommand(const std::vector<std::string>& command, std::vector<std::string>* words);

// Plays the scenario in a process of its own, whose output nobody sees, and returns its exit code;
// the evidence is in `folder`.
int PlayBefore(const RehearseArguments& arguments, const std::filesystem::path& folder);

// Whether the code is one of a rehearsal that was played and judged.
bool IsJudged(int code);

// What the verdict in a folder says of `key`.
nlohmann::json VerdictOf(const std::filesystem::path& folder, const char* key);

// Plays the scenario for --think auto and returns what it computed [ms]. Throws SetupError.
double MeasureThink(RehearseArguments arguments);

}  // namespace understudy::commands
