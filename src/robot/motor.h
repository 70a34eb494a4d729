// The motor law and its limits, and the bank that applies them to all motors of a robot.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "robot/fault.h"
#include "robot/parallel_joint.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::robot {

// Returns the torque [N·m] before limits at joint angle q [rad] and rate dq [rad/s]:
//
//   tau + kp (q_des - q) + kd (dq_des - dq)
//
// (unitree_sdk2 example/h1/README; confirmed to 1 % by logs of a real G1,
// docs/sources.md#motor-law.) kNoPosition and kNoVelocity omit their term. A disabled motor has
// torque 0. NaN gives NaN, but CommandGate refuses it before.
double DesiredTorque(const MotorCommand& command, double q, double dq);

// Returns `tau` [N·m] clamped to the available torque at rate dq [rad/s]: when driving,
// torque_limit up to knee_speed and from there linearly down to 0 at no_load_speed; when braking,
// torque_limit. This shape is *assumed*. With knee_speed 0 only torque_limit applies.
double AvailableTorque(const MotorSpec& spec, double tau, double dq);

// All motors of one robot, of body and hands, with their temperatures. Allocates only in the
// constructor.
class MotorBank {
 public:
  // `spec` must outlive the bank.
  explicit MotorBank(const RobotSpec& spec);

  // Returns the joint torques [N·m] in motor order for joint angles q [rad] and rates dq [rad/s] of
  // one instant, and integrates the temperatures over dt [s]. The span is valid until the next
  // call. In JointSpace::kMotors the parallel pairs follow their command in motor space, with the
  // limits of pitch and roll (*assumed*). In JointSpace::kPitchRoll, and for other motors, kd is
  // multiplied by the fitted kd_share (spec.dynamics). Gains and torque are scaled by the factors
  // of MotorSpec; in JointSpace::kMotors `strength` applies to pitch and roll. A motor that is not
  // enabled brakes with its lock_kd. A fault takes its share of the torque, in kMotors of pitch's
  // and roll's; no `faults` are none. A motor whose winding reaches ThermalSpec::trip_c gives no
  // torque until it has cooled by 10 °C (*assumed*).
  std::span<const double> Step(const RobotCommand& command, std::span<const double> q,
                               std::span<const double> dq, double dt,
                               std::span<const MotorEffects> faults = {});

  // Returns the torques of the last Step, zeros before.
  std::span<const double> torque() const { return torque_; }
  // Returns the winding temperatures, °C: first-order, driven by the square of torque (*assumed*,
  // docs/fidelity.md).
  std::span<const double> winding_c() const { return winding_c_; }
  // Whether a motor is too hot to give torque.
  bool tripped(std::size_t motor) const { return tripped_[motor]; }

 private:
  const ThermalSpec& thermal_;
  std::vector<const MotorSpec*> motors_;
  std::vector<ParallelJoint> parallel_;
  std::vector<double> kd_share_;  // motor order
  std::vector<bool> tripped_;
  std::vector<double> torque_;
  std::vector<double> work_c_;     // °C, of the winding by what the motor did
  std::vector<double> winding_c_;  // with what faults add
};

}  // namespace understudy::robot
