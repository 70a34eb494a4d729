#include "rehearse/outputs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  const robot::DamageTotals& sheet = damage.sheet;
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

std::string RepeatsText(const Occasion& occasion) {
  std::string text = occasion.clock == "simulated" ? "clock: simulated" : "";
  if (occasion.think > 0) text += Printed(", think: %.6g ms", occasion.think);
  if (occasion.repeats) {
    text += text.empty() ? "" : ", ";
    text += std::string("repeatable: ") + (*occasion.repeats ? "yes" : "no");
  }
  if (occasion.unrepeatable.empty()) return text;
  const bool differed = occasion.repeats && !*occasion.repeats;
  return text + (differed ? "; cause: " : "; two runs may differ: ") + occasion.unrepeatable;
}

std::string TellLines(const Occasion& occasion, const Expectations& expectations,
                      const Judged& judged, bool colored) {
  std::size_t width = 0;
  for (const Expectation& one : expectations.list) width = std::max(width, one.name.size());
  std::string text = occasion.title + "\n";
  for (const Failure& failure : judged.failures) {
    text += std::string("  ") + Word(Outcome::kFailed, colored) + "  " + failure.name + " " +
            failure.why + "\n";
  }
  std::vector<std::size_t> order(expectations.list.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [&judged](std::size_t i) {
    return judged.rulings[i].verdict.outcome == Outcome::kFailed;
  });
  for (const std::size_t i : order) {
    const Expectation& one = expectations.list[i];
    const Ruling& ruling = judged.rulings[i];
    const std::string margin = MarginText(one, ruling.verdict);
    text += std::string("  ") + Word(ruling.verdict.outcome, colored) + "  " + one.name +
            std::string(width - one.name.size() + 2, ' ') + Explain(one, ruling) +
            (margin.empty() ? "" : "; margin " + margin) + "\n";
  }
  text += std::to_string(judged.Count(Outcome::kPassed)) + " passed, " +
          std::to_string(judged.failed()) + " failed, " +
          std::to_string(judged.Count(Outcome::kNotJudged)) + " not judged in " +
          Fixed(judged.end) + " s";
  if (!occasion.stopped.empty()) text += " (" + occasion.stopped + ")";
  text += "\n";
  const std::string repeats = RepeatsText(occasion);
  if (!repeats.empty()) text += repeats + "\n";
  for (std::size_t i = 0; i < expectations.robots.size(); ++i) {
    const auto outcome = OutcomeOf(i, expectations, judged);
    text += std::string("  ") + (outcome ? Word(*outcome, colored) : "    ") + "  " +
            expectations.robots[i] + (outcome ? "" : "  no expectation names it") + "\n";
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
  const auto damage = [&judged](std::size_t robot) -> ordered_json {
    if (robot >= judged.damage.size() || !judged.damage[robot]) return nullptr;
    return Told(*judged.damage[robot]);
  };
  ordered_json robots = ordered_json::array();
  for (std::size_t i = 0; i < expectations.robots.size(); ++i) {
    const auto outcome = OutcomeOf(i, expectations, judged);
    ordered_json robot = {{"name", expectations.robots[i]}, {"damage", damage(i)}};
    robot["outcome"] = outcome ? ordered_json(judge::Name(*outcome)) : ordered_json(nullptr);
    robots.push_back(std::move(robot));
  }
  ordered_json failures = ordered_json::array();
  for (const Failure& failure : judged.failures) {
    failures.push_back({{"name", failure.name}, {"why", failure.why}});
  }
  ordered_json ladder = nullptr;
  if (occasion.ladder) ladder = Told(*occasion.ladder);
  const ordered_json repeatable =
      occasion.repeats ? ordered_json(*occasion.repeats) : ordered_json(nullptr);
  const ordered_json computed =
      occasion.computed ? ordered_json(*occasion.computed) : ordered_json(nullptr);
  const ordered_json told = {
      {"title", occasion.title},    {"scenario", occasion.source},
      {"robot", occasion.robot},    {"recording", occasion.recording},
      {"repeat", occasion.repeat},  {"passed", judged.Count(Outcome::kPassed)},
      {"failed", judged.failed()},  {"not_judged", judged.Count(Outcome::kNotJudged)},
      {"seconds", judged.end},      {"stopped", occasion.stopped},
      {"clock", occasion.clock},    {"unrepeatable", occasion.unrepeatable},
      {"think_ms", occasion.think}, {"computed_ms", computed},
      {"repeatable", repeatable},   {"failures", failures},
      {"about", judged.about},      {"damage", damage(0)},
      {"robots", robots},           {"ladder", ladder},
      {"verdicts", verdicts}};
  return told.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
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
  for (const Failure& failure : judged.failures) {
    cases += "    <testcase" + attribute("name", failure.name) +
             attribute("classname", "understudy." + occasion.title) + attribute("time", time) +
             ">\n      <failure" + attribute("type", "failed") + attribute("message", failure.why) +
             "/>\n    </testcase>\n";
  }
  const std::size_t tests = expectations.list.size() + judged.failures.size();
  const std::string counts = attribute("tests", std::to_string(tests)) +
                             attribute("failures", std::to_string(judged.failed())) +
                             attribute("errors", "0");
  std::string started;
  if (const auto when = judged.about.find("started"); when != judged.about.end()) {
    started = when->second.substr(0, 19);  // without the Z, as JUnit has it
  }
  std::string robots;
  for (std::size_t i = 0; i < expectations.robots.size(); ++i) {
    const auto outcome = OutcomeOf(i, expectations, judged);
    robots += "      <property" + attribute("name", "verdict of " + expectations.robots[i]) +
              attribute("value", outcome ? std::string(judge::Name(*outcome)) : "") + "/>\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
         attribute("name", "understudy " + std::string(kVersion)) + counts +
         attribute("time", time) + ">\n  <testsuite" + attribute("name", occasion.title) + counts +
         attribute("skipped", std::to_string(judged.Count(Outcome::kNotJudged))) +
         attribute("time", time) + (started.empty() ? "" : attribute("timestamp", started)) +
         ">\n    <properties>\n" + "      <property name=\"robot\"" +
         attribute("value", occasion.robot) + "/>\n" + robots +
         "      <property name=\"recording\"" + attribute("value", occasion.recording) + "/>\n" +
         "      <property name=\"repeat\"" + attribute("value", occasion.repeat) + "/>\n" +
         "    </properties>\n" + cases + "  </testsuite>\n</testsuites>\n";
}

}  // namespace understudy::rehearse
