// What a robot makes of the commands that come.
#include <algorithm>

#include "emulator/robot.h"

namespace understudy::emulator {

void Robot::TakeCommands(double t) {
  if (!power_.computes()) return Ignore();
  router_.Obey(ReadRemote(t), t);
  if (const auto& unheeded = router_.unheeded()) {
    events_.AddUnheeded(*unheeded, router_.owner().state(), first_service_);
  }
  // One of each topic in turn, so that none keeps the others waiting.
  int left = authority::Intake::kMostInATick;
  if (any_late_) left -= TakeLate(left, t);
  for (int i = 0; i < authority::Intake::kMostAtOnce; ++i) {
    const int before = left;
    for (std::size_t topic = 0; topic < topics_.size() && left > 0; ++topic) {
      if (TakeCommand(topic, t)) --left;
    }
    if (left == before) break;
  }
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    const std::uint64_t lost = port_->TakeLost(topic);
    if (lost == 0) continue;
    router_.Count(topic, robot::Refusal::kLost, lost);
    events_.Add(EventKind::kLostCommands, {static_cast<double>(lost)}, topics_[topic]);
  }
}

// Takes commands as a robot that is off does, by which they come to nothing.
void Robot::Ignore() {
  robot::Refusal form = robot::Refusal::kNone;
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    for (int i = 0; i < authority::Intake::kMostAtOnce; ++i) {
      if (!port_->Take(topic, &offered_, &form)) break;
    }
    port_->TakeLost(topic);
  }
}

// Returns false if none waits.
bool Robot::TakeCommand(std::size_t topic, double t) {
  robot::Refusal form = robot::Refusal::kNone;
  if (!port_->Take(topic, &offered_, &form)) return false;
  CommandLink& link = links_[topic];
  const robot::LinkEffects& effects = faults_.effects().links[topic];
  if (!link.Send(offered_, form, effects, t, Arrival{this, topic, t})) {
    router_.Count(topic, robot::Refusal::kLost, 1);
  }
  any_late_ = any_late_ || link.any_late();
  return true;
}

// Takes at most `most` commands that were late and have come; returns how many.
int Robot::TakeLate(int most, double t) {
  int taken = 0;
  any_late_ = false;
  for (std::size_t topic = 0; topic < links_.size(); ++topic) {
    CommandLink& link = links_[topic];
    const robot::LinkEffects& effects = faults_.effects().links[topic];
    while (taken < most && link.TakeLate(effects, t, Arrival{this, topic, t})) ++taken;
    any_late_ = any_late_ || link.any_late();
  }
  return taken;
}

void Robot::Arrival::Offer(const robot::RobotCommand& command, robot::Refusal form) const {
  const robot::Refusal refusal = to->router_.Offer(topic, command, form, t);
  to->events_.AddCommand(topic, form, refusal, to->router_.counts(topic));
  if (topic == robot::kLowCmdTopic && refusal == robot::Refusal::kNone) {
    to->events_.AddTaken(command, to->state_);
  }
}

void Robot::NoteUnmatched(std::string_view topic, std::string_view writer) {
  const auto found = std::ranges::find(topics_, topic);
  if (found != topics_.end()) {
    router_.Count(static_cast<std::size_t>(found - topics_.begin()), robot::Refusal::kUnmatched, 1);
  } else if (services_ != nullptr) {
    services_->CountUnmatched();
  }
  events_.Add(EventKind::kUnmatched, {}, writer);
}

}  // namespace understudy::emulator
