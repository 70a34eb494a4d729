// Tells a comparison of two recordings: to a terminal, to programs and to people.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "record/svg_plot.h"
#include "rehearse/compare.h"
#include "rehearse/judged.h"
#include "rehearse/outputs.h"

namespace understudy::rehearse {
namespace {

using nlohmann::ordered_json;

// Columns of the table of motors.
struct Column {
  std::string_view head, unit;
  double scale;
  std::optional<double> (*of)(const MotorComparison&);
};
constexpr double kMilli = 1000;

const std::vector<Column>& Columns() {
  using Motor = MotorComparison;
  static const std::vector<Column> columns = {
      {"RMS difference", "mrad", kMilli, [](const Motor& m) { return m.q.rms; }},
      {"max", "mrad", kMilli, [](const Motor& m) { return m.q.most; }},
      {"speed RMS", "rad/s", 1, [](const Motor& m) { return m.dq.rms; }},
      {"torque RMS", "N·m", 1, [](const Motor& m) { return m.tau.rms; }},
      {"tracking error A", "mrad", kMilli, [](const Motor& m) { return m.first.error; }},
      {"tracking error B", "mrad", kMilli, [](const Motor& m) { return m.second.error; }},
      {"lag A", "ms", kMilli, [](const Motor& m) { return m.first.lag; }},
      {"lag B", "ms", kMilli, [](const Motor& m) { return m.second.lag; }},
  };
  return columns;
}

std::string Told(const std::optional<double>& value, double scale = 1) {
  return value ? NumberText(*value * scale) : "-";
}

std::string Alignment(const Differences& comparison) {
  const std::string seconds = NumberText(comparison.shift) + " s";
  if (comparison.aligned) {
    return "shifted by " + seconds + ", by their movements (likeness " +
           NumberText(comparison.likeness) + " of 1)";
  }
  return comparison.shift == 0 ? "from their starts: too little moves to align them"
                               : "shifted by " + seconds + ", as told";
}

std::string Title(const Differences& comparison) {
  return comparison.first + " and " + comparison.second;
}

ordered_json NumberOrNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}
ordered_json JsonOf(const Apart& apart) {
  return {{"rms", NumberOrNull(apart.rms)},
          {"most", NumberOrNull(apart.most)},
          {"rms_first", NumberOrNull(apart.rms_first)},
          {"rms_second", NumberOrNull(apart.rms_second)}};
}
ordered_json JsonOf(const Following& following) {
  return {{"error", NumberOrNull(following.error)}, {"lag", NumberOrNull(following.lag)}};
}

}  // namespace

std::string CompareText(const Differences& comparison) {
  std::string text = Title(comparison) +
                     (comparison.robot.empty() ? "" : ", " + Printable(comparison.robot)) + "\n" +
                     NumberText(comparison.to - comparison.from) + " s in common, the second " +
                     Alignment(comparison) + "\n\n" + Printed("%-16s", "joint");
  for (const Column& column : Columns()) {
    text += Printed(" %12s", std::string(column.head).c_str());
  }
  text += "\n" + Printed("%-16s", "");
  // Letters of more than one byte count as one.
  for (const Column& column : Columns()) {
    const auto more = static_cast<int>(
        std::ranges::count_if(column.unit, [](char c) { return (c & 0xC0) == 0x80; }));
    text += Printed(" %*s", 12 + more, std::string(column.unit).c_str());
  }
  text += "\n";
  for (const MotorComparison& motor : comparison.motors) {
    text += Printed("%-16s", Printable(motor.joint).c_str());
    for (const Column& column : Columns()) {
      text += Printed(" %12s", Told(column.of(motor), column.scale).c_str());
    }
    text += "\n";
  }
  text += "\n" + Printed("%-22s %12s %12s\n", "", "apart", "at most");
  for (const Apart& apart : comparison.rest) {
    text += Printed("%-22s %12s %12s %s\n", apart.name.c_str(), Told(apart.rms).c_str(),
                    Told(apart.most).c_str(), apart.unit.c_str());
  }
  return text;
}

