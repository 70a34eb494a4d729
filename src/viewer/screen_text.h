// Formats the text over a window's picture.
#pragma once

#include <deque>
#include <string>
#include <utility>

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

// Lists the functions of keys and mouse.
TextBlock HelpText();

}  // namespace understudy::viewer
