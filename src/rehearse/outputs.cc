#include "rehearse/outputs.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "version.h"

namespace understudy::rehearse {
namespace {

using judge::Outcome;
using judge::Verdict;
using nlohmann::ordered_json;

std::string Fixed(double number) { return Printed("%.3f", number); }

// Infinite margins, of claims without a quantity, are none.
ordered_json NumberOrNull(double number) {
  return std::isfinite(number) ? ordered_json(number) : ordered_json(nullptr);
}

ordered_json TimeOrNull(const std::optional<judge::Time>& time) {
  return time ? ordered_json(SecondsOf(*time)) : ordered_json(nullptr);
}

ordered_json Told(const Expectation& expectation, const Ruling& ruling) {
  const Verdict& verdict = ruling.verdict;
  const bool decided = ruling.why.empty();
  const bool counts = expectation.claim.op == judge::Operator::kCount;
  ordered_json told = {{"name", expectation.name},
                       {"asks", expectation.asks},
                       {"says", expectation.says},
                       {"where", expectation.where},
                       {"outcome", judge::Name(verdict.outcome)},
                       {"explanation", Explain(expectation, ruling)}};
  told["margin"] = decided ? NumberOrNull(verdict.worth.margin) : ordered_json(nullptr);
  told["unit"] = decided && !counts ? expectation.LeafOf(verdict).unit : "";
  told["at"] = decided ? ordered_json(SecondsOf(verdict.worth.at)) : ordered_json(nullptr);
  told["value"] = decided ? NumberOrNull(verdict.worth.value) : ordered_json(nullptr);
  told["came_true"] = TimeOrNull(verdict.came_true);
  told["from"] = TimeOrNull(verdict.begin);
  told["to"] = TimeOrNull(verdict.end);
  return told;
}

ordered_json Told(const Ladder& ladder) {
  ordered_json stages = ordered_json::array();
  for (std::size_t i = 0; i < ladder.stages.size(); ++i) {
    ordered_json limits = ordered_json::array();
    for (std::size_t j = 0; j < ladder.rulings.size(); ++j) {
      if (ladder.stage_of[j] == i) limits.push_back(Told(ladder.expect.list[j], ladder.rulings[j]));
    }
    stages.push_back(
        {{"name", ladder.stages[i].name}, {"holds", ladder.Holds(i)}, {"limits", limits}});
  }
  return {{"held", ladder.held},
          {"says", LadderText(ladder)},
          {"next_settings", ladder.next_settings},
          {"stages", stages}};
}

// As GET /snapshot?parts=damage has it.
ordered_json Told(const record::Damage& damage) {
  const robot::Damage& sheet = damage.sheet;
  ordered_json motors = ordered_json::array();
  for (std::size_t i = 0; i < sheet.motors.size(); ++i) {
    const robot::MotorDamage& motor = sheet.motors[i];
    motors.push_back({{"joint", damage.joints[i]},
                      {"at_torque_limit", motor.at_torque_limit},
                      {"torque_limit", damage.torque_limit[i]},
                      {"at_speed_limit", motor.at_speed_limit},
                      {"speed_limit", damage.speed_limit[i]},
                      {"tripped", motor.tripped},
                      {"hottest", motor.hottest_c},
                      {"hardest_stop", motor.hardest_stop},
                      {"largest_jump", motor.largest_jump},
                      {"jump_limit", damage.jump_limit[i]}});
  }
  ordered_json limits = ordered_json::array();
  for (const robot::DamageLimit& one : damage.limits) {
    limits.push_back(
        {{"figure", one.figure}, {"limit", one.limit}, {"unit", one.unit}, {"source", one.source}});
  }
  return {{"time", sheet.time},
          {"energy", sheet.energy},
          {"peak_current", sheet.peak_current},
          {"shock", sheet.shock},
          {"worst_tilt", sheet.worst_tilt},
          {"falls", sheet.falls},
          {"trip", damage.trip_c},
          {"motors", motors},
          {"limits", limits}};
}

}  // namespace

const char* Word(Outcome outcome, bool colored) {
  switch (outcome) {
    case Outcome::kPassed:
      return colored ? "\033[32mPASS\033[m" : "PASS";
    case Outcome::kFailed:
      return colored ? "\033[31mFAIL\033[m" : "FAIL";
    default:
      return colored ? "\033[33mNONE\033[m" : "NONE";
  }
}

std::string TellLines(const Occasion& occasion, const Expectations& expectations,
                      const Judged& judged, bool colored) {
  std::size_t width = 0;
  for (const Expectation& one : expectations.list) width = std::max(width, one.name.size());
  std::string text = occasion.title + "\n";
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    const Expectation& one = expectations.list[i];
    const Ruling& ruling = judged.rulings[i];
    const std::string margin = MarginText(one, ruling.verdict);
    text += std::string("  ") + Word(ruling.verdict.outcome, colored) + "  " + one.name +
            std::string(width - one.name.size() + 2, ' ') + Explain(one, ruling) +
            (margin.empty() ? "" : "; margin " + margin) + "\n";
  }
  text += std::to_string(judged.Count(Outcome::kPassed)) + " passed, " +
          std::to_string(judged.Count(Outcome::kFailed)) + " failed, " +
          std::to_string(judged.Count(Outcome::kNotJudged)) + " not judged in " +
          Fixed(judged.end) + " s";
  if (!occasion.stopped.empty() && !occasion.overlong) text += " (" + occasion.stopped + ")";
  text += "\n";
  if (occasion.overlong) {
    text += std::string("  ") + Word(Outcome::kFailed, colored) + "  the rehearsal " +
            occasion.stopped + "\n";
  }
  if (!occasion.ladder) return text;
  const Ladder& ladder = *occasion.ladder;
  for (std::size_t i = 0; i < ladder.rulings.size(); ++i) {
    const Expectation& one = ladder.expect.list[i];
    const std::string margin = MarginText(one, ladder.rulings[i].verdict);
    text += std::string("  ") + Word(ladder.rulings[i].verdict.outcome, colored) + "  stage " +
            one.name + "  " + Explain(one, ladder.rulings[i]) +
            (margin.empty() ? "" : "; margin " + margin) + "\n";
  }
  return text + LadderText(ladder) + "\n" + ladder.next_settings;
}

