#include "ctl/status_screen.h"

#include <cstdint>
#include <vector>

#include "base/printed.h"
#include "ctl/text.h"

namespace understudy::ctl {
namespace {

using nlohmann::ordered_json;
using Pointer = ordered_json::json_pointer;

std::string Number(const char* format, const ordered_json& value) {
  if (value.is_null()) return "-";
  return Printed(format, value.get<double>());
}

// Returns a count, or the sum of an object of counts.
std::int64_t CountAt(const ordered_json& status, const char* field) {
  const ordered_json& value = status.at(Pointer(field));
  if (!value.is_object()) return value.get<std::int64_t>();
  std::int64_t sum = 0;
  for (const ordered_json& count : value) sum += count.get<std::int64_t>();
  return sum;
}

std::string Pace(const ordered_json& status) {
  if (status.at("paused").get<bool>()) {
    const auto left = status.at("steps_left").get<std::int64_t>();
    return left == 0 ? "paused" : "paused, " + std::to_string(left) + " steps to make";
  }
  return Number("%.2f", status.at("/pace/real_time_factor"_json_pointer)) + " x real time of " +
         SpeedText(status.at("speed"));
}

}  // namespace

std::string StatusScreen::Text(const ordered_json& status, std::chrono::nanoseconds now) {
  const double wall = std::chrono::duration<double>(now - then_).count();
  const auto row = [&](const char* label, const char* field, const std::string& note = "") {
    const std::int64_t total = CountAt(status, field);
    std::string rate = "-";
    if (!before_.is_null() && wall > 0) {
      rate = Number("%.0f", static_cast<double>(total - CountAt(before_, field)) / wall);
    }
    return Cells{label, rate, std::to_string(total), note};
  };
  const ordered_json& commands = status.at("commands");
  const ordered_json& base = status.at("base");
  const ordered_json& crane = status.at("crane");
  const ordered_json& remote = status.at("remote");

  std::string text = status.at("robot").get<std::string>() + ", process " +
                     std::to_string(status.at("pid").get<int>()) + ": " + StateText(status) + "\n" +
                     Number("%.3f", status.at("time")) + " s, " + Pace(status) + "\n\n";
  // Counts with their rates.
  text += Aligned({
      {"", "PER SECOND", "TOTAL", ""},
      row("steps", "/steps"),
      row("late steps", "/pace/overruns",
          "worst " + Number("%.3f", status.at("/pace/worst_lateness"_json_pointer)) + " s late"),
      row("states published", "/published"),
      row("commands taken", "/commands/accepted",
          "writers " + std::to_string(commands.at("writers").get<int>())),
      row("commands refused", "/commands/refused", ReasonsText(commands)),
      row("command time-outs", "/commands/timeouts"),
  });
  text += "\n";
  // State.
  std::vector<Cells> state = {
      {"motion service", ServiceText(status.at("motion"))},
      {"motors follow", FollowedText(commands)},
      {"base", Number("%.3f", base.at("height")) + " m high, tilted by " +
                   Number("%.3f", base.at("tilt")) + " rad" +
                   (status.at("clamped").get<bool>() ? ", clamped" : "")},
      {"crane",
       crane.at("attached").get<bool>() ? Number("%.1f", crane.at("tension")) + " N" : "released"},
      {"remote", remote.at("there").get<bool>() ? "keys " + remote.at("keys").get<std::string>()
                                                : "not there"},
  };
  for (const auto& [hand, force] : status.at("hand_force").items()) {
    state.push_back({hand + " hand force", Number("%.1f", force) + " N"});
  }
  if (std::string waits = ScriptText(status.at("script")); !waits.empty()) {
    state.push_back({"script waits for", std::move(waits)});
  }
  text += Aligned(state);
  before_ = status;
  then_ = now;
  return text;
}

std::string OverTheScreen(const std::string& text) {
  std::string screen =
      "\033[H";  // home; below, \033[K clears the rest of a line, \033[J of the screen
  for (const char c : text) {
    if (c == '\n') screen += "\033[K";
    screen += c;
  }
  return screen + "\033[J";
}

}  // namespace understudy::ctl
