#include "motion/quadruped/motor_commands.h"

namespace understudy::motion {

void Brake(double kd, robot::RobotCommand* command) {
  for (robot::MotorCommand& motor : command->motors) {
    motor = {.enabled = true, .q = 0, .dq = 0, .tau = 0, .kp = 0, .kd = kd};
  }
}

void CommandLegs(const LegCommand& legs, double kp, double kd, robot::RobotCommand* command) {
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t leg = i / 3;
    const auto at = static_cast<Eigen::Index>(i % 3);
    const double q = legs.q[leg][at] + (legs.tau[leg][at] + kd * legs.dq[leg][at]) / kp;
    command->motors[i] = {.enabled = true, .q = q, .dq = 0, .tau = 0, .kp = kp, .kd = kd};
  }
}

robot::MotorCommand WheelCommands::Run(std::size_t leg, double rate) {
  held_[leg] = robot::kNoPosition;
  return Told(0, rate, 0);
}

robot::MotorCommand WheelCommands::Stay(std::size_t leg, double q, double carried) {
  if (held_[leg] == robot::kNoPosition) held_[leg] = q + carried;
  return Told(held_[leg] - carried, 0, figures_.wheel_kp);
}

robot::MotorCommand WheelCommands::Told(double q, double dq, double kp) const {
  return {.enabled = true, .q = q, .dq = dq, .tau = 0, .kp = kp, .kd = figures_.wheel_kd};
}

}  // namespace understudy::motion
