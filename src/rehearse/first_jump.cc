#include "rehearse/first_jump.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "robot/robot_values.h"

namespace understudy::rehearse {
namespace {

std::string Of(const char* motors, int slot, const char* field) {
  return std::string(motors) + "[" + std::to_string(slot) + "]." + field;
}

}  // namespace

void FirstJump::TakeState(std::string_view ros_type, record::ByteSpan message) {
  if (over_) return;
  if (states_.empty()) {
    for (const int slot : slots_) {
      states_.push_back(record::FindField(ros_type, Of("motor_state", slot, "q")));
    }
  }
  q_.resize(states_.size());
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = record::ReadField(states_[i], message);
}

std::optional<double> FirstJump::TakeCommand(std::string_view ros_type, record::ByteSpan message) {
  if (over_ || q_.empty()) return std::nullopt;
  if (commands_.empty()) {
    const auto find = [ros_type](int slot, const char* field) {
      return record::FindField(ros_type, Of("motor_cmd", slot, field));
    };
    for (const int slot : slots_) {
      commands_.push_back({find(slot, "mode"), find(slot, "q"), find(slot, "kp")});
    }
  }
  std::optional<double> jump;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    const Command& of = commands_[i];
    const robot::MotorCommand command{.enabled = record::ReadField(of.mode, message) != 0,
                                      .q = record::ReadField(of.q, message).value_or(0),
                                      .kp = record::ReadField(of.kp, message).value_or(0)};
    if (!q_[i] || !robot::AsksForAngle(command)) continue;
    jump = std::max(jump.value_or(0), std::abs(command.q - *q_[i]));
  }
  over_ = jump.has_value();
  return jump;
}

}  // namespace understudy::rehearse