std::string CompareJson(const Differences& comparison) {
  ordered_json motors = ordered_json::array(), rest = ordered_json::array();
  for (const MotorComparison& motor : comparison.motors) {
    motors.push_back({{"joint", motor.joint},
                      {"slot", motor.slot},
                      {"q", JsonOf(motor.q)},
                      {"dq", JsonOf(motor.dq)},
                      {"tau", JsonOf(motor.tau)},
                      {"first", JsonOf(motor.first)},
                      {"second", JsonOf(motor.second)}});
  }
  for (const Apart& apart : comparison.rest) {
    ordered_json one = JsonOf(apart);
    one["name"] = apart.name;
    one["unit"] = apart.unit;
    rest.push_back(one);
  }
  const ordered_json told = {{"first", comparison.first},
                             {"second", comparison.second},
                             {"robot", comparison.robot},
                             {"shift", comparison.shift},
                             {"likeness", comparison.likeness},
                             {"aligned", comparison.aligned},
                             {"from", comparison.from},
                             {"to", comparison.to},
                             {"step", comparison.step},
                             {"motors", motors},
                             {"rest", rest}};
  return told.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string CompareHtml(const Differences& comparison) {
  std::string html = "<header><h1>" + Escaped(Title(comparison)) + "</h1><p class=\"dim\">" +
                     Escaped(comparison.robot) + (comparison.robot.empty() ? "" : " · ") +
                     NumberText(comparison.to - comparison.from) + " s in common · the second is " +
                     Escaped(Alignment(comparison)) +
                     "</p></header>\n<h2>Motors</h2>\n<table><tr><th>Joint</th>";
  for (const Column& column : Columns()) {
    html += "<th class=\"number\">" + std::string(column.head) + " [" + std::string(column.unit) +
            "]</th>";
  }
  html += "</tr>\n";
  for (const MotorComparison& motor : comparison.motors) {
    html += "<tr><td><code>" + Escaped(motor.joint) + "</code></td>";
    for (const Column& column : Columns()) {
      html += "<td class=\"number\">" + Told(column.of(motor), column.scale) + "</td>";
    }
    html += "</tr>\n";
  }
  html +=
      "</table>\n<p class=\"dim\">Apart: root of the mean square of the difference at the same "
      "time. Error: the same of a command and its angle. Lag: by which the angle is most like its "
      "command.</p>\n<h2>Inertial unit and battery</h2>\n<table><tr><th></th><th "
      "class=\"number\">Apart</th><th class=\"number\">At most</th><th class=\"number\">First, "
      "rms</th><th class=\"number\">Second, rms</th><th>Unit</th></tr>\n";
  for (const Apart& apart : comparison.rest) {
    html += "<tr><td><code>" + Escaped(apart.name) + "</code></td>";
    for (const auto* value : {&apart.rms, &apart.most, &apart.rms_first, &apart.rms_second}) {
      html += "<td class=\"number\">" + Told(*value) + "</td>";
    }
    html += "<td>" + apart.unit + "</td></tr>\n";
  }
  html +=
      "</table>\n<h2>Angles</h2>\n<p class=\"dim\">Blue: the first; red: the second, in the time "
      "of the first. Those that are most apart come first.</p>\n<div class=\"plots\">";
  std::vector<const MotorComparison*> motors;
  for (const MotorComparison& motor : comparison.motors) motors.push_back(&motor);
  std::ranges::stable_sort(motors, [](const MotorComparison* a, const MotorComparison* b) {
    return a->q.rms.value_or(0) > b->q.rms.value_or(0);
  });
  for (const MotorComparison* motor : motors) {
    const record::SvgPlot plot{.label = motor->joint + " [rad]",
                               .from = comparison.from,
                               .to = comparison.to,
                               .lines = {{.kind = "signal", .points = motor->q_first},
                                         {.kind = "other", .points = motor->q_second}},
                               .width = 520};
    html += "<figure>" + DrawSvg(plot) + "</figure>";
  }
  return HtmlPage(Title(comparison), html + "</div>\n");
}

}  // namespace understudy::rehearse
