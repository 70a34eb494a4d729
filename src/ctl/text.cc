#include "ctl/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/printed.h"
#include "emulator/request.h"

namespace understudy::ctl {
namespace {

using nlohmann::ordered_json;

// Returns "-" for null, which JSON has for a number that is not finite.
std::string Fixed(const ordered_json& value, int digits, double scale = 1) {
  if (value.is_null()) return "-";
  return Printed("%.*f", digits, value.get<double>() * scale);
}

std::string Count(const ordered_json& value) { return std::to_string(value.get<std::int64_t>()); }

std::string Crane(const ordered_json& crane) {
  return crane.at("attached").get<bool>() ? "attached" : "released";
}

std::string Randomized(const ordered_json& randomization) {
  return randomization.is_null() ? "no" : "from seed " + Count(randomization.at("seed"));
}

// "0", or "3 (crc 2, gain 1; last gain)".
std::string Refused(const ordered_json& commands) {
  std::int64_t total = 0;
  for (const ordered_json& number : commands.at("refused")) total += number.get<std::int64_t>();
  return total == 0 ? "0" : std::to_string(total) + " (" + ReasonsText(commands) + ")";
}

// The dangers from which the motion service protects the robot now: "heat, charge".
std::string ProtectsText(const ordered_json& motion) {
  std::string dangers;
  for (const ordered_json& danger : motion.at("protects")) {
    dangers += (dangers.empty() ? "" : ", ") + danger.get<std::string>();
  }
  return dangers;
}

// Formats a value of any type as one cell.
std::string CellOf(const ordered_json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return Printed("%.6g", value.get<double>());
  return value.dump();
}

bool IsTable(const ordered_json& value) {
  return value.is_array() && !value.empty() && value.front().is_object();
}

void AddFields(const ordered_json& object, const std::string& prefix, std::vector<Cells>* rows) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      AddFields(value, prefix + key + ".", rows);
    } else if (!IsTable(value)) {
      rows->push_back({prefix + key, CellOf(value)});
    }
  }
}

// The columns are the keys of the first row.
std::string TableText(const ordered_json& list) {
  std::vector<Cells> rows(1);
  for (const auto& [key, value] : list.front().items()) {
    std::string head = key;
    std::ranges::transform(head, head.begin(), [](unsigned char c) { return std::toupper(c); });
    rows.front().push_back(head);
  }
  for (const ordered_json& item : list) {
    Cells cells;
    for (const auto& [key, value] : list.front().items()) {
      cells.push_back(item.contains(key) ? CellOf(item.at(key)) : "-");
    }
    rows.push_back(std::move(cells));
  }
  return Aligned(rows);
}

// The places that UTF-8 takes on a screen, for letters as ours.
std::size_t Width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string Aligned(const std::vector<Cells>& rows) {
  std::vector<std::size_t> widths;
  for (const Cells& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      widths[i] = std::max(widths[i], Width(row[i]));
    }
  }
  std::string text;
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool last = i + 1 == row.size();
      text += row[i];
      if (!last) text += std::string(widths[i] - Width(row[i]) + 2, ' ');
    }
    text.erase(text.find_last_not_of(' ') + 1);  // padding before an empty last cell
    text += "\n";
  }
  return text;
}

std::string StateText(const ordered_json& status) {
  if (status.at("silenced").get<bool>()) return "silenced: another robot is on this network";
  return status.at("ready").get<bool>() ? "ready" : "starting";
}

std::string SpeedText(const ordered_json& speed) {
  return speed.is_number() && speed.get<double>() == 0 ? "unlimited" : Fixed(speed, 3);
}

std::string ServiceText(const ordered_json& motion) {
  const auto service = motion.at("service").get<std::string>();
  return service.empty() ? "none"
                         : service + ", " + motion.at("name").get<std::string>() + " (" +
                               Count(motion.at("state")) + ")";
}

