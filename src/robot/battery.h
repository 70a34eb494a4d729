// Models the battery pack with its protection.
#pragma once

#include <array>
#include <cstdint>

#include "robot/fault.h"
#include "robot/motor.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::robot {

// Why a pack has cut off its bus.
enum class CutOff : std::uint8_t { kNone, kOvercurrent, kUndervoltage, kEmpty };

// Cells in series behind one resistance. Its current is idle_a and what the motors take:
//
//   V = V0(charge) - internal_ohm · I        I = idle_a + P / V
//
// P may be negative: it charges the pack, up to the voltage of full cells; what is more is burnt
// (*assumed*). It gives no more than most_a and no more power than at half of its voltage, which
// limits the motors (supply). Means over cutoff_time of too much current, or of too little voltage
// at the weakest cell, cut it off, as a charge of 0 does at once; then there is no torque until
// Restart, and all that lives on it is dark.
class Battery {
 public:
  // `ambient_c` is the temperature of the air, °C. By the seed cells differ from each other.
  explicit Battery(const BatterySpec& spec, double ambient_c = 25, int seed = 1);

  // Updates voltage and current for the power that the motors take [W], and integrates charge and
  // temperature over dt [s].
  void Step(double power, double dt, const BatteryEffects& fault = {});

  // The robot's switch takes the load off until the next Step.
  void SwitchOff();
  // Switches a pack on that has cut off, as its button does, unless it is empty.
  void Restart();

  const BatteryReading& reading() const { return reading_; }
  // What it has for the motors now. The voltage lags by kLag, as that of the drives' capacitors.
  MotorSupply supply() const;
  CutOff cut_off() const { return cut_off_; }
  // Whether the charge is below low_soc.
  bool low() const { return reading_.soc < spec_.low_soc; }

  static constexpr double kLag = 0.02;  // s, *assumed*

 private:
  double OpenVoltage() const;
  void Load(double power);  // W, of the motors
  void Protect(double dt);

  BatterySpec spec_;
  double ambient_c_;
  double weakest_v_ = 0;  // V, by how much the weakest cell is over the mean, never above 0
  double resistance_;     // ohm
  double bus_v_ = 0;      // V, with its lag
  double mean_a_ = 0;     // A given, over cutoff_time
  double mean_cell_v_ = 0;
  CutOff cut_off_ = CutOff::kNone;
  BatteryReading reading_;
};

}  // namespace understudy::robot
