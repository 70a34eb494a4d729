// How far the first command of a recording is from where the robot was.
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "record/bytes.h"
#include "record/cdr_field.h"

namespace understudy::rehearse {

// Takes the messages of rt/lowstate and rt/lowcmd of one robot in order of time.
class FirstJump {
 public:
  // `slots` are those of its motors.
  explicit FirstJump(std::vector<int> slots) : slots_(std::move(slots)) {}

  void TakeState(std::string_view ros_type, record::ByteSpan message);
  // Returns the largest difference between an angle that the command asks for and the joint's
  // [rad], of the first command that asks for one after a state; nullopt for all others.
  std::optional<double> TakeCommand(std::string_view ros_type, record::ByteSpan message);

 private:
  struct Command {
    record::CdrField mode, q, kp;
  };

  std::vector<int> slots_;
  std::vector<record::CdrField> states_;  // by slot of slots_; empty before the first message
  std::vector<Command> commands_;         // by slot of slots_; empty before the first message
  std::vector<std::optional<double>> q_;  // rad, by slot of slots_, in the last state
  bool over_ = false;
};

}  // namespace understudy::rehearse
