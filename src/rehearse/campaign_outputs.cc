#include "rehearse/campaign_outputs.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "rehearse/judged.h"
#include "rehearse/outputs.h"

namespace understudy::rehearse {
namespace {

using judge::Outcome;
using nlohmann::ordered_json;

// *Assumed*: of more runs that passed, so many are listed.
constexpr std::size_t kMostPassed = 20, kSomePassed = 10;

// "36.4 % (22.2 to 53.4)", "-" if none was judged.
std::string RateText(const Tally& tally) {
  if (tally.judged() == 0) return "-";
  const Share share = tally.interval();
  return Percent(tally.rate()) + " % (" + Percent(share.low) + " to " + Percent(share.high) + ")";
}

std::string Padded(std::string text, std::size_t width) {
  // By letters: a byte of UTF-8 that goes on with one is none.
  const auto letters = static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
  if (letters < width) text.append(width - letters, ' ');
  return text;
}

std::string SharedText(const std::vector<SharedValue>& shared, const std::string& whose) {
  if (shared.empty()) return {};
  std::string text = whose + " share, beyond chance:\n";
  for (const SharedValue& one : shared) {
    text += "  " + one.key + " " + one.label + ": " + std::to_string(one.there) + " of " +
            std::to_string(one.of) + "; of all runs " + std::to_string(one.with) + " of " +
            std::to_string(one.all) + "\n";
  }
  return text;
}

ordered_json Told(const Tally& tally) {
  const Share share = tally.interval();
  return {{"passed", tally.passed},
          {"failed", tally.failed},
          {"not_judged", tally.open},
          {"rate", tally.judged() == 0 ? ordered_json(nullptr) : ordered_json(tally.rate())},
          {"interval", {share.low, share.high}}};
}

ordered_json Told(const std::vector<SharedValue>& shared) {
  ordered_json told = ordered_json::array();
  for (const SharedValue& one : shared) {
    told.push_back({{"key", one.key},
                    {"value", one.label},
                    {"there", one.there},
                    {"of", one.of},
                    {"with", one.with},
                    {"all", one.all},
                    {"chance", one.chance}});
  }
  return told;
}

}  // namespace

std::string RunFolder(std::size_t number) { return Printed("runs/%06zu", number); }
std::string RunFile(std::size_t number) { return Printed("runs/%06zu.json", number); }

std::string Percent(double share) { return Printed("%.1f", 100 * share); }

std::string RunText(const RunResult& result, bool colored) {
  std::string text = Word(result.outcome, colored) + std::string("  ") +
                     std::to_string(result.number) + "  " + SettingsText(result.settings) + "  ";
  if (!result.broken.empty()) return text + result.broken;
  const RunVerdict* worst = result.Worst();
  if (worst == nullptr) return text;
  text += worst->name + ": " + worst->explanation;
  if (worst->margin) {
    text += "; margin " + NumberText(*worst->margin + 0.0) +
            (worst->unit.empty() ? "" : " " + worst->unit);
  }
  return text;
}

std::string CampaignText(const Campaign& campaign, bool colored, bool brief) {
  const CampaignSummary& summary = campaign.summary;
  std::string text = campaign.head.title + "\n";
  const bool some = brief && summary.tally.passed > kMostPassed;
  std::size_t passed = 0;
  for (const std::size_t i : summary.order) {
    const RunResult& result = campaign.results[i];
    if (result.outcome == Outcome::kPassed && ++passed > kSomePassed && some) continue;
    text += "  " + RunText(result, colored) + "\n";
  }
  if (some) {
    text += "  and " + std::to_string(summary.tally.passed - kSomePassed) +
            " more that passed, all in runs.txt\n";
  }
  for (const AxisSummary& axis : summary.axes) {
    std::size_t width = axis.key.size();
    for (const std::string& label : axis.labels) width = std::max(width, label.size() + 2);
    text += Padded(axis.key, width) + "  passed\n";
    for (std::size_t i = 0; i < axis.labels.size(); ++i) {
      const Tally& tally = axis.tallies[i];
      text += Padded("  " + axis.labels[i], width) + "  " + std::to_string(tally.passed) + " of " +
              std::to_string(tally.judged()) + "  " + RateText(tally) + "\n";
    }
  }
  text += SharedText(summary.of_failed, "The runs that failed");
  text += SharedText(summary.of_worst, "The " + std::to_string(summary.worst.size()) +
                                           " runs with the least margins");
  text += std::to_string(summary.tally.passed) + " passed, " +
          std::to_string(summary.tally.failed) + " failed, " + std::to_string(summary.tally.open) +
          " not judged of " + std::to_string(summary.planned) + " runs";
  if (campaign.missing() > 0) text += ", " + std::to_string(campaign.missing()) + " still to come";
  return text + ": " + RateText(summary.tally) + "\n";
}

std::string CampaignJson(const Campaign& campaign) {
  const CampaignSummary& summary = campaign.summary;
  ordered_json axes = ordered_json::array();
  for (const AxisSummary& axis : summary.axes) {
    ordered_json values = ordered_json::array();
    for (std::size_t i = 0; i < axis.labels.size(); ++i) {
      ordered_json value = {{"value", axis.labels[i]}};
      value.update(Told(axis.tallies[i]));
      values.push_back(value);
    }
    axes.push_back({{"key", axis.key}, {"values", values}});
  }
  ordered_json expectations = ordered_json::array();
  for (const ExpectationSummary& one : summary.expectations) {
    ordered_json worst = ordered_json::array();
    for (const std::size_t i : one.worst) {
      const RunResult& result = campaign.results[i];
      const auto verdict = std::ranges::find(result.verdicts, one.name, &RunVerdict::name);
      worst.push_back({{"run", result.number}, {"margin", *verdict->margin}});
    }
    ordered_json told = {{"name", one.name}, {"unit", one.unit}};
    told.update(Told(one.tally));
    told["worst"] = worst;
    expectations.push_back(told);
  }
  ordered_json failed = ordered_json::array(), worst = ordered_json::array();
  for (const std::size_t i : summary.order) {
    if (campaign.results[i].outcome == Outcome::kFailed) {
      failed.push_back(campaign.results[i].number);
    }
  }
  for (const std::size_t i : summary.worst) worst.push_back(campaign.results[i].number);
  ordered_json told = {{"title", campaign.head.title},
                       {"scenario", campaign.head.scenario},
                       {"version", campaign.head.version},
                       {"runs", summary.planned},
                       {"missing", campaign.missing()}};
  told.update(Told(summary.tally));
  told["failed_runs"] = failed;
  told["worst_runs"] = worst;
  told["failures_share"] = Told(summary.of_failed);
  told["worst_share"] = Told(summary.of_worst);
  told["keys"] = axes;
  told["expectations"] = expectations;
  return told.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string CampaignJunit(const Campaign& campaign) {
  const auto attribute = [](const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + Escaped(value) + "\"";
  };
  const auto seconds = [](double time) { return Printed("%.3f", time); };
  const Tally& tally = campaign.summary.tally;
  double time = 0;
  std::string cases;
  for (const RunResult& result : campaign.results) {
    time += result.seconds;
    const std::string line = RunText(result, false);
    cases +=
        "    <testcase" +
        attribute("name", std::to_string(result.number) + " " + SettingsText(result.settings)) +
        attribute("classname", "understudy." + campaign.head.title) +
        attribute("time", seconds(result.seconds));
    if (result.outcome == Outcome::kFailed) {
      cases += ">\n      <failure" +
               attribute("type", result.broken.empty() ? "failed" : "broken") +
               attribute("message", line) + ">" + Escaped(result.repeat) +
               "</failure>\n    </testcase>\n";
    } else if (result.outcome == Outcome::kNotJudged) {
      cases += ">\n      <skipped" + attribute("message", line) + "/>\n    </testcase>\n";
    } else {
      cases += "/>\n";
    }
  }
  const std::string counts = attribute("tests", std::to_string(campaign.results.size())) +
                             attribute("failures", std::to_string(tally.failed)) +
                             attribute("errors", "0");
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
         attribute("name", "understudy " + campaign.head.version) + counts +
         attribute("time", seconds(time)) + ">\n  <testsuite" +
         attribute("name", campaign.head.title) + counts +
         attribute("skipped", std::to_string(tally.open)) + attribute("time", seconds(time)) +
         ">\n    <properties>\n      <property name=\"scenario\"" +
         attribute("value", campaign.head.scenario) + "/>\n      <property name=\"rate\"" +
         attribute("value", RateText(tally)) + "/>\n    </properties>\n" + cases +
         "  </testsuite>\n</testsuites>\n";
}

}  // namespace understudy::rehearse
