#include "motion/policy_drive.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"

namespace understudy::motion {
namespace {

std::vector<policy::MotorName> NamesOf(const robot::RobotSpec& spec) {
  std::vector<policy::MotorName> names;
  for (const robot::MotorSpec& motor : spec.motors) {
    names.push_back({.joint = motor.joint, .slot = motor.slot});
  }
  return names;
}

}  // namespace

PolicyDrive::PolicyDrive(const robot::RobotSpec& spec, const std::string& definition)
    : policy_(policy::LoadPolicy(definition, NamesOf(spec), spec.name)) {
  const double ratio = policy_.definition().step_dt * spec.rates.service_hz;
  if (std::lround(ratio) < 1 || std::abs(ratio - std::round(ratio)) > 1e-4) {
    throw ConfigError(policy_.definition().name +
                      ": step_dt: expected a multiple of the period of robot.rates.service_hz, " +
                      std::to_string(1 / spec.rates.service_hz) + " s, got " +
                      std::to_string(policy_.definition().step_dt));
  }
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const robot::MotorSpec& motor = spec.motors[i];
    command_.push_back(
        {.enabled = true, .q = spec.standing.q[i], .kp = motor.hold_kp, .kd = motor.hold_kd});
  }
  const auto motors = static_cast<Eigen::Index>(spec.motors.size());
  sensed_.q.setZero(motors);
  sensed_.dq.setZero(motors);
}

void PolicyDrive::Sense(std::size_t motor, double q, double dq) {
  sensed_.q[static_cast<Eigen::Index>(motor)] = static_cast<float>(q);
  sensed_.dq[static_cast<Eigen::Index>(motor)] = static_cast<float>(dq);
}

void PolicyDrive::Sense(const Eigen::Quaterniond& R_WI, const Eigen::Vector3d& w_WI_I) {
  sensed_.R_WI = R_WI.cast<float>();
  sensed_.w_WI_I = w_WI_I.cast<float>();
}

void PolicyDrive::Begin() {
  policy_.Begin(sensed_);
  until_due_ = 0;
}

void PolicyDrive::Step(double dt, robot::RobotCommand* command) {
  if (until_due_ <= 0) {
    until_due_ = std::lround(policy_.definition().step_dt / dt);
    policy_.Step(sensed_);
    for (const policy::Target& target : policy_.targets()) {
      command_[target.motor] = {.enabled = true, .q = target.q, .kp = target.kp, .kd = target.kd};
    }
  }
  --until_due_;
  std::ranges::copy(command_, command->motors.begin());
}

}  // namespace understudy::motion
