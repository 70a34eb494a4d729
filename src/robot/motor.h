// The motor law and its limits, pure; and the bank that applies them to all motors of a robot in a
// tick.
#pragma once

#include <span>
#include <vector>

#include "robot/parallel_joint.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::robot {

// Torque [N·m] the motor would like to give at joint angle q [rad] and rate dq [rad/s], before any
// limit:
//
//   tau + kp (q_des - q) + kd (dq_des - dq)
//
// (unitree_sdk2 example/h1/README; confirmed to 1 % by logs of a real G1,
// docs/sources.md#motor-law.)
// kNoPosition and kNoVelocity leave out their term. A disabled motor wants 0. NaN in, NaN out:
// CommandGate has refused it before.
double DesiredTorque(const MotorCommand& command, double q, double dq);

// `tau` [N·m] cut to what the motor can give at rate dq [rad/s]: torque_limit up to knee_speed,
// from there falling linearly to 0 at no_load_speed when it drives; braking is limited by
// torque_limit alone. All of this shape is *assumed*. knee_speed = 0 means that only torque_limit
// counts.
double AvailableTorque(const MotorSpec& spec, double tau, double dq);

// All motors of one robot, body and hands. Knows temperatures; allocates only in the constructor.
class MotorBank {
 public:
  // `spec` must outlive the bank.
  explicit MotorBank(const RobotSpec& spec);

  // Joint torques [N·m] in motor order for the joint angles q [rad] and rates dq [rad/s] of the
  // same instant, and the motor temperatures one step of dt [s] on. The span stays valid until the
  // next call. In JointSpace::kMotors the parallel pairs follow their command in motor space; their
  // limits stay those of pitch and roll (*assumed*). In JointSpace::kPitchRoll, and of motors in no
  // pair, only the fitted share of a commanded kd acts (spec.dynamics). Gains and torque of each
  // motor are scaled as MotorSpec says; in JointSpace::kMotors `strength` counts at pitch and roll.
  // A motor that is not enabled brakes with its lock_kd.
  std::span<const double> Step(const RobotCommand& command, std::span<const double> q,
                               std::span<const double> dq, double dt);

  // Torques of the last Step, zero before.
  std::span<const double> torque() const { return torque_; }
  // Winding temperatures, °C. First-order, driven by torque squared (*assumed*, docs/fidelity.md).
  std::span<const double> winding_c() const { return winding_c_; }

 private:
  const ThermalSpec& thermal_;
  std::vector<const MotorSpec*> motors_;
  std::vector<ParallelJoint> parallel_;
  std::vector<double> kd_share_;  // motor order
  std::vector<double> torque_;
  std::vector<double> winding_c_;
};

}  // namespace understudy::robot
