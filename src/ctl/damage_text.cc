// The damage sheet as tables.
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "base/printed.h"
#include "ctl/text.h"

namespace understudy::ctl {
namespace {

using nlohmann::ordered_json;

// "43.45 m/s²", "858.2 kJ".
std::string Amount(const ordered_json& value, const std::string& unit) {
  constexpr double kMany = 1e4;  // J
  if (value.is_null()) return "none known";
  if (unit == "J" && value.get<double>() >= kMany) return Amount(value.get<double>() / 1000, "kJ");
  const std::string number = Printed("%.4g", value.get<double>());
  return unit.empty() ? number : number + " " + unit;
}

std::string MarkText(const ordered_json& row) {
  const auto mark = row.at("mark").get<std::string>();
  return mark == "beyond" ? "BEYOND" : mark;
}

// A time at a limit may not be: "0 s at 23.7 N·m".
std::string LimitText(const ordered_json& row) {
  const auto unit = row.at("unit").get<std::string>();
  const ordered_json& limit = row.at("held_against");
  if (row.at("reached_unit") == unit) return Amount(limit, unit);
  return "0 s at " + (limit.is_null() ? "each motor's limit" : Amount(limit, unit));
}

std::string FiguresText(const ordered_json& limits, bool sources) {
  std::vector<Cells> rows = {{"FIGURE", "REACHED", "LIMIT", "MARK", "MOTOR"}};
  if (sources) rows.front().emplace_back("SOURCE OF THE LIMIT");
  for (const ordered_json& row : limits) {
    rows.push_back({row.at("figure"), Amount(row.at("reached"), row.at("reached_unit")),
                    LimitText(row), MarkText(row), row.at("motor")});
    if (sources) rows.back().push_back(row.at("source"));
  }
  return Aligned(rows);
}

// A figure of the motors and its unit.
struct Column {
  std::string_view key, unit;
};
constexpr std::array kColumns = {
    Column{"at_torque_limit", "s"}, Column{"at_speed_limit", "s"},   Column{"tripped", "s"},
    Column{"hottest", "°C"},        Column{"hardest_stop", "rad/s"}, Column{"largest_jump", "rad"},
};

// Returns "" if no motor is to be shown.
std::string MotorsText(const ordered_json& motors, bool all) {
  std::vector<Cells> rows = {{"MOTOR", "MARK"}};
  for (const Column& column : kColumns) {
    rows.front().push_back(std::string(column.key) + " [" + std::string(column.unit) + "]");
  }
  for (const ordered_json& motor : motors) {
    if (!all && motor.at("mark") == "ok") continue;
    rows.push_back({motor.at("joint"), MarkText(motor)});
    for (const Column& column : kColumns) {
      rows.back().push_back(Printed("%.4g", motor.at(column.key).get<double>()));
    }
  }
  return rows.size() == 1 ? "" : "\n" + Aligned(rows);
}

}  // namespace

std::int64_t BeyondCount(const ordered_json& snapshot) {
  return std::ranges::count(snapshot.at("damage").at("limits"), "beyond",
                            [](const ordered_json& row) { return row.at("mark"); });
}

std::string DamageText(const ordered_json& snapshot, bool all) {
  const ordered_json& damage = snapshot.at("damage");
  const std::int64_t beyond = BeyondCount(snapshot);
  const std::string count = beyond == 0 ? "nothing is beyond its limit"
                            : beyond == 1
                                ? "1 figure is beyond its limit"
                                : std::to_string(beyond) + " figures are beyond their limits";
  return FiguresText(damage.at("limits"), all) + MotorsText(damage.at("motors"), all) + "\n" +
         Printed("after %.1f s: ", damage.at("time").get<double>()) + count + "\n";
}

}  // namespace understudy::ctl
