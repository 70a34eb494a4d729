// Results of a campaign and their statistics.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "judge/claim.h"
#include "rehearse/vary.h"

namespace understudy::rehearse {

// What a campaign is: equal ones have equal results.
struct CampaignHead {
  std::string title{}, about{};
  std::string scenario{};              // as it was written
  std::vector<std::string> options{};  // words that every run has: --set, --interface-name
  std::vector<std::string> command{};  // of the program
  std::string version{};               // of Understudy
  std::string text{};                  // of the scenario's file

  bool operator==(const CampaignHead&) const = default;

  // Returns the line that does a run again.
  std::string Repeat(std::size_t number) const;
};

// As JSON and back; ParseHead returns nullopt for a text that is none.
std::string HeadText(const CampaignHead& head);
std::optional<CampaignHead> ParseHead(const std::string& text);

// One expectation of one run, as its verdict.json has it.
struct RunVerdict {
  std::string name{};
  judge::Outcome outcome = judge::Outcome::kNotJudged;
  std::optional<double> margin{};  // none: without a quantity, or not judged
  std::string unit{};
  std::string explanation{};
  // The margin over the sum of its size and that of what was measured, from -1 to 1: what makes
  // margins of different units comparable. -1 for a failure without a quantity; none for other
  // outcomes without one.
  std::optional<double> relative{};
};

// A run that has ended.
struct RunResult {
  std::size_t number = 0;  // from 1
  std::vector<Setting> settings{};
  judge::Outcome outcome = judge::Outcome::kNotJudged;
  std::string broken{};  // why it has failed besides its verdicts: "exit code 3: ..."
  double seconds = 0;    // simulated
  std::string repeat{};  // the command line that does the same again; ReadRun leaves it empty
  bool kept = false;     // its folder, with recording and report
  std::vector<RunVerdict> verdicts{};

  // Returns the verdict that says most: the failed one with the least relative margin, else one
  // that is not judged, else the least relative margin. Null if there is none.
  const RunVerdict* Worst() const;
};

// Reads what `rehearse` left of a run: its exit code, the text of its verdict.json and the last
// line of its log. An empty or damaged text, and any code but 0, 10 and 11, is a broken run; so
// is one that did not end within its limit.
RunResult ReadRun(std::size_t number, const std::vector<Setting>& settings, int exit_code,
                  const std::string& verdict, const std::string& last_words);

// The result as one line of JSON and back. ParseRun returns nullopt for a line that is none.
std::string RunLine(const RunResult& result);
std::optional<RunResult> ParseRun(const std::string& line);

struct Share {
  double low = 0, high = 1;
};
// The Wilson score interval of a probability with 95 % confidence (E. B. Wilson, JASA 22, 1927).
// `of` 0 gives [0, 1].
Share WilsonInterval(std::size_t successes, std::size_t of);

// How many runs, or expectations, had which outcome.
struct Tally {
  std::size_t passed = 0, failed = 0, open = 0;

  void Count(judge::Outcome outcome);
  std::size_t judged() const { return passed + failed; }
  std::size_t all() const { return judged() + open; }
  double rate() const {
    return judged() == 0 ? 0 : static_cast<double>(passed) / static_cast<double>(judged());
  }
  Share interval() const { return WilsonInterval(passed, judged()); }
};

// The values of a varied key in groups: the listed ones, or the parts of a range.
class Groups {
 public:
  explicit Groups(const Axis& axis);

  const std::vector<std::string>& labels() const { return labels_; }
  std::size_t Of(const std::string& text) const;

 private:
  std::vector<std::string> labels_;
  bool parts_ = false;
  double low_ = 0, width_ = 1;
};

struct AxisSummary {
  std::string key{};
  std::vector<std::string> labels{};
  std::vector<Tally> tallies{};       // by label
  std::vector<std::size_t> groups{};  // by result: its label
};

struct ExpectationSummary {
  std::string name{}, unit{};
  Tally tally{};
  std::vector<std::size_t> worst{};  // results, the least margin first; at most five
};

// A value that the failures, or the runs with the least margins, have in common.
struct SharedValue {
  std::string key{}, label{};
  std::size_t there = 0, of = 0;  // among those runs
  std::size_t with = 0, all = 0;  // among all
  double chance = 1;              // that so many or more had it if the key made no difference
};

struct CampaignSummary {
  std::size_t planned = 0;  // runs
  Tally tally{};            // of those with a result
  std::vector<AxisSummary> axes{};
  std::vector<ExpectationSummary> expectations{};  // in the order of the scenario
  std::vector<std::size_t> order{};                // results: failed, not judged, passed; by number
  std::vector<std::size_t> worst{};  // results with the least relative margins; a tenth, at least 3
  // What these share beyond chance (p < 0.05 by Fisher's exact test, times the number of values
  // that were looked at).
  std::vector<SharedValue> of_failed{}, of_worst{};
};

// `results` in the order of their numbers, each once.
CampaignSummary Summarize(const Plan& plan, const std::vector<RunResult>& results);

}  // namespace understudy::rehearse
