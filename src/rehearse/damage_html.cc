// The damage sheet in a report.
#include <cmath>
#include <vector>

#include "base/printed.h"
#include "rehearse/outputs.h"
#include "robot/damage_reached.h"

namespace understudy::rehearse {
namespace {

std::string Amount(double value, const std::string& unit) {
  if (unit == "J" && value >= 1e4) return NumberText(value / 1000) + " kJ";
  return NumberText(value) + (unit.empty() ? "" : " " + unit);
}

robot::DamageReached ReachedOf(const record::Damage& damage, const robot::DamageLimit& limit) {
  std::vector<robot::MotorLimits> motors;
  for (std::size_t i = 0; i < damage.joints.size(); ++i) {
    motors.push_back({.torque = damage.torque_limit[i],
                      .speed = damage.speed_limit[i],
                      .jump = damage.jump_limit[i]});
  }
  return robot::ReachedOf(limit, damage.sheet, motors);
}

std::string ReachedText(const record::Damage& damage, const robot::DamageReached& reached) {
  return Amount(reached.value, reached.unit) +
         (reached.motor ? ", " + damage.joints[*reached.motor] : "");
}

std::string LimitText(const robot::DamageLimit& limit) {
  if (std::isfinite(limit.limit)) return Amount(limit.limit, limit.unit);
  return robot::IsOfMotors(limit.figure) ? "each motor's" : "none known";
}

}  // namespace

std::string BeyondText(const record::Damage& damage) {
  std::string text;
  for (const robot::DamageLimit& one : damage.limits) {
    const robot::DamageReached reached = ReachedOf(damage, one);
    if (reached.mark != robot::DamageMark::kBeyond) continue;
    text += (text.empty() ? "" : ", ") + one.figure + " " + ReachedText(damage, reached) + " (" +
            LimitText(one) + ")";
  }
  return text;
}

std::string DamageHtml(const record::Damage& damage) {
  const auto number = [](double value, const std::string& unit) {
    return value == 0 ? std::string() : NumberText(value) + " " + unit;
  };
  const auto seconds = [&](double at_limit, double limit, const std::string& unit) {
    if (at_limit == 0) return std::string();
    return "<b>" + number(at_limit, "s") + "</b> at " + NumberText(limit) + " " + unit;
  };
  const robot::DamageTotals& sheet = damage.sheet;
  std::string html = "<p>" + std::to_string(sheet.falls) + (sheet.falls == 1 ? " fall" : " falls") +
                     " · tilted by " + NumberText(sheet.worst_tilt) + " rad at most · shock " +
                     NumberText(sheet.shock) + " m/s² · " + NumberText(sheet.energy) +
                     " J from the pack, " + NumberText(sheet.peak_current) +
                     " A at most · windings trip at " + NumberText(damage.trip_c) + " °C</p>\n";
  html +=
      "<table><tr><th>Figure</th><th class=\"number\">Reached</th><th class=\"number\">"
      "Limit</th><th>Source of the limit</th></tr>\n";
  for (const robot::DamageLimit& one : damage.limits) {
    const robot::DamageReached reached = ReachedOf(damage, one);
    html += "<tr><td>" + Escaped(one.figure) + "</td><td class=\"number" +
            (reached.mark == robot::DamageMark::kBeyond ? " beyond" : "") + "\">" +
            Escaped(ReachedText(damage, reached)) + "</td><td class=\"number\">" +
            Escaped(LimitText(one)) + "</td><td>" + Escaped(one.source) + "</td></tr>\n";
  }
  html += "</table>\n<p></p><table><tr><th>Joint</th>";
  for (const char* head : {"At its torque limit", "At its speed limit", "Hottest winding",
                           "Tripped", "Hardest stop", "Largest jump of a command"}) {
    html += "<th class=\"number\">" + std::string(head) + "</th>";
  }
  html += "</tr>\n";
  for (std::size_t i = 0; i < sheet.motors.size(); ++i) {
    const robot::MotorDamage& motor = sheet.motors[i];
    html += "<tr><td><code>" + Escaped(damage.joints[i]) + "</code></td>";
    for (const std::string& cell :
         {seconds(motor.at_torque_limit, damage.torque_limit[i], "N·m"),
          seconds(motor.at_speed_limit, damage.speed_limit[i], "rad/s"),
          number(motor.hottest_c, "°C"), number(motor.tripped, "s"),
          number(motor.hardest_stop, "rad/s"),
          number(motor.largest_jump, "rad") +
              (damage.jump_limit[i] > 0 ? " of " + NumberText(damage.jump_limit[i]) : "")}) {
      html += "<td class=\"number\">" + cell + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace understudy::rehearse
