#include "robot/motor.h"

#include <algorithm>
#include <cmath>

namespace understudy::robot {

double DesiredTorque(const MotorCommand& command, double q, double dq) {
  if (!command.enabled) return 0;
  double tau = command.tau;
  if (command.q != kNoPosition) tau += command.kp * (command.q - q);
  if (command.dq != kNoVelocity) tau += command.kd * (command.dq - dq);
  return tau;
}

double AvailableTorque(const MotorSpec& spec, double tau, double dq) {
  double limit = spec.torque_limit;
  const double speed = std::abs(dq);
  const bool drives = tau * dq > 0;
  if (drives && spec.knee_speed > 0 && speed > spec.knee_speed) {
    const double left = (spec.no_load_speed - speed) / (spec.no_load_speed - spec.knee_speed);
    limit *= std::max(left, 0.0);
  }
  return std::clamp(tau, -limit, limit);
}

namespace {

constexpr double kCooled = 10;  // °C below trip_c at which a motor works again; *assumed*

std::vector<double> KdShares(const RobotSpec& spec) {
  std::vector<double> shares(AllMotors(spec).size(), 1.0);
  if (spec.dynamics.use != DynamicsSource::kFitted) return shares;
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    for (const FittedDynamicsSpec& fit : spec.dynamics.fitted) {
      if (std::ranges::find(fit.slots, spec.motors[i].slot) != fit.slots.end()) {
        shares[i] = fit.kd_share;
      }
    }
  }
  return shares;
}

MotorCommand Scaled(MotorCommand command, const MotorSpec& spec) {
  if (!command.enabled) return {.enabled = true, .q = kNoPosition, .kd = spec.lock_kd};
  command.kp *= spec.kp_scale;
  command.kd *= spec.kd_scale;
  return command;
}

}  // namespace

MotorBank::MotorBank(const RobotSpec& spec)
    : thermal_(spec.thermal),
      motors_(AllMotors(spec)),
      kd_share_(KdShares(spec)),
      tripped_(motors_.size()),
      torque_(motors_.size()),
      work_c_(motors_.size(), spec.thermal.ambient_c + spec.thermal.rest_rise_c),
      winding_c_(work_c_) {
  for (const ParallelSpec& pair : spec.parallel) parallel_.emplace_back(pair);
}

std::span<const double> MotorBank::Step(const RobotCommand& command, std::span<const double> q,
                                        std::span<const double> dq, double dt,
                                        std::span<const MotorEffects> faults) {
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    MotorCommand motor = Scaled(command.motors[i], *motors_[i]);
    motor.kd *= kd_share_[i];
    torque_[i] = DesiredTorque(motor, q[i], dq[i]);
  }
  if (command.joint_space == JointSpace::kMotors) {
    for (const ParallelJoint& joint : parallel_) {
      const auto pitch = static_cast<std::size_t>(joint.pitch());
      const auto roll = static_cast<std::size_t>(joint.roll());
      const ParallelJoint::Motors x = joint.ToMotors({q[pitch], q[roll]});
      const ParallelJoint::Motors v = joint.ToMotors({dq[pitch], dq[roll]});
      const ParallelJoint::Serial tau = joint.TorqueToSerial(
          {DesiredTorque(Scaled(command.motors[roll], *motors_[roll]), x.a, v.a),
           DesiredTorque(Scaled(command.motors[pitch], *motors_[pitch]), x.b, v.b)});
      torque_[pitch] = tau.pitch;
      torque_[roll] = tau.roll;
    }
  }
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const MotorSpec& motor = *motors_[i];
    const MotorEffects fault = faults.empty() ? MotorEffects{} : faults[i];
    torque_[i] = motor.strength * AvailableTorque(motor, torque_[i], dq[i]) * fault.torque_share;
    if (tripped_[i]) torque_[i] = 0;
    const double rise = motor.rise_per_nm2_c > 0 ? motor.rise_per_nm2_c : thermal_.rise_per_nm2_c;
    const double steady =
        thermal_.ambient_c + thermal_.rest_rise_c + rise * torque_[i] * torque_[i];
    work_c_[i] += (steady - work_c_[i]) * dt / thermal_.time_constant;
    winding_c_[i] = work_c_[i] + fault.heat_c;
    tripped_[i] = winding_c_[i] >= thermal_.trip_c - (tripped_[i] ? kCooled : 0);
  }
  return torque_;
}

}  // namespace understudy::robot