std::string TellJson(const Occasion& occasion, const Expectations& expectations,
                     const Judged& judged) {
  ordered_json verdicts = ordered_json::array();
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    verdicts.push_back(Told(expectations.list[i], judged.rulings[i]));
  }
  ordered_json damage = nullptr;
  if (judged.damage) damage = Told(*judged.damage);
  ordered_json ladder = nullptr;
  if (occasion.ladder) ladder = Told(*occasion.ladder);
  const ordered_json told = {{"title", occasion.title},
                             {"scenario", occasion.source},
                             {"robot", occasion.robot},
                             {"recording", occasion.recording},
                             {"repeat", occasion.repeat},
                             {"passed", judged.Count(Outcome::kPassed)},
                             {"failed", judged.Count(Outcome::kFailed)},
                             {"not_judged", judged.Count(Outcome::kNotJudged)},
                             {"seconds", judged.end},
                             {"stopped", occasion.stopped},
                             {"overlong", occasion.overlong},
                             {"about", judged.about},
                             {"damage", damage},
                             {"ladder", ladder},
                             {"verdicts", verdicts}};
  return told.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&') escaped += "&amp;";
    if (c == '<') escaped += "&lt;";
    if (c == '>') escaped += "&gt;";
    if (c == '"') escaped += "&quot;";
    const bool written = c == '&' || c == '<' || c == '>' || c == '"';
    const bool control = static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t';
    if (!written) escaped += control ? '?' : c;
  }
  return escaped;
}

std::string TellJunit(const Occasion& occasion, const Expectations& expectations,
                      const Judged& judged) {
  const auto attribute = [](const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + Escaped(value) + "\"";
  };
  const std::string time = Fixed(occasion.wall);
  std::string cases;
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    const Expectation& one = expectations.list[i];
    const Ruling& ruling = judged.rulings[i];
    const std::string margin = MarginText(one, ruling.verdict);
    std::string why = Explain(one, ruling);
    if (!margin.empty()) why += "; margin " + margin;
    cases += "    <testcase" + attribute("name", one.name) +
             attribute("classname", "understudy." + occasion.title) + attribute("time", "0.000");
    if (ruling.verdict.outcome == Outcome::kFailed) {
      cases += ">\n      <failure" + attribute("type", "failed") + attribute("message", why) + ">" +
               Escaped(one.asks + "\n" + one.says + "\n" + one.where) +
               "</failure>\n    </testcase>\n";
    } else if (ruling.verdict.outcome == Outcome::kNotJudged) {
      cases += ">\n      <skipped" + attribute("message", why) + "/>\n    </testcase>\n";
    } else {
      cases += "/>\n";
    }
  }
  if (occasion.overlong) {
    cases += "    <testcase" + attribute("name", "the rehearsal ends") +
             attribute("classname", "understudy." + occasion.title) + attribute("time", time) +
             ">\n      <failure" + attribute("type", "overlong") +
             attribute("message", occasion.stopped) + "/>\n    </testcase>\n";
  }
  const std::size_t more = occasion.overlong ? 1 : 0;
  const std::size_t failed = judged.Count(Outcome::kFailed) + more;
  const std::string counts = attribute("tests", std::to_string(expectations.list.size() + more)) +
                             attribute("failures", std::to_string(failed)) +
                             attribute("errors", "0");
  std::string started;
  if (const auto when = judged.about.find("started"); when != judged.about.end()) {
    started = when->second.substr(0, 19);  // without the Z, as JUnit has it
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
         attribute("name", "understudy " + std::string(kVersion)) + counts +
         attribute("time", time) + ">\n  <testsuite" + attribute("name", occasion.title) + counts +
         attribute("skipped", std::to_string(judged.Count(Outcome::kNotJudged))) +
         attribute("time", time) + (started.empty() ? "" : attribute("timestamp", started)) +
         ">\n    <properties>\n" + "      <property name=\"robot\"" +
         attribute("value", occasion.robot) + "/>\n" + "      <property name=\"recording\"" +
         attribute("value", occasion.recording) + "/>\n" + "      <property name=\"repeat\"" +
         attribute("value", occasion.repeat) + "/>\n" + "    </properties>\n" + cases +
         "  </testsuite>\n</testsuites>\n";
}

}  // namespace understudy::rehearse