std::string PowerText(const ordered_json& status) {
  const auto power = status.at("power").get<std::string>();
  return power == "booting" ? power + ", " + Fixed(status.at("boots_for"), 0) + " s to go" : power;
}

std::string FollowedText(const ordered_json& commands) {
  auto state = commands.at("state").get<std::string>();
  if (state == "start") return "nobody yet: the motors hold the start pose or brake";
  if (state == "following") return "LowCmd";
  if (state == "damping") return "nobody: the motors brake until the next LowCmd";
  if (state == "limp") return "nobody: the motors have no torque";
  if (state == "motion_service") return "the motion service";
  return state;
}

std::string ReasonsText(const ordered_json& commands) {
  std::string reasons;
  for (const auto& [reason, number] : commands.at("refused").items()) {
    if (number == 0) continue;
    reasons += (reasons.empty() ? "" : ", ") + reason + " " + Count(number);
  }
  return reasons;
}

std::string ScriptText(const ordered_json& script) {
  const auto waiting = script.at("waiting").get<std::int64_t>();
  if (waiting == 0) return {};
  return script.at("where").get<std::string>() + ": " + script.at("waits_for").get<std::string>() +
         (waiting > 1 ? ", and " + std::to_string(waiting - 1) + " more" : "");
}

std::string RecordingText(const ordered_json& recording) {
  const auto state = recording.at("state").get<std::string>();
  if (state == "off") return "off";
  constexpr double kMega = 1e-6;
  const auto file = recording.at("file").get<std::string>();
  return state == "on" ? file + ", " + Fixed(recording.at("bytes"), 1, kMega) + " MB"
                       : state + ": " + file;
}

std::string StatusText(const ordered_json& status) {
  const ordered_json& pace = status.at("pace");
  const ordered_json& commands = status.at("commands");
  const ordered_json& crane = status.at("crane");
  const ordered_json& base = status.at("base");
  constexpr double kMilli = 1000;
  // Process, time and commands; then hands; then crane and base.
  std::vector<Cells> rows = {
      {"robot", status.at("robot").get<std::string>()},
      {"process", Count(status.at("pid"))},
      {"version", status.at("version").get<std::string>()},
      {"state", StateText(status)},
      {"simulated time", Fixed(status.at("time"), 3), "s"},
      {"steps", Count(status.at("steps"))},
      {"speed wanted", SpeedText(status.at("speed")), "x real time"},
      {"paused", status.at("paused").get<bool>() ? "yes" : "no"},
      {"speed", Fixed(pace.at("real_time_factor"), 3), "x real time"},
      {"lateness", Fixed(pace.at("lateness"), 3, kMilli), "ms"},
      {"worst lateness", Fixed(pace.at("worst_lateness"), 3, kMilli), "ms"},
      {"late steps", Count(pace.at("overruns"))},
      {"time lost", Fixed(pace.at("shifted"), 3), "s"},
      {"states published", Count(status.at("published"))},
      {"divergences", Count(status.at("divergences"))},
      {"power", PowerText(status)},
      {"motion service", ServiceText(status.at("motion"))},
      {"motors follow", FollowedText(commands)},
      {"rt/lowcmd writers", Count(commands.at("writers"))},
      {"commands taken", Count(commands.at("accepted"))},
      {"commands refused", Refused(commands)},
      {"command time-outs", Count(commands.at("timeouts"))},
      {"unused motors set", Count(commands.at("unused_slots"))},
      {"service calls", Count(status.at("services").at("requests"))},
      {"calls refused", Refused(status.at("services"))},
  };
  if (const std::string dangers = ProtectsText(status.at("motion")); !dangers.empty()) {
    rows.push_back({"protects from", dangers});
  }
  for (const ordered_json& hand : status.at("hands")) {
    const auto name = hand.at("name").get<std::string>() + " hand";
    rows.push_back({name + " taken", Count(hand.at("accepted"))});
    rows.push_back({name + " refused", Refused(hand)});
    rows.push_back({name + " time-outs", Count(hand.at("timeouts"))});
  }
  for (const auto& [hand, force] : status.at("hand_force").items()) {
    rows.push_back({hand + " hand force", Fixed(force, 1), "N"});
  }
  if (const std::string waits = ScriptText(status.at("script")); !waits.empty()) {
    rows.push_back({"script waits for", waits});
  }
  for (const ordered_json& one : status.at("unserved")) {
    rows.push_back({"nobody serves", one.at("text").get<std::string>()});
  }
  rows.insert(rows.end(), {
                              {"crane", Crane(crane)},
                              {"crane length", Fixed(crane.at("length"), 3), "m"},
                              {"crane tension", Fixed(crane.at("tension"), 1), "N"},
                              {"base clamped", status.at("clamped").get<bool>() ? "yes" : "no"},
                              {"base height", Fixed(base.at("height"), 3), "m"},
                              {"base tilt", Fixed(base.at("tilt"), 3), "rad"},
                              {"recording", RecordingText(status.at("recording"))},
                              {"randomized", Randomized(status.at("randomization"))},
                          });
  return Aligned(rows);
}

