// Tells a campaign: to a terminal, to CI, to programs and to people. What is written depends on the
// results alone, not on when, where, in which order or in how many parts they came.
#pragma once

#include <string>
#include <vector>

#include "rehearse/campaign.h"

namespace understudy::rehearse {

struct Campaign {
  CampaignHead head{};
  Plan plan;
  std::vector<RunResult> results{};  // in the order of their numbers
  CampaignSummary summary{};

  // Returns how many runs have no result.
  std::size_t missing() const { return summary.planned - results.size(); }
};

// One line: outcome, number, values, what decided, margin.
std::string RunText(const RunResult& result, bool colored);

// Lines for a terminal: a line a run, failures first, then rates by value, what failures share and
// the summary. Of more than twenty runs that passed only the first ten are listed if `brief`.
std::string CampaignText(const Campaign& campaign, bool colored, bool brief);

// JSON for programs (docs/rehearsing.md).
std::string CampaignJson(const Campaign& campaign);

// JUnit's XML: a test case per run; those not judged are skipped. Its times are simulated.
std::string CampaignJunit(const Campaign& campaign);

// One HTML page that needs no other file, network or script, but links to the folders of the runs
// that were kept.
std::string CampaignHtml(const Campaign& campaign);

// Returns a share in percent, "36.4".
std::string Percent(double share);

// The folder of a run and the file of its result, below that of the campaign.
std::string RunFolder(std::size_t number);
std::string RunFile(std::size_t number);

}  // namespace understudy::rehearse
