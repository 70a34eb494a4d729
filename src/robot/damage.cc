#include "robot/damage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace understudy::robot {
namespace {

// All *assumed*, but for kFallen, which is the tilt at which the vendor's safety example for the G1
// gives up (unitree_sdk2 example/g1/low_level/terminations).
constexpr double kNearLimit = 0.98;     // of the torque limit
constexpr double kFallen = 1.0;         // rad
constexpr double kUpAgain = 0.5;        // rad
constexpr double kAtEnd = 1e-3;         // rad from the end of a range
constexpr double kHardStop = 1;         // rad/s; a joint that is led to its end is slower
constexpr double kHalfLattice = 32768;  // steps from 0 to the end of a sensor's 16 bits

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// J in a full pack.
double FullPack(const BatterySpec& battery) {
  const auto& volts = battery.cell_v;
  const double mean =
      std::accumulate(volts.begin(), volts.end(), 0.0) / static_cast<double>(volts.size());
  return battery.capacity_ah * 3600 * battery.cells * mean;
}

}  // namespace

std::vector<MotorLimits> MotorLimitsOf(const RobotSpec& spec) {
  std::vector<MotorLimits> limits;
  for (const MotorSpec* motor : AllMotors(spec)) {
    limits.push_back({.torque = motor->torque_limit,
                      .speed = motor->no_load_speed,
                      .jump = motor->hold_kp > 0 ? motor->torque_limit / motor->hold_kp : 0});
  }
  return limits;
}

std::vector<DamageLimit> DamageLimitsOf(const RobotSpec& spec) {
  std::vector<DamageLimit> all = {
      {"energy", FullPack(spec.battery), "J",
       "derived: all of a full pack, by robot.battery.capacity_ah, cells and cell_v"},
      {"peak_current", spec.battery.cutoff_a, "A",
       "assumed: robot.battery.cutoff_a, at which the pack cuts off"},
      {"shock", kHalfLattice * spec.imu.accel_step, "m/s²",
       "derived: the end of its accelerometer, by robot.imu.accel_step; what the frame bears is "
       "not published"},
      {"worst_tilt", kFallen, "rad",
       "vendor: its safety example for the G1, unitree_sdk2 example/g1/low_level/terminations"},
      {"falls", 0, "", "assumed: no robot is made to fall; counted beyond the limit of worst_tilt"},
      {"at_torque_limit", kNone, "N·m",
       "vendor: robot.motors[].torque_limit, the effort of the URDF; counted from 98 % of it on, "
       "assumed"},
      {"at_speed_limit", kNone, "rad/s",
       "vendor: robot.motors[].no_load_speed, the velocity of the URDF; of a G1 a curve in public "
       "training code"},
      {"tripped", spec.thermal.trip_c, "°C",
       "assumed: robot.thermal.trip_c, which a client of the vendor's has for its limit"},
      {"hottest", spec.thermal.derate_c, "°C",
       "assumed: robot.thermal.derate_c, from which on a motor gives less"},
      {"hardest_stop", kHardStop, "rad/s", "assumed: none is published"},
      {"largest_jump", kNone, "rad",
       "derived: robot.motors[].torque_limit / hold_kp, which takes all of the torque at once"},
  };
  for (DamageLimit& one : all) {
    if (one.limit <= 0 && one.figure != "falls") one.limit = kNone;
  }
  return all;
}

DamageSheet::DamageSheet(const RobotSpec& spec, std::vector<std::array<double, 2>> ranges)
    : thermal_(spec.thermal),
      limits_(MotorLimitsOf(spec)),
      ranges_(std::move(ranges)),
      before_(ranges_.size()) {
  damage_.motors.resize(limits_.size());
}

void DamageSheet::Restart() {
  restarted_ = true;
  down_ = false;
}

void DamageSheet::Step(const Wear& wear, double dt) {
  for (std::size_t i = 0; i < limits_.size(); ++i) StepMotor(i, wear, dt);
  restarted_ = false;
  damage_.time += dt;
  damage_.energy += std::max(0.0, -wear.battery.current * wear.battery.voltage) * dt;
  damage_.peak_current = std::max(damage_.peak_current, -wear.battery.current);
  damage_.shock = std::max(damage_.shock, wear.f_WI_I.norm());
  damage_.worst_tilt = std::max(damage_.worst_tilt, wear.tilt);
  if (!down_ && wear.tilt > kFallen) ++damage_.falls;
  down_ = wear.tilt > (down_ ? kUpAgain : kFallen);
}

void DamageSheet::StepMotor(std::size_t i, const Wear& wear, double dt) {
  const MotorLimits& limits = limits_[i];
  MotorDamage& damage = damage_.motors[i];
  Before& before = before_[i];
  if (std::abs(wear.torque[i]) >= kNearLimit * limits.torque) damage.at_torque_limit += dt;
  if (limits.speed > 0 && std::abs(wear.dq[i]) >= limits.speed) {
    damage.at_speed_limit += dt;
  }
  if (wear.winding_c[i] >= thermal_.trip_c) damage.tripped += dt;
  damage.hottest_c = std::max(damage.hottest_c, wear.winding_c[i]);

  const bool ended = wear.q[i] < ranges_[i][0] + kAtEnd || wear.q[i] > ranges_[i][1] - kAtEnd;
  if (ended && !before.ended && !restarted_) {
    damage.hardest_stop = std::max(damage.hardest_stop, std::abs(wear.dq[i]));
  }
  before.ended = ended;

  const MotorCommand& command = wear.command.motors[i];
  const bool commanded = command.enabled && command.kp > 0 && command.q != kNoPosition;
  if (commanded && !restarted_) {
    const double from = before.commanded ? before.q : wear.q[i];
    damage.largest_jump = std::max(damage.largest_jump, std::abs(command.q - from));
  }
  before.commanded = commanded;
  before.q = command.q;
}

}  // namespace understudy::robot
