// The faults of a robot and its power switch.
#include <utility>

#include "emulator/robot.h"

namespace understudy::emulator {

Result<> Robot::SetFault(std::string_view component, std::string_view kind, const double* by,
                         const robot::FaultTimes& times, double t) {
  if (kind != robot::kNoFault) {
    const auto begun = faults_.Begin(component, kind, by, times, t);
    if (!begun) return begun.error();
    events_.AddFault(faults_, *begun, true);
    return {};
  }
  const auto cleared = faults_.Clear(component);
  if (!cleared) return cleared.error();
  for (const robot::Fault& fault : faults_.over()) events_.AddFault(faults_, fault, false);
  ApplyFaults(t);
  return {};
}

void Robot::StepFaults(double t) {
  if (!faults_.Step(t)) return;
  for (const robot::Fault& fault : faults_.begun()) events_.AddFault(faults_, fault, true);
  for (const robot::Fault& fault : faults_.over()) events_.AddFault(faults_, fault, false);
  ApplyFaults(t);
}

// Applies the effects of faults that the parts do not read by themselves. A mainboard that dies
// takes the robot down with it.
void Robot::ApplyFaults(double t) {
  computer_.ApplyFaults();
  const bool dead = faults_.effects().board.dead;
  if (std::exchange(board_is_dead_, dead) == dead) return;
  if (dead) {
    boots_again_ = computer_.power() != robot::PowerState::kOff;
    SwitchOff();
  } else if (boots_again_) {
    SwitchOn(t);
  }
}

Result<> Robot::SwitchPower(bool on, double t) {
  if (!on) {
    SwitchOff();
    return {};
  }
  if (computer_.power() != robot::PowerState::kOff) return {};
  if (board_is_dead_) return Error{"its mainboard is off"};
  if (!SwitchOn(t)) return Error{"the battery is empty"};
  return {};
}

bool Robot::SwitchOn(double t) {
  if (!hardware_.SwitchOn()) return false;
  computer_.SwitchOn(t);
  return true;
}

void Robot::SwitchOff() {
  if (computer_.power() == robot::PowerState::kOff) return;
  hardware_.SwitchOff();
  computer_.SwitchOff();
}

}  // namespace understudy::emulator
