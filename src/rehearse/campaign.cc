#include "rehearse/campaign.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "base/exit_code.h"
#include "rehearse/judged.h"
#include "rehearse/rehearse.h"

namespace understudy::rehearse {
namespace {

using judge::Outcome;
using nlohmann::ordered_json;

constexpr double kConfidence = 1.959964;  // standard deviations: 95 %
// All *assumed*.
constexpr std::size_t kParts = 6;      // of a range
constexpr std::size_t kMostWorst = 5;  // runs of an expectation
constexpr double kTail = 0.1;          // of the runs have the worst margins
constexpr std::size_t kLeastTail = 3;
constexpr double kRare = 0.05;

Outcome OutcomeOf(const std::string& name) {
  for (const Outcome outcome : {Outcome::kPassed, Outcome::kFailed}) {
    if (name == judge::Name(outcome)) return outcome;
  }
  return Outcome::kNotJudged;
}

std::optional<double> NumberIn(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::optional<double> RelativeOf(const RunVerdict& verdict, std::optional<double> value) {
  if (verdict.outcome == Outcome::kNotJudged) return std::nullopt;
  if (!verdict.margin || !value) {
    return verdict.outcome == Outcome::kFailed ? std::optional(-1.0) : std::nullopt;
  }
  const double size = std::abs(*verdict.margin) + std::abs(*value);
  return size > 0 ? *verdict.margin / size : 0;
}

std::optional<double> AsNumber(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool is = !text.empty() && *end == '\0' && std::isfinite(number);
  return is ? std::optional(number) : std::nullopt;
}

// The chance that of `of` runs, drawn from `all` of which `with` have something, `there` or more
// have it.
double Chance(const SharedValue& common) {
  const auto ln_choose = [](std::size_t n, std::size_t k) {
    const auto ln_factorial = [](std::size_t m) { return std::lgamma(static_cast<double>(m) + 1); };
    return ln_factorial(n) - ln_factorial(k) - ln_factorial(n - k);
  };
  const std::size_t without = common.all - common.with;
  double chance = 0;
  for (std::size_t k = common.there; k <= std::min(common.of, common.with); ++k) {
    if (common.of - k > without) continue;
    chance += std::exp(ln_choose(common.with, k) + ln_choose(without, common.of - k) -
                       ln_choose(common.all, common.of));
  }
  return std::min(chance, 1.0);
}

// What some of the results share; `some` are places in the results.
std::vector<SharedValue> Shared(const std::vector<AxisSummary>& axes,
                                const std::vector<std::size_t>& some, std::size_t all) {
  std::vector<SharedValue> shared;
  if (some.empty() || some.size() == all) return shared;
  std::size_t looked_at = 0;
  for (const AxisSummary& axis : axes) {
    for (std::size_t i = 0; i < axis.labels.size(); ++i) {
      const auto has = [&](std::size_t result) { return axis.groups[result] == i; };
      SharedValue common{.key = axis.key,
                         .label = axis.labels[i],
                         .there = static_cast<std::size_t>(std::ranges::count_if(some, has)),
                         .of = some.size(),
                         .with = static_cast<std::size_t>(std::ranges::count(axis.groups, i)),
                         .all = all};
      if (common.with == 0 || common.with == all) continue;
      ++looked_at;
      common.chance = Chance(common);
      shared.push_back(std::move(common));
    }
  }
  for (SharedValue& one : shared) one.chance *= static_cast<double>(looked_at);
  std::erase_if(shared, [](const SharedValue& one) { return one.chance >= kRare; });
  std::ranges::stable_sort(shared, {}, &SharedValue::chance);
  return shared;
}

ExpectationSummary Summarized(const std::string& name, const std::vector<RunResult>& results) {
  ExpectationSummary summary{.name = name};
  std::vector<std::pair<double, std::size_t>> margins;
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (const RunVerdict& verdict : results[i].verdicts) {
      if (verdict.name != name) continue;
      summary.tally.Count(verdict.outcome);
      if (verdict.margin) margins.emplace_back(*verdict.margin, i);
      if (summary.unit.empty()) summary.unit = verdict.unit;
    }
  }
  std::ranges::sort(margins);
  margins.resize(std::min(margins.size(), kMostWorst));
  for (const auto& [margin, result] : margins) summary.worst.push_back(result);
  return summary;
}

}  // namespace

const RunVerdict* RunResult::Worst() const {
  const RunVerdict* worst = nullptr;
  // By outcome, then by margin.
  const auto rank = [](const RunVerdict& one) {
    const int place = one.outcome == Outcome::kFailed      ? 0
                      : one.outcome == Outcome::kNotJudged ? 1
                                                           : 2;
    return std::pair(place, one.relative.value_or(2));
  };
  for (const RunVerdict& one : verdicts) {
    if (worst == nullptr || rank(one) < rank(*worst)) worst = &one;
  }
  return worst;
}

RunResult ReadRun(std::size_t number, const std::vector<Setting>& settings, int exit_code,
                  const std::string& verdict, const std::string& last_words) {
  RunResult result{.number = number, .settings = settings};
  const ordered_json told = ordered_json::parse(verdict, nullptr, false);
  const bool judged = exit_code == 0 || exit_code == static_cast<int>(ExitCode::kFailed) ||
                      exit_code == static_cast<int>(ExitCode::kOpen);
  if (!judged || !told.is_object() || !told.contains("verdicts")) {
    result.outcome = Outcome::kFailed;
    result.broken = exit_code > 128 ? "ended by signal " + std::to_string(exit_code - 128)
                                    : "exit code " + std::to_string(exit_code);
    if (!last_words.empty()) result.broken += ": " + last_words;
  } else {
    result.outcome = exit_code == 0                                     ? Outcome::kPassed
                     : exit_code == static_cast<int>(ExitCode::kFailed) ? Outcome::kFailed
                                                                        : Outcome::kNotJudged;
  }
  if (!told.is_object()) return result;
  for (const ordered_json& failure : told.value("failures", ordered_json::array())) {
    if (!result.broken.empty()) result.broken += "; ";
    result.broken += failure.value("name", "") + " " + failure.value("why", "");
  }
  result.seconds = told.value("seconds", 0.0);
  for (const ordered_json& one : told.value("verdicts", ordered_json::array())) {
    RunVerdict read{.name = one.value("name", ""),
                    .outcome = OutcomeOf(one.value("outcome", "")),
                    .margin = NumberIn(one, "margin"),
                    .unit = one.value("unit", ""),
                    .explanation = one.value("explanation", "")};
    read.relative = RelativeOf(read, NumberIn(one, "value"));
    result.verdicts.push_back(std::move(read));
  }
  return result;
}

std::string CampaignHead::Repeat(std::size_t number) const {
  std::vector<std::string> words{"understudy", "rehearse", scenario, "--run",
                                 std::to_string(number)};
  words.insert(words.end(), options.begin(), options.end());
  if (!command.empty()) {
    words.emplace_back("--");
    words.insert(words.end(), command.begin(), command.end());
  }
  return ShellText(words);
}

std::string HeadText(const CampaignHead& head) {
  const ordered_json told = {{"title", head.title},       {"about", head.about},
                             {"scenario", head.scenario}, {"options", head.options},
                             {"command", head.command},   {"version", head.version},
                             {"text", head.text}};
  return told.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::optional<CampaignHead> ParseHead(const std::string& text) {
  try {
    const ordered_json told = ordered_json::parse(text);
    return CampaignHead{.title = told.at("title").get<std::string>(),
                        .about = told.at("about").get<std::string>(),
                        .scenario = told.at("scenario").get<std::string>(),
                        .options = told.at("options").get<std::vector<std::string>>(),
                        .command = told.at("command").get<std::vector<std::string>>(),
                        .version = told.at("version").get<std::string>(),
                        .text = told.at("text").get<std::string>()};
  } catch (const ordered_json::exception&) {
    return std::nullopt;
  }
}

std::string RunLine(const RunResult& result) {
  const auto number = [](const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
  };
  ordered_json values = ordered_json::object();
  for (const Setting& one : result.settings) values[one.key] = one.text;
  ordered_json verdicts = ordered_json::array();
  for (const RunVerdict& one : result.verdicts) {
    verdicts.push_back({{"name", one.name},
                        {"outcome", judge::Name(one.outcome)},
                        {"margin", number(one.margin)},
                        {"unit", one.unit},
                        {"relative", number(one.relative)},
                        {"explanation", one.explanation}});
  }
  const ordered_json line = {{"run", result.number},      {"outcome", judge::Name(result.outcome)},
                             {"values", values},          {"broken", result.broken},
                             {"seconds", result.seconds}, {"repeat", result.repeat},
                             {"kept", result.kept},       {"verdicts", verdicts}};
  return line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::optional<RunResult> ParseRun(const std::string& line) {
  try {
    const ordered_json told = ordered_json::parse(line);
    RunResult result{.number = told.at("run").get<std::size_t>(),
                     .outcome = OutcomeOf(told.at("outcome").get<std::string>()),
                     .broken = told.at("broken").get<std::string>(),
                     .seconds = told.at("seconds").get<double>(),
                     .repeat = told.at("repeat").get<std::string>(),
                     .kept = told.at("kept").get<bool>()};
    for (const auto& [key, text] : told.at("values").items()) {
      result.settings.push_back({.key = key, .text = text.get<std::string>()});
    }
    for (const ordered_json& one : told.at("verdicts")) {
      result.verdicts.push_back({.name = one.at("name").get<std::string>(),
                                 .outcome = OutcomeOf(one.at("outcome").get<std::string>()),
                                 .margin = NumberIn(one, "margin"),
                                 .unit = one.at("unit").get<std::string>(),
                                 .explanation = one.at("explanation").get<std::string>(),
                                 .relative = NumberIn(one, "relative")});
    }
    return result;
  } catch (const ordered_json::exception&) {
    return std::nullopt;
  }
}

Share WilsonInterval(std::size_t successes, std::size_t of) {
  if (of == 0) return {};
  const auto n = static_cast<double>(of);
  const double p = static_cast<double>(successes) / n;
  const double z2 = kConfidence * kConfidence;
  const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kConfidence / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {.low = successes == 0 ? 0 : std::max(0.0, middle - half),
          .high = successes == of ? 1 : std::min(1.0, middle + half)};
}

void Tally::Count(Outcome outcome) {
  if (outcome == Outcome::kPassed) {
    ++passed;
  } else if (outcome == Outcome::kFailed) {
    ++failed;
  } else {
    ++open;
  }
}

Groups::Groups(const Axis& axis) {
  std::vector<double> numbers;
  for (const std::string& text : axis.values) {
    if (const std::optional<double> number = AsNumber(text)) numbers.push_back(*number);
  }
  const bool few = !axis.is_range() && axis.values.size() <= kMostGroups;
  if (few || numbers.size() < axis.values.size()) {
    labels_ = axis.values;
    return;
  }
  if (axis.whole && axis.high - axis.low < static_cast<double>(kMostGroups)) {
    for (double number = axis.low; number <= axis.high; ++number) {
      labels_.push_back(std::to_string(std::llround(number)));
    }
    return;
  }
  parts_ = true;
  low_ = axis.is_range() ? axis.low : *std::ranges::min_element(numbers);
  const double high = axis.is_range() ? axis.high : *std::ranges::max_element(numbers);
  const std::size_t parts = high > low_ ? kParts : 1;
  width_ = (high - low_) / static_cast<double>(parts);
  for (std::size_t i = 0; i < parts; ++i) {
    const double begin = low_ + static_cast<double>(i) * width_;
    labels_.push_back(NumberText(begin) + " to " + NumberText(begin + width_));
  }
}

std::size_t Groups::Of(const std::string& text) const {
  if (!parts_) {
    const auto place = std::ranges::find(labels_, text) - labels_.begin();
    return std::min(static_cast<std::size_t>(place), labels_.size() - 1);
  }
  if (width_ <= 0) return 0;
  const double part = std::floor((AsNumber(text).value_or(low_) - low_) / width_);
  return static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(labels_.size() - 1)));
}

CampaignSummary Summarize(const Plan& plan, const std::vector<RunResult>& results) {
  CampaignSummary summary{.planned = plan.size()};
  for (const RunResult& result : results) summary.tally.Count(result.outcome);
  // Keys. A seed is no quantity.
  for (std::size_t a = 0; a < plan.axes().size(); ++a) {
    const Axis& axis = plan.axes()[a];
    const bool seed = axis.key == "seed" || axis.key.ends_with(".seed");
    if (seed) continue;
    const Groups groups(axis);
    AxisSummary one{.key = axis.key, .labels = groups.labels()};
    one.tallies.resize(one.labels.size());
    for (const RunResult& result : results) {
      const auto setting = std::ranges::find(result.settings, axis.key, &Setting::key);
      one.groups.push_back(setting == result.settings.end() ? 0 : groups.Of(setting->text));
      one.tallies[one.groups.back()].Count(result.outcome);
    }
    summary.axes.push_back(std::move(one));
  }
  // Expectations.
  for (const RunResult& result : results) {
    for (const RunVerdict& verdict : result.verdicts) {
      const auto known =
          std::ranges::find(summary.expectations, verdict.name, &ExpectationSummary::name);
      if (known != summary.expectations.end()) continue;
      summary.expectations.push_back(Summarized(verdict.name, results));
    }
  }
  // Runs.
  std::vector<std::size_t> failed;
  std::vector<std::pair<double, std::size_t>> margins;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].outcome == Outcome::kFailed) failed.push_back(i);
    const RunVerdict* worst = results[i].Worst();
    if (worst != nullptr && worst->relative) margins.emplace_back(*worst->relative, i);
  }
  for (const Outcome outcome : {Outcome::kFailed, Outcome::kNotJudged, Outcome::kPassed}) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (results[i].outcome == outcome) summary.order.push_back(i);
    }
  }
  std::ranges::sort(margins);
  const auto tail = static_cast<std::size_t>(kTail * static_cast<double>(margins.size()));
  margins.resize(std::min(margins.size(), std::max(tail, kLeastTail)));
  for (const auto& [margin, result] : margins) summary.worst.push_back(result);
  summary.of_failed = Shared(summary.axes, failed, results.size());
  summary.of_worst = Shared(summary.axes, summary.worst, results.size());
  return summary;
}

}  // namespace understudy::rehearse
