// Formats the text over a window's picture.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "viewer/scene_state.h"

namespace understudy::viewer {

// Two columns, line by line, as mjr_overlay takes them.
struct TextBlock {
  std::string left, right;
  void Add(const std::string& name, const std::string& value);
};

// Computes simulated seconds per wall second over about the last second.
class RealTimeFactor {
 public:
  void Add(double simulated, double wall);
  double value() const;  // 0 before there is one

 private:
  std::deque<std::pair<double, double>> last_;  // simulated, wall
};

// Says who moves the motors, from a status of the control plane: "mcf, lying (1004)"; "" if it does
// not tell.
std::string MotorsText(const nlohmann::json& status);

// Formats time, speed and who moves the motors, "" if unknown.
TextBlock StatusText(const SceneState& state, double real_time_factor, const std::string& motors);

// An event as a film shows it.
struct FilmEvent {
  double time = 0;  // simulated s
  std::string text;
};

// What stands over a picture of a film.
struct Caption {
  std::string clock;                // "12.34 s"
  std::vector<std::string> events;  // a line each, oldest first
};

// Events shown together at most; *assumed*: a fifth of a picture's height.
inline constexpr std::size_t kMostShown = 4;

// Returns the caption of second `now`: of `events`, in order of time, the last kMostShown that
// happened in the `span` s before.
Caption CaptionAt(double now, double span, const std::vector<FilmEvent>& events);

// Returns `text`, UTF-8, in the letters that MuJoCo's fonts have: ASCII. Units become words or
// near signs (N·m N*m, ° deg), what else there is "?", and control characters spaces.
std::string InFontsLetters(const std::string& text);

// Lists the functions of keys and mouse.
TextBlock HelpText();

}  // namespace understudy::viewer
