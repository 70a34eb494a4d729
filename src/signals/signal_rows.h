// The table of the words by which conditions name signals.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_values.h"
#include "signals/signals.h"

namespace understudy::signals {

// A word of conditions. TOPIC:FIELD and EVENT.FIELD are no rows: there are as many as messages and
// events have fields.
struct SignalRow {
  std::string_view word;      // "base.height"; of one with an argument what stands before it
  std::string_view argument;  // "", JOINT, FOOT, TOPIC or EVENT
  std::string_view unit;
  Origin origin;
  std::string_view says;
  // For Origin::kTruth: its value; `index` is that of the joint or foot.
  double (*of)(const Truth& truth, std::size_t index);
  // For Origin::kMessages: its value in the sample of which the message is made; null if it is not
  // there.
  double (*of_sample)(const robot::RobotState& sample, std::size_t joint) = nullptr;
  // Of the hg family, where that is another.
  double (*of_hg_sample)(const robot::RobotState& sample, std::size_t joint) = nullptr;
  // Likewise of a joint: its field in motor_state, where that is not the word.
  std::string_view field{};
  bool share = false;  // its size as a share of the motor's torque_limit
};

std::span<const SignalRow> SignalRows();

// Returns the words as they are written: "base.height", "q(JOINT)".
std::vector<std::string> SignalWords();

}  // namespace understudy::signals
