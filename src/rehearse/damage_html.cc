// The damage sheet in a report.
#include <cmath>
#include <string_view>

#include "base/printed.h"
#include "rehearse/outputs.h"

namespace understudy::rehearse {
namespace {

using robot::MotorDamage;

std::string Amount(double value, const std::string& unit) {
  if (unit == "J" && value >= 1e4) return NumberText(value / 1000) + " kJ";
  return NumberText(value) + (unit.empty() ? "" : " " + unit);
}

// A figure of the motors, of which the largest counts.
struct OfMotors {
  std::string_view figure;
  double MotorDamage::*value;
  const char* unit;
};
constexpr OfMotors kOfMotors[] = {
    {"at_torque_limit", &MotorDamage::at_torque_limit, "s"},
    {"at_speed_limit", &MotorDamage::at_speed_limit, "s"},
    {"tripped", &MotorDamage::tripped, "s"},
    {"hottest", &MotorDamage::hottest_c, "°C"},
    {"hardest_stop", &MotorDamage::hardest_stop, "rad/s"},
    {"largest_jump", &MotorDamage::largest_jump, "rad"},
};

struct Reached {
  std::string text{};
  bool beyond = false;  // the limit
};

Reached ReachedByMotors(const record::Damage& damage, const robot::DamageLimit& limit,
                        const OfMotors& figure) {
  Reached reached;
  const std::vector<MotorDamage>& motors = damage.sheet.motors;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const double value = motors[i].*figure.value;
    if (value > motors[worst].*figure.value) worst = i;
    if (limit.figure == "largest_jump") {
      reached.beyond |= damage.jump_limit[i] > 0 && value > damage.jump_limit[i];
    } else {
      // Seconds are counted at a limit, so any are beyond it.
      reached.beyond |= value > (limit.unit == figure.unit ? limit.limit : 0);
    }
  }
  if (motors.empty()) return reached;
  const double most = motors[worst].*figure.value;
  reached.text = Amount(most, figure.unit) + (most > 0 ? ", " + damage.joints[worst] : "");
  return reached;
}

Reached ReachedOf(const record::Damage& damage, const robot::DamageLimit& limit) {
  for (const OfMotors& figure : kOfMotors) {
    if (figure.figure == limit.figure) return ReachedByMotors(damage, limit, figure);
  }
  const robot::DamageTotals& sheet = damage.sheet;
  for (const auto& [figure, value] : {std::pair<std::string_view, double>("energy", sheet.energy),
                                      {"peak_current", sheet.peak_current},
                                      {"shock", sheet.shock},
                                      {"worst_tilt", sheet.worst_tilt},
                                      {"falls", sheet.falls}}) {
    if (figure == limit.figure) return {Amount(value, limit.unit), value > limit.limit};
  }
  return {};
}

std::string LimitText(const robot::DamageLimit& limit) {
  if (std::isfinite(limit.limit)) return Amount(limit.limit, limit.unit);
  for (const OfMotors& figure : kOfMotors) {
    if (figure.figure == limit.figure) return "each motor's";
  }
  return "none known";
}

}  // namespace

std::string BeyondText(const record::Damage& damage) {
  std::string text;
  for (const robot::DamageLimit& one : damage.limits) {
    const Reached reached = ReachedOf(damage, one);
    if (!reached.beyond) continue;
    text +=
        (text.empty() ? "" : ", ") + one.figure + " " + reached.text + " (" + LimitText(one) + ")";
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
    const Reached reached = ReachedOf(damage, one);
    html += "<tr><td>" + Escaped(one.figure) + "</td><td class=\"number" +
            (reached.beyond ? " beyond" : "") + "\">" + Escaped(reached.text) +
            "</td><td class=\"number\">" + Escaped(LimitText(one)) + "</td><td>" +
            Escaped(one.source) + "</td></tr>\n";
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
