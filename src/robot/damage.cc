#include "robot/damage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace understudy::robot {
namespace {

// All *assumed*, but for kFallen, which is the tilt at which the vendor's safety example for the G1
// gives up (unitree_sdk2 example/g1/low_level/terminations).
constexpr double kNearLimit = 0.98;  // of the torque limit
constexpr double kFallen = 1.0;      // rad
constexpr double kUpAgain = 0.5;     // rad
constexpr double kAtEnd = 1e-3;      // rad from the end of a range

}  // namespace

DamageSheet::DamageSheet(const RobotSpec& spec, std::vector<std::array<double, 2>> ranges)
    : thermal_(spec.thermal), ranges_(std::move(ranges)), before_(ranges_.size()) {
  for (const MotorSpec* motor : AllMotors(spec)) {
    limits_.push_back({motor->torque_limit, motor->no_load_speed});
  }
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
  const Limits& limits = limits_[i];
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
