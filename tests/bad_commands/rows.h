// The table of bad commands: what a program does, and what the robot does then.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_spec.h"
#include "tests/bad_commands/rig.h"

namespace understudy::bad_commands {

struct Row {
  std::string_view group;
  std::string_view sends;     // what the program does
  std::string_view reaction;  // what the robot does
  std::string_view counted;   // the word under which it is counted; "" if it is not
  std::string_view grade, source;
  std::string_view robots;                              // "" for all
  std::function<bool(const robot::RobotSpec&)> is_for;  // null: all
  std::function<void(Rig*)> play;                       // does it, and expects that
  bool service = false;                                 // while a motion service is on
};

// Its groups.
std::vector<Row> ValueRows();
std::vector<Row> FormRows();
std::vector<Row> TimeRows();
std::vector<Row> WriterRows();

const std::vector<Row>& Rows();

// docs/reference/bad_commands.md.
std::string Reference();

}  // namespace understudy::bad_commands
