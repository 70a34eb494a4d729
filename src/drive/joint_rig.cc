#include "drive/joint_rig.h"

#include <algorithm>

namespace understudy::drive {

JointRig::JointRig(const robot::RobotSpec& spec)
    : out_{.motors = std::vector<robot::MotorCommand>(robot::AllMotors(spec).size())} {
  for (const robot::MotorSpec& motor : spec.motors) {
    joints_.push_back({.command = {.enabled = true, .kp = motor.hold_kp, .kd = motor.hold_kd}});
  }
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
  if (moved_ == 0) return;
  for (Joint& joint : joints_) joint.moved = false;
  moved_ = 0;
}

const robot::RobotCommand& JointRig::Over(const robot::RobotCommand& command, double t, double dt) {
  if (moved_ == 0) return command;
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

}  // namespace understudy::drive
