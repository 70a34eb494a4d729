// What a window says over its picture.
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "viewer/scene_state.h"

namespace understudy::viewer {

// Two columns, line by line, as mjr_overlay takes them.
struct TextBlock {
  std::string left, right;
  void Add(const std::string& name, const std::string& value);
};

// Simulated seconds per second of wall time, over the last second or so.
class RealTimeFactor {
 public:
  void Add(double simulated, double wall);
  double value() const;  // 0 before there is one

 private:
  std::deque<std::pair<double, double>> last_;  // simulated, wall
};

// Time, speed and who holds the motors. `service` may be "" for unknown.
TextBlock StatusText(const SceneState& state, double real_time_factor, const std::string& service);

// The keys and what the mouse does.
TextBlock HelpText();

}  // namespace understudy::viewer
