// The motor law, the limits of motors by speed, voltage and heat, and the bank that applies them to
// all motors of a robot.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
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
// docs/dev/sources.md#motor-law.) kNoPosition and kNoVelocity omit their term. It is at most
// command.most, either way. A disabled motor has torque 0. NaN gives NaN, but CommandGate refuses
// it before.
double DesiredTorque(const MotorCommand& command, double q, double dq);

// Returns the angle [rad] that a motor follows in place of a commanded one: kept within `clamp`,
// which is MotorSpec::q_clamp; {0, 0} is none.
double FollowedAngle(double q, const std::array<double, 2>& clamp);

// The torque of a motor over its speed: `limit`, which is its current's, and a straight line that
// passes it at `knee` and ends at `no_load`, which is its voltage's.
struct TorqueCurve {
  double limit = 0;    // N·m
  double knee = 0;     // rad/s; 0 = torque does not depend on speed
  double no_load = 0;  // rad/s at which the driving torque is 0
};

// Returns `tau` [N·m] clamped to the available torque at rate dq [rad/s]. With `volts`, the share
// of the voltage for which the curve holds, 0 to 1, the line moves down to end at volts · no_load,
// so that below 1 - knee / no_load not even a motor at rest gives all of its torque. Without a knee
// the limit itself goes down by that share. `heat` is the share of the limit that its temperature
// leaves. That the line is straight is *assumed*.
double AvailableTorque(const TorqueCurve& curve, double tau, double dq, double volts = 1,
                       double heat = 1);

// What the bus has for the motors.
struct MotorSupply {
  double voltage = std::numeric_limits<double>::infinity();     // V
  double most_power = std::numeric_limits<double>::infinity();  // W, for all motors together
  bool on = true;                                               // false: no motor gives torque
};

// What a step of the motors takes, of one instant and in motor order.
struct MotorInstant {
  const RobotCommand& command;
  std::span<const double> q, dq;         // rad, rad/s, as the encoders read them
  std::span<const double> rate{};        // rad/s, as the joints turn; none: dq
  std::span<const double> friction_w{};  // W that friction of the joints takes; none: 0
  MotorSupply supply{};
  std::span<const MotorEffects> faults{};  // none: all are fine
};

// Returns by which share of a commanded kd each motor brakes, as it was fitted; 1 where it was not.
std::vector<double> KdShares(const RobotSpec& spec);

// All motors of one robot, of body and hands, with their temperatures.
//
// Heat. Winding and casing of each motor are two thermal masses in series. The winding is heated by
// the square of the motor's current, which goes with torque, and by a resistance that grows by
// 0.393 % per °C as copper's does; the casing by the friction of its joint. Losses are averaged
// over kHeatPeriod and then integrated exactly. From derate_c on the limit of torque falls,
// straight, to half of it at trip_c (*assumed*); there the motor trips and gives nothing until it
// has cooled by 10 °C (*assumed*).
//
// Parallel pairs. What limits and heats are the motors A and B, each with half of the pitch's
// torque_limit and with the pitch's speeds (*assumed*; the vendor's figures of pitch and roll of an
// H1-2's and an H2's ankle are in the ratio that follows). The limit of either joint holds besides.
//
// Allocates only in the constructor.
class MotorBank {
 public:
  static constexpr double kHeatPeriod = 0.1;  // s

  // `spec` must outlive the bank. `dt` [s] is the time between steps.
  MotorBank(const RobotSpec& spec, double dt);

  // Returns the joint torques [N·m] in motor order for one instant, and takes their heat into
  // account. The span is valid until the next call. Parallel pairs whose command of pitch is in
  // JointSpace::kMotors follow it in motor space. In JointSpace::kPitchRoll, and for other motors,
  // a commanded q is kept within q_clamp and kd is multiplied by the fitted kd_share
  // (spec.dynamics). Gains are scaled by the factors of MotorSpec. A motor that is not enabled
  // brakes with its lock_kd. `strength` and a fault's share of torque act on a motor, of a pair on
  // B in pitch's place and on A in roll's: it gives less for the same current. Where all together
  // would take more than the supply's most_power, all give less by one share (*assumed*).
  std::span<const double> Step(const MotorInstant& now);

  // Returns the torques of the last Step, zeros before.
  std::span<const double> torque() const { return torque_; }
  // Returns the power [W] that the motors took from the bus in the last Step: work and the losses
  // of windings. Negative: braking motors gave back more than the others took.
  double power() const { return power_; }

  // Temperatures, °C. Those of a pair are of B in pitch's place and of A in roll's.
  std::span<const double> winding_c() const { return winding_c_; }
  std::span<const double> casing_c() const { return casing_c_; }
  std::string_view joint(std::size_t motor) const { return motors_[motor]->joint; }

  // Whether a motor is too hot to give torque.
  bool tripped(std::size_t motor) const { return heat_share_[motor] == 0; }
  // Whether it is so hot that it gives less, or none.
  bool derated(std::size_t motor) const { return heat_share_[motor] < 1; }
  // Whether its bus had less than kLeastVoltage of the voltage that it is made for.
  bool undervoltage(std::size_t motor) const;
  // Whether the last Step brought the temperatures up to date.
  bool heated() const { return steps_ == 0; }

  static constexpr double kLeastVoltage = 0.6;  // *assumed*

 private:
  // One motor's two thermal masses: the temperatures after a period are those of the steady state
  // plus decay · (temperatures before - steady state), winding before casing.
  struct HeatPath {
    double winding = 0;  // °C/W from winding to casing
    double casing = 0;   // °C/W from casing to air
    std::array<double, 4> decay{};
  };

  static HeatPath HeatPathOf(const MotorTypeSpec& type, double period);
  void Command(const MotorInstant& now);
  void Limit(const MotorInstant& now, std::span<const double> rate);
  double OfJoint(std::size_t motor, double tau) const;  // within the limit of the joint
  void KeepWithin(double most, std::span<const double> rate);
  void CountLosses(std::span<const double> friction_w);
  void Heat(std::span<const MotorEffects> faults);
  void Judge(std::size_t motor, double rest_c, double fault_c);

  const ThermalSpec& thermal_;
  std::vector<const MotorSpec*> motors_;
  std::vector<ParallelJoint> parallel_;
  int heat_steps_;  // per period
  int steps_ = 0;   // since the temperatures were brought up to date
  double power_ = 0;
  MotorSupply supply_;

  // In motor order. A pair's motors B and A take the places of pitch and roll, but for torque_.
  std::vector<double> kd_share_;
  std::vector<TorqueCurve> curves_;
  std::vector<double> least_v_;    // V, of the bus, below which it is reported
  std::vector<double> per_volt_;   // 1/V: share of the rated voltage per volt; 0: any will do
  std::vector<double> own_share_;  // of the joint's torque that loads the motor: 1 / gear
  std::vector<double> cold_loss_;  // W/(N·m)² at 25 °C, of the motor's own torque
  std::vector<HeatPath> paths_;
  std::vector<double> torque_;                // N·m, of the joints
  std::vector<double> current_;               // N·m that its current is for, as by torque_limit
  std::vector<double> loss_;                  // W/(N·m)² now
  std::vector<double> rate_;                  // rad/s
  std::vector<double> winding_w_, casing_w_;  // W, summed over the steps of a period
  std::vector<double> winding_rise_, casing_rise_;  // °C over rest, by what the motor did
  std::vector<double> winding_c_, casing_c_;        // with what faults add
  std::vector<double> heat_share_;                  // of the torque limit; 0: tripped
};

}  // namespace understudy::robot
