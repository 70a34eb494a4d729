// Formats the text over a window's picture.
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

// Computes simulated seconds per wall second over about the last second.
class RealTimeFactor {
 public:
  void Add(double simulated, double wall);
  double value() const;  // 0 before there is one

 private:
  std::deque<std::pair<double, double>> last_;  // simulated, wall
};

// Formats time, speed and the motion service. `service` is "" if unknown.
TextBlock StatusText(const SceneState& state, double real_time_factor, const std::string& service);

// Lists the functions of keys and mouse.
TextBlock HelpText();

}  // namespace understudy::viewer
