#include "doctor/report.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace understudy::doctor {
namespace {

std::size_t CountOf(const std::vector<CheckResult>& results, CheckVerdict verdict) {
  return static_cast<std::size_t>(std::ranges::count_if(
      results, [&](const CheckResult& one) { return one.finding.verdict == verdict; }));
}

}  // namespace

std::vector<CheckResult> Judge(const Measurements& evidence) {
  std::vector<CheckResult> results;
  for (const Check& check : Checks()) {
    results.push_back({.check = &check, .finding = check.judge(evidence)});
  }
  return results;
}

bool AnyWrong(const std::vector<CheckResult>& results) {
  return CountOf(results, CheckVerdict::kWrong) > 0;
}

std::string ReportText(const std::vector<CheckResult>& results) {
  std::size_t verdicts = 0, names = 0;
  for (const CheckResult& one : results) {
    verdicts = std::max(verdicts, Word(one.finding.verdict).size());
    names = std::max(names, one.check->name.size());
  }
  std::string text;
  for (const auto& [check, finding] : results) {
    text += fmt::format("{:<{}}  {:<{}}  {}", Word(finding.verdict), verdicts, check->name, names,
                        finding.text);
    if (!finding.remedy.empty()) text += " -> " + finding.remedy;
    text += '\n';
  }
  return text + fmt::format("{} wrong, {} warnings, {} ok, {} not seen\n",
                            CountOf(results, CheckVerdict::kWrong),
                            CountOf(results, CheckVerdict::kWarning),
                            CountOf(results, CheckVerdict::kOk),
                            CountOf(results, CheckVerdict::kNotSeen));
}

std::string ReportJson(const Question& question, const std::vector<CheckResult>& results) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [check, finding] : results) {
    nlohmann::ordered_json figures = nlohmann::ordered_json::object();
    for (const auto& [name, value] : finding.figures) figures[std::string(name)] = value;
    list.push_back({{"name", check->name},
                    {"verdict", Word(finding.verdict)},
                    {"finding", finding.text},
                    {"remedy", finding.remedy},
                    {"figures", figures}});
  }
  const nlohmann::ordered_json report = {{"interface", question.interface},
                                         {"domain", question.domain},
                                         {"seconds", question.seconds},
                                         {"peer", question.peer},
                                         {"wrong", CountOf(results, CheckVerdict::kWrong)},
                                         {"warnings", CountOf(results, CheckVerdict::kWarning)},
                                         {"checks", list}};
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace understudy::doctor
