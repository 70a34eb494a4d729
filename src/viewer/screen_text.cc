#include "viewer/screen_text.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include <nlohmann/json.hpp>

#include "base/printed.h"

namespace understudy::viewer {
namespace {

constexpr double kSpan = 1.0;  // s of wall time

}  // namespace

void TextBlock::Add(const std::string& name, const std::string& value) {
  if (!left.empty()) {
    left += '\n';
    right += '\n';
  }
  left += name;
  right += value;
}

void RealTimeFactor::Add(double simulated, double wall) {
  if (!last_.empty() && simulated < last_.back().first) last_.clear();
  last_.emplace_back(simulated, wall);
  while (last_.size() > 2 && wall - last_[1].second > kSpan) last_.pop_front();
}

double RealTimeFactor::value() const {
  if (last_.size() < 2) return 0;
  const double wall = last_.back().second - last_.front().second;
  return wall > 0 ? (last_.back().first - last_.front().first) / wall : 0;
}

std::string MotorsText(const nlohmann::json& status) {
  using Place = nlohmann::json::json_pointer;
  const Place service("/motion/service"), name("/motion/name"), id("/motion/state");
  const bool tells = status.contains(service) && status.contains(name) && status.contains(id) &&
                     status[service].is_string() && status[name].is_string() &&
                     status[id].is_number_integer();
  if (!tells) return {};
  const auto alias = status[service].get<std::string>();
  if (alias.empty()) return "none: motors follow rt/lowcmd";
  return alias + ", " + status[name].get<std::string>() + " (" +
         std::to_string(status[id].get<int>()) + ")";
}

TextBlock StatusText(const SceneState& state, double real_time_factor, const std::string& motors) {
  TextBlock text;
  text.Add("time", Printed("%.2f s", state.time) + (state.paused ? "  PAUSED" : ""));
  text.Add("speed",
           (state.speed > 0 ? Printed("%.4g", state.speed) : std::string("as fast as possible")) +
               Printed("  (%.2f x real time)", real_time_factor));
  if (!motors.empty()) text.Add("motors", motors);
  if (!state.keys.empty()) text.Add("remote", state.keys);
  return text;
}

Caption CaptionAt(double now, double span, const std::vector<FilmEvent>& events) {
  Caption caption{.clock = Printed("%.2f s", now), .events = {}};
  for (const FilmEvent& event : events) {
    if (event.time > now || event.time <= now - span) continue;
    caption.events.push_back(Printed("%.2f s  ", event.time) + event.text);
  }
  if (caption.events.size() > kMostShown) {
    caption.events.erase(caption.events.begin(), caption.events.end() - kMostShown);
  }
  return caption;
}

std::string InFontsLetters(const std::string& text) {
  struct Row {
    const char* sign;
    const char* word;
  };
  constexpr Row kRows[] = {{"·", "*"}, {"°", " deg"}, {"²", "2"}, {"…", "..."}, {"−", "-"}};
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x80) {
      out += c < ' ' || c == 0x7F ? ' ' : text[i];
      ++i;
      continue;
    }
    const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& one) {
      return text.compare(i, std::strlen(one.sign), one.sign) == 0;
    });
    out += row == std::end(kRows) ? "?" : row->word;
    // A letter goes on as long as its bytes begin with the bits 10.
    for (++i; i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80; ++i) {
    }
  }
  return out;
}

TextBlock HelpText() {
  TextBlock text;
  text.Add("F1", "this help");
  text.Add("Space", "pause, go on");
  text.Add("Right", "make a step while paused; with Shift 20");
  text.Add("+ -", "faster, slower");
  text.Add("Backspace", "back to the start pose");
  text.Add("C F M J X", "contacts, forces, centre of mass, joints, collision shapes");
  text.Add("T", "follow the robot, or the selected body");
  text.Add("[ ]", "cameras of the model");
  text.Add("V", "back to the first view");
  text.Add("R", "keyboard as the remote controller, Esc ends it");
  text.Add("Esc Q", "close the window; the robot runs on");
  text.Add("left drag", "turn the view; with Shift about the vertical");
  text.Add("right drag", "move the view; with Shift along the ground");
  text.Add("wheel", "nearer, further");
  text.Add("double click", "select a body; right: look there");
  text.Add("Ctrl drag", "pull the selected body");
  return text;
}

}  // namespace understudy::viewer
