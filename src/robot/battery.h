// The pack that feeds the motors.
#pragma once

#include <span>

#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::robot {

// Power drawn = idle + mechanical work of the motors, no less than zero + heat as the square of
// torque:
//
//   P = V · idle_a + max(0, sum tau dq) + watt_per_nm2 · sum tau²
//
// The open-circuit voltage falls linearly with the charge from cell_full_v to cell_empty_v;
// internal_ohm takes its share of the load. A pack gives no more than what halves its voltage; the
// motors get what they ask for all the same. Figures are fitted to captures of real packs where
// such exist (docs/fidelity.md); that the voltage is linear in the charge, and the most that a pack
// gives, are *assumed*. Nothing happens at an empty pack, *assumed*: charge stays 0 and the robot
// goes on.
class Battery {
 public:
  explicit Battery(const BatterySpec& spec);

  // Voltage and current under joint torques tau [N·m] and rates dq [rad/s] in motor order, and the
  // charge one step of dt [s] on.
  void Step(std::span<const double> tau, std::span<const double> dq, double dt);

  const BatteryReading& reading() const { return reading_; }

 private:
  void Load(double power);  // W, of the motors

  BatterySpec spec_;
  BatteryReading reading_;
};

}  // namespace understudy::robot
