#include "authority/motor_owner.h"

#include <algorithm>
#include <utility>

namespace understudy::authority {

MotorOwner::MotorOwner(std::vector<OnboardService> services, std::string form,
                       std::unique_ptr<Motion> motion)
    : services_(std::move(services)), form_(std::move(form)), motion_(std::move(motion)) {
  NoteState();
}

std::string_view MotorOwner::active() const {
  const auto found = std::find_if(services_.begin(), services_.end(),
                                  [](const auto& s) { return s.on && !s.alias.empty(); });
  return found == services_.end() ? std::string_view() : found->alias;
}

OwnerVerdict MotorOwner::Select(std::string_view alias) {
  const auto wanted = std::find_if(services_.begin(), services_.end(), [&](const auto& s) {
    return !alias.empty() && s.alias == alias;
  });
  if (wanted == services_.end()) return OwnerVerdict::kUnknownName;
  if (!motion_) return OwnerVerdict::kNoController;
  if (wanted->on) return OwnerVerdict::kDone;
  Release();
  wanted->on = true;
  fresh_ = true;
  NoteState();
  return OwnerVerdict::kDone;
}

void MotorOwner::Release() {
  user_control_ = false;
  sticks_ = true;
  for (OnboardService& service : services_) {
    if (!service.alias.empty()) service.on = false;
  }
  NoteState();
}

OwnerVerdict MotorOwner::Switch(std::string_view service, bool on) {
  const auto found = std::find_if(services_.begin(), services_.end(),
                                  [&](const auto& s) { return s.name == service; });
  if (found == services_.end()) return OwnerVerdict::kUnknownName;
  if (found->is_protected) return OwnerVerdict::kProtected;
  if (on && !found->alias.empty()) return Select(found->alias);
  found->on = on;
  NoteState();
  return OwnerVerdict::kDone;
}

void MotorOwner::Restart() {
  user_control_ = false;
  sticks_ = true;
  fresh_ = true;
}

MotionVerdict MotorOwner::Ask(const MotionGoal& goal) {
  const MotionVerdict verdict = active().empty() ? MotionVerdict::kNotNow : motion_->Ask(goal);
  worst_ = std::max(worst_, verdict);
  NoteState();
  return verdict;
}

void MotorOwner::NoteState() {
  state_ = active().empty() ? robot::MotionState{} : motion_->state();
}

bool MotorOwner::Step(const MotionInput& input, double dt, robot::RobotCommand* command) {
  if (active().empty()) return false;
  if (std::exchange(fresh_, false)) motion_->Start(input);
  motion_->Step(input, dt, command);
  NoteState();
  return true;
}

}  // namespace understudy::authority
