#include "emulator/joint_rig.h"

#include <algorithm>

namespace understudy::emulator {

JointRig::JointRig(const std::vector<robot::MotorCommand>& holds, std::size_t motors)
    : out_{.motors = std::vector<robot::MotorCommand>(motors)} {
  for (const robot::MotorCommand& hold : holds) joints_.push_back({.command = hold});
}

void JointRig::Move(std::size_t motor, double to, double q, double until) {
  Joint& joint = joints_[motor];
  if (!joint.moved) {
    joint.moved = true;
    joint.command.q = q;
    ++moved_;
  }
  joint.to = to;
  joint.until = until;
}

void JointRig::Release() {
  for (Joint& joint : joints_) joint.moved = false;
  moved_ = 0;
}

const robot::RobotCommand& JointRig::Over(const robot::RobotCommand& command, double t, double dt) {
  if (!moves()) return command;
  out_ = command;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    if (!joint.moved) continue;
    if (t >= joint.until) {
      joint.moved = false;
      --moved_;
      continue;
    }
    joint.command.q += std::clamp(joint.to - joint.command.q, -kSpeed * dt, kSpeed * dt);
    out_.motors[i] = joint.command;
  }
  return out_;
}

}  // namespace understudy::emulator
