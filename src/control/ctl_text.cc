#include "control/ctl_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace understudy {
namespace {

using nlohmann::ordered_json;

using Cells = std::vector<std::string>;

// Pads every column but the last of each row to its widest cell, two spaces between columns.
std::string Aligned(const std::vector<Cells>& rows) {
  std::vector<std::size_t> widths;
  for (const Cells& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool last = i + 1 == row.size();
      text += row[i];
      text += last ? "\n" : std::string(widths[i] - row[i].size() + 2, ' ');
    }
  }
  return text;
}

// "-" for null, which stands for a number that is not finite.
std::string Fixed(const ordered_json& value, int digits, double scale = 1) {
  if (value.is_null()) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value.get<double>() * scale);
  return text;
}

std::string Count(const ordered_json& value) { return std::to_string(value.get<std::int64_t>()); }

std::string State(const ordered_json& status) {
  if (status.at("silenced").get<bool>()) return "silenced: another robot is on this network";
  return status.at("ready").get<bool>() ? "ready" : "starting";
}

std::string Speed(const ordered_json& speed) {
  return speed.is_number() && speed.get<double>() == 0 ? "unlimited" : Fixed(speed, 3);
}

// "mcf, state 1001"
std::string Service(const ordered_json& motion) {
  const auto service = motion.at("service").get<std::string>();
  return service.empty() ? "none" : service + ", state " + Count(motion.at("state"));
}

std::string Crane(const ordered_json& crane) {
  return crane.at("attached").get<bool>() ? "attached" : "released";
}

std::string Randomized(const ordered_json& randomization) {
  return randomization.is_null() ? "no" : "from seed " + Count(randomization.at("seed"));
}

// "0", or "3 (crc 2, gain 1; last gain)".
std::string Refused(const ordered_json& commands) {
  std::int64_t total = 0;
  std::string reasons;
  for (const auto& [reason, number] : commands.at("refused").items()) {
    if (number == 0) continue;
    total += number.get<std::int64_t>();
    reasons += (reasons.empty() ? "" : ", ") + reason + " " + Count(number);
  }
  if (total == 0) return "0";
  return std::to_string(total) + " (" + reasons + "; last " +
         commands.at("last_refusal").get<std::string>() + ")";
}

}  // namespace

std::string StatusText(const ordered_json& status) {
  const ordered_json& pace = status.at("pace");
  const ordered_json& commands = status.at("commands");
  const ordered_json& crane = status.at("crane");
  const ordered_json& base = status.at("base");
  constexpr double kMilli = 1000;
  std::vector<Cells> rows = {
      {"robot", status.at("robot").get<std::string>()},
      {"process", Count(status.at("pid"))},
      {"version", status.at("version").get<std::string>()},
      {"state", State(status)},
      {"simulated time", Fixed(status.at("time"), 3), "s"},
      {"steps", Count(status.at("steps"))},
      {"speed wanted", Speed(status.at("speed")), "x real time"},
      {"speed", Fixed(pace.at("real_time_factor"), 3), "x real time"},
      {"lateness", Fixed(pace.at("lateness"), 3, kMilli), "ms"},
      {"worst lateness", Fixed(pace.at("worst_lateness"), 3, kMilli), "ms"},
      {"overruns", Count(pace.at("overruns"))},
      {"not made up for", Fixed(pace.at("shifted"), 3), "s"},
      {"states published", Count(status.at("published"))},
      {"divergences", Count(status.at("divergences"))},
      {"motion service", Service(status.at("motion"))},
      {"motors follow", commands.at("state").get<std::string>()},
      {"command writers", Count(commands.at("writers"))},
      {"commands taken", Count(commands.at("accepted"))},
      {"commands refused", Refused(commands)},
      {"command time-outs", Count(commands.at("timeouts"))},
      {"unused slots set", Count(commands.at("unused_slots"))},
  };
  for (const ordered_json& hand : status.at("hands")) {
    const auto name = hand.at("name").get<std::string>() + " hand";
    rows.push_back({name + " taken", Count(hand.at("accepted"))});
    rows.push_back({name + " refused", Refused(hand)});
    rows.push_back({name + " time-outs", Count(hand.at("timeouts"))});
  }
  rows.insert(rows.end(), {
                              {"crane", Crane(crane)},
                              {"crane length", Fixed(crane.at("length"), 3), "m"},
                              {"crane tension", Fixed(crane.at("tension"), 1), "N"},
                              {"base clamped", status.at("clamped").get<bool>() ? "yes" : "no"},
                              {"base height", Fixed(base.at("height"), 3), "m"},
                              {"base tilt", Fixed(base.at("tilt"), 3), "rad"},
                              {"randomized", Randomized(status.at("randomization"))},
                          });
  return Aligned(rows);
}

std::string RobotsText(const std::vector<RunningRobot>& robots) {
  if (robots.empty()) return "no robot runs\n";
  std::vector<Cells> rows = {{"NAME", "PROCESS", "SOCKET"}};
  for (const RunningRobot& robot : robots) {
    rows.push_back({robot.name, robot.pid == 0 ? "?" : std::to_string(robot.pid), robot.socket});
  }
  return Aligned(rows);
}

}  // namespace understudy
