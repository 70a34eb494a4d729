#include "authority/motor_owner.h"

#include <algorithm>
#include <utility>

namespace understudy::authority {

MotorOwner::MotorOwner(std::vector<OnboardService> services, std::string form,
                       const MotionMaker& make)
    : services_(std::move(services)), form_(std::move(form)), motions_(services_.size()) {
  for (std::size_t i = 0; i < services_.size(); ++i) {
    const OnboardService& service = services_[i];
    if (service.alias.empty()) continue;
    if (make) motions_[i] = make(service.alias);
    if (service.on) active_ = i;
  }
  NoteState();
}

std::string_view MotorOwner::active() const {
  return active_ == kNone ? std::string_view() : services_[active_].alias;
}

OwnerVerdict MotorOwner::Select(std::string_view alias) {
  const auto wanted = std::find_if(services_.begin(), services_.end(), [&](const auto& s) {
    return !alias.empty() && s.alias == alias;
  });
  if (wanted == services_.end()) return OwnerVerdict::kUnknownName;
  const auto index = static_cast<std::size_t>(wanted - services_.begin());
  if (!motions_[index]) return OwnerVerdict::kNoController;
  if (wanted->on) return OwnerVerdict::kDone;
  Release();
  wanted->on = true;
  active_ = index;
  fresh_ = true;
  NoteState();
  return OwnerVerdict::kDone;
}

void MotorOwner::Release() {
  onboard_.EndMotionService();
  if (active_ != kNone) services_[active_].on = false;
  active_ = kNone;
  NoteState();
}

OwnerVerdict MotorOwner::Switch(std::string_view service, bool on) {
  const auto found = std::find_if(services_.begin(), services_.end(),
                                  [&](const auto& s) { return s.name == service; });
  if (found == services_.end()) return OwnerVerdict::kUnknownName;
  if (found->is_protected) return OwnerVerdict::kProtected;
  if (found->alias.empty()) {
    found->on = on;
  } else if (on) {
    return Select(found->alias);
  } else if (found->on) {
    Release();
  }
  return OwnerVerdict::kDone;
}

bool MotorOwner::Runs(std::string_view program) const {
  const auto found = std::ranges::find(services_, program, &OnboardService::name);
  return found == services_.end() || found->on;
}

void MotorOwner::Restart() {
  onboard_.EndMotionService();
  fresh_ = true;
}

MotionVerdict MotorOwner::Ask(const MotionGoal& goal) {
  const MotionVerdict verdict = motion() == nullptr ? MotionVerdict::kNotNow : motion()->Ask(goal);
  worst_ = std::max(worst_, verdict);
  NoteState();
  return verdict;
}

void MotorOwner::NoteState() {
  state_ = motion() == nullptr ? robot::MotionState{} : motion()->state();
}

bool MotorOwner::Step(const MotionInput& input, double dt, robot::RobotCommand* command) {
  if (motion() == nullptr) return false;
  if (std::exchange(fresh_, false)) motion()->Start(input);
  motion()->Step(input, dt, command);
  NoteState();
  return true;
}

}  // namespace understudy::authority
