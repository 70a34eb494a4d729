// Models the battery pack.
#pragma once

#include <span>

#include "robot/fault.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::robot {

// Power drawn = idle + mechanical work of the motors, no less than zero + heat as the square of
// torque:
//
//   P = V · idle_a + max(0, sum tau dq) + watt_per_nm2 · sum tau²
//
// The open-circuit voltage falls linearly with the charge from cell_full_v to cell_empty_v;
// internal_ohm lowers the voltage under load. The power is limited to that at half the voltage;
// this does not limit the motors. Figures are fitted to captures of real packs where they exist
// (docs/fidelity.md). *Assumed* are the linear voltage, the power limit, and that an empty pack has
// no effect: the charge stays 0 and the robot continues.
class Battery {
 public:
  explicit Battery(const BatterySpec& spec);

  // Updates voltage and current for joint torques tau [N·m] and rates dq [rad/s] in motor order,
  // and integrates the charge over dt [s].
  void Step(std::span<const double> tau, std::span<const double> dq, double dt,
            const BatteryEffects& fault = {});

  const BatteryReading& reading() const { return reading_; }

 private:
  void Load(double power, double internal_ohm);  // W, of the motors

  BatterySpec spec_;
  BatteryReading reading_;
};

}  // namespace understudy::robot
