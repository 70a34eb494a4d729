// What befalls a robot: its faults and its power switch.
#include <algorithm>

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
  Suffer();
  FollowBoard(t);
  return {};
}

void Robot::StepFaults(double t) {
  if (!faults_.Step(t)) return;
  for (const robot::Fault& fault : faults_.begun()) events_.AddFault(faults_, fault, true);
  for (const robot::Fault& fault : faults_.over()) events_.AddFault(faults_, fault, false);
  Suffer();
  FollowBoard(t);
}

// A mainboard that dies takes the robot down with it.
void Robot::FollowBoard(double t) {
  if (faults_.effects().board.dead == board_is_dead_) return;
  board_is_dead_ = !board_is_dead_;
  if (board_is_dead_) {
    boots_again_ = power_.state() != PowerState::kOff;
    SwitchPowerOff();
  } else if (boots_again_) {
    power_.SwitchOn(t);
  }
}

// Services come up in their order, one after the other.
void Robot::StepPower(double t) {
  const bool booting = power_.state() == PowerState::kBooting;
  if (power_.Step(t) && !router_.owner().silent()) router_.owner().Select(first_service_);
  if (!booting) return;
  Suffer();
  NoteChanges(t);
}

Result<> Robot::SwitchPower(bool on, double t) {
  if (!on) {
    SwitchPowerOff();
    return {};
  }
  if (power_.state() != PowerState::kOff) return {};
  if (board_is_dead_) return Error{"its mainboard is off"};
  battery_.Restart();
  if (battery_.cut_off() != robot::CutOff::kNone) return Error{"the battery is empty"};
  power_.SwitchOn(t);
  return {};
}

void Robot::SwitchPowerOff() {
  if (power_.state() == PowerState::kOff) return;
  power_.SwitchOff();
  battery_.SwitchOff();
  before_off_ = router_.owner().active();
  router_.GoLimp();
  Suffer();
}

// Tells those parts of what is wrong with them that do not read it themselves.
void Robot::Suffer() {
  std::ranges::copy(faults_.effects().services, service_effects_.begin());
  for (std::size_t i = 0; i < service_effects_.size(); ++i) {
    service_effects_[i].off |= !power_.answers(i, service_effects_.size());
  }
  if (services_ != nullptr) services_->Suffer(service_effects_);
  for (std::size_t i = 0; i < braked_.size(); ++i) {
    const robot::MotorEffects& now = faults_.effects().motors[i];
    if (now.jammed == braked_[i].jammed && now.drag == braked_[i].drag) continue;
    braked_[i] = now;
    body_->Brake(i, now.drag, now.jammed);
  }
}

}  // namespace understudy::emulator