std::string FieldsText(const ordered_json& object) {
  std::vector<Cells> rows;
  AddFields(object, "", &rows);
  std::string text = Aligned(rows);
  for (const auto& [key, value] : object.items()) {
    if (IsTable(value)) text += "\n" + TableText(value);
  }
  return text;
}

std::string FaultsText(const ordered_json& snapshot) {
  const ordered_json& faults = snapshot.at("faults");
  return faults.empty() ? "no faults\n" : TableText(faults);
}

std::string SettingsText(const ordered_json& reply) {
  std::vector<Cells> rows = {{"KEY", "VALUE", "UNIT", "TAKES"}};
  for (const ordered_json& setting : reply.at("settings")) {
    const ordered_json& value = setting.at("value");
    std::string shown = value.is_string()    ? value.get<std::string>()
                        : value.is_boolean() ? (value.get<bool>() ? "true" : "false")
                                             : emulator::NumberText(value.get<double>());
    if (const auto real = setting.find("stands_for"); real != setting.end()) {
      shown += ": " + real->get<std::string>();
    }
    rows.push_back({setting.at("key"), shown, setting.at("unit"), setting.at("takes")});
  }
  return Aligned(rows);
}

std::string EventText(const ordered_json& event) {
  return Printed("%.3f s  ", event.at("time").get<double>()) + event.at("text").get<std::string>() +
         "\n";
}

std::string EventsText(const ordered_json& reply) {
  std::string text;
  std::size_t after_last = 0;  // where the last of the late ticks would stand
  std::int64_t ticks = 0;
  double from = 0, last = 0, worst = 0;  // s
  for (const ordered_json& event : reply.at("events")) {
    if (event.at("kind") != "overrun") {
      text += EventText(event);
      continue;
    }
    after_last = text.size();
    last = event.at("time").get<double>();
    if (ticks == 0) from = last;
    ticks += event.at("detail").at("count").get<std::int64_t>();
    worst = std::max(worst, event.at("detail").at("worst").get<double>());
  }
  if (ticks == 0) return text;
  const std::string late =
      std::to_string(ticks) + (ticks == 1 ? " tick" : " ticks") +
      Printed(" began late since %.1f s, the worst by %.1f ms", from, worst * 1e3);
  const ordered_json told = {{"time", last}, {"text", late}};
  return text.insert(after_last, EventText(told));
}

std::string RobotsText(const std::vector<client::RunningRobot>& robots) {
  if (robots.empty()) return "no robot runs\n";
  std::vector<Cells> rows = {{"NAME", "PROCESS", "SOCKET"}};
  for (const client::RunningRobot& robot : robots) {
    rows.push_back({robot.name, robot.pid == 0 ? "?" : std::to_string(robot.pid), robot.socket});
  }
  return Aligned(rows);
}

}  // namespace understudy::ctl
