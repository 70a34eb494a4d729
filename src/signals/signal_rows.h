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
  std::string_view argument;  // "", JOINT, FOOT, HAND, PAD, OBJECT, TOPIC or EVENT
  std::string_view unit;
  Signal::Source source;
  std::string_view says;
  // kTruth: its value; `index` is that of the joint, foot, hand or pad.
  double (*of)(const TruthView& truth, std::size_t index) = nullptr;
  // kField: its value in the sample of which the message is made.
  double (*of_sample)(const robot::RobotState& sample, std::size_t joint) = nullptr;
  // Of the hg family, where that is another.
  double (*of_hg_sample)(const robot::RobotState& sample, std::size_t joint) = nullptr;
  // kTruth of an object, in place of `of`.
  double (*of_object)(const ObjectView& object) = nullptr;
  // Of messages their topic, of events their kind, where it is not the argument.
  std::string_view topic{};
  // Its field in that; of a joint the field of its motor_state.
  std::string_view field{};
  bool of_obstacles = false;  // Signal::of_obstacles
  // kTruth: why recordings that have the truth may lack it; stands behind the signal's name.
  std::string_view why_unknown{};
  bool share = false;  // its size as a share of the motor's torque_limit
};

std::span<const SignalRow> SignalRows();

// Returns the words as they are written: "base.height", "q(JOINT)".
std::vector<std::string> SignalWords();

}  // namespace understudy::signals
