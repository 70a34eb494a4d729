// Plays campaigns: many rehearsals side by side, each a process of its own, and their results in a
// folder.
//
//   campaign.json     what it is; another campaign is refused there
//   runs/000017.json  the result of run 17, written at once when it has ended
//   runs/000017/      its recording, reports and log, where they are kept
//   report.html, verdict.json, junit.xml, runs.jsonl, runs.txt
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/campaign_outputs.h"
#include "rehearse/rehearse.h"

namespace understudy::rehearse {

// Which runs a process plays: those with (number - 1) mod count = index - 1.
struct Shard {
  std::size_t index = 1, count = 1;
};

// Reads "2/8". Throws ConfigError.
Shard ReadShard(const std::string& text);

enum class Keep : std::uint8_t { kFailures, kAll, kNone };  // folders of runs; kNone also of those

struct Progress {
  std::size_t done = 0, of = 0;  // runs of the shard
  Tally tally{};
  double elapsed = 0;            // wall s
  std::optional<double> left{};  // wall s, at the pace of the runs that ended since the start
};

// Returns "37 of 200: 35 passed, 2 failed; 12 s, about 53 s left".
std::string ProgressText(const Progress& progress);

struct CampaignOptions {
  std::filesystem::path out{};
  std::size_t jobs = 1;
  Shard shard{};
  Keep keep = Keep::kFailures;
  double limit = kRunLimit;  // wall s in which a run has to end, else it is ended and has failed
  bool again = false;        // the runs of the shard that are there, and all of another campaign
  std::string program = "/proc/self/exe";              // Understudy
  std::function<bool()> interrupted{};                 // true ends it
  std::function<void(const RunResult&)> on_result{};   // of this process, as they come
  std::function<void(const Progress&)> on_progress{};  // now and then
};

struct Played {
  Tally tally{};  // of the shard
  std::size_t missing = 0;
  std::size_t found = 0;  // results that were there before
};

// Plays the runs of a shard that have no result yet, `jobs` at a time. What had begun when it was
// interrupted leaves nothing behind. Call it in a process with one thread. Throws ConfigError if
// the folder has the results of another campaign, CommandError with the exit code of a run that
// could not even begin for a reason that all have in common: network, control socket, no such
// program.
Played PlayCampaign(const CampaignHead& head, const Plan& plan, const CampaignOptions& options);

// Reads a folder. Throws ConfigError if it is none of a campaign.
Campaign ReadCampaign(const std::filesystem::path& folder);

// Puts the results of several folders of one campaign into one. Throws ConfigError for folders of
// different campaigns, and if two have different results of a run.
void MergeCampaigns(const std::vector<std::filesystem::path>& from,
                    const std::filesystem::path& out);

// Writes report.html, verdict.json, junit.xml, runs.jsonl and runs.txt. Throws SetupError.
void WriteReports(const Campaign& campaign, const std::filesystem::path& folder);

}  // namespace understudy::rehearse
