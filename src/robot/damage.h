// What a run would have done to the robot: how near to its limits it came, how often and how hard.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::robot {

// Of a motor and its joint. What the figures are held against: MotorLimits, DamageLimit.
struct MotorDamage {
  double at_torque_limit = 0;  // s with 98 % of torque_limit or more
  double at_speed_limit = 0;   // s at no_load_speed or faster
  double tripped = 0;          // s without torque, since the winding was at trip_c
  double hottest_c = 0;        // of the winding, °C
  double hardest_stop = 0;     // rad/s at which the joint has come to the end of its range
  double largest_jump = 0;     // rad from a commanded angle to the next, from the joint's at first
};

// Of a whole robot since its start. What belongs to motors is in motor order.
struct DamageTotals {
  std::vector<MotorDamage> motors{};
  double time = 0;          // s
  double energy = 0;        // J given by the pack
  double peak_current = 0;  // A given by the pack
  double shock = 0;         // m/s², largest specific force at LowState's inertial unit
  double worst_tilt = 0;    // rad between the base's up and the world's
  int falls = 0;            // how often it has tilted by more than 1 rad
};

// What the figures of a motor are held against.
struct MotorLimits {
  double torque = 0;  // N·m
  double speed = 0;   // rad/s; 0 = not known
  double jump = 0;    // rad; 0 = not known
};
// Returns those of all motors, in motor order.
std::vector<MotorLimits> MotorLimitsOf(const RobotSpec& spec);

// What a figure of the sheet is held against, and where that comes from.
struct DamageLimit {
  std::string figure{};  // as JSON and recordings call it
  double limit = 0;      // NaN: each motor's own, or none is known
  std::string unit{};
  std::string source{};  // its grade, then the key that has it or who says so
};
// Returns those of all figures, in the order of JSON.
std::vector<DamageLimit> DamageLimitsOf(const RobotSpec& spec);

// One instant of a robot, in motor order.
struct Wear {
  const RobotCommand& command;                       // that the motors followed
  std::span<const double> q, dq, torque, winding_c;  // rad, rad/s, N·m, °C
  const BatteryReading& battery;
  Eigen::Vector3d f_WI_I;  // m/s²
  double tilt;             // rad
};

// Writes the sheet of damage. Allocates only in the constructor.
class DamageSheet {
 public:
  // `ranges` are those of the joints, infinite where there is none. `spec` must outlive it.
  DamageSheet(const RobotSpec& spec, std::vector<std::array<double, 2>> ranges);

  // Adds the dt [s] after that instant. Not enabled motors and gains kp of 0 have no command.
  void Step(const Wear& wear, double dt);
  // The robot has been put somewhere else: the next command does not jump from the last.
  void Restart();

  const DamageTotals& damage() const { return damage_; }

 private:
  // Of a motor, in the step before.
  struct Before {
    bool commanded = false;
    double q = 0;        // rad, as commanded
    bool ended = false;  // the joint was at the end of its range
  };

  void StepMotor(std::size_t i, const Wear& wear, double dt);

  const ThermalSpec& thermal_;
  std::vector<MotorLimits> limits_;
  std::vector<std::array<double, 2>> ranges_;
  std::vector<Before> before_;
  bool down_ = false;
  bool restarted_ = true;
  DamageTotals damage_;
};

}  // namespace understudy::robot
