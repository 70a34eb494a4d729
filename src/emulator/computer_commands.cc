// Takes the commands that have arrived, and reads the remote controller.
#include <algorithm>

#include "emulator/computer.h"

namespace understudy::emulator {

void Computer::TakeCommands(double t) {
  StepPower(t);
  const std::span<const robot::LinkEffects> links = faults_.effects().links;
  wire::LinkFaults faults;
  if (faults_.any()) {
    faults = {links.first(topics_.size()), links.subspan(topics_.size())};
  }
  ports_.topics->BeginTick(t, faults);
  if (!power_.computes()) return ports_.topics->Clear();
  router_.RunHands(faults_.effects().hands, t);
  router_.Obey(ReadRemote(t), t);
  if (const auto& unheeded = router_.unheeded()) {
    events_->AddUnheeded(*unheeded, router_.owner().state(), first_service_);
  }
  // One of each topic in turn, so that none keeps the others waiting.
  int left = authority::Intake::kMostInATick;
  for (int i = 0; i < authority::Intake::kMostAtOnce; ++i) {
    const int before = left;
    for (std::size_t topic = 0; topic < topics_.size() && left > 0; ++topic) {
      if (TakeCommand(topic, t)) --left;
    }
    if (left == before) break;
  }
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) CountLost(topic);
}

// Returns false if none has arrived.
bool Computer::TakeCommand(std::size_t topic, double t) {
  robot::Refusal form = robot::Refusal::kNone;
  if (!ports_.topics->Take(topic, &arrived_, &form)) return false;
  const robot::Refusal refusal = router_.Offer(topic, arrived_, form, t);
  events_->AddCommand(topic, form, refusal, router_.counts(topic));
  if (refusal == robot::Refusal::kNone) events_->AddTaken(topic, arrived_, state_);
  NoteChanges(t);
  return true;
}

void Computer::CountLost(std::size_t topic) {
  const std::uint64_t lost = ports_.topics->TakeLost(topic);
  if (lost == 0) return;
  router_.Count(topic, robot::Refusal::kLost, lost);
  events_->Add(EventKind::kLostCommands, {static_cast<double>(lost)}, topics_[topic]);
}

robot::RemoteReading Computer::ReadRemote(double t) {
  const bool deaf = faults_.effects().remote_off || !power_.computes();
  return deaf ? robot::RemoteReading{} : remote_.Read(t);
}

bool Computer::is_commanded() const {
  return router_.gate().state() == authority::GateState::kFollowing ||
         router_.owner().user_control();
}

void Computer::NoteUnmatched(std::string_view topic, std::string_view writer) {
  const auto found = std::ranges::find(topics_, topic);
  if (found != topics_.end()) {
    router_.Count(static_cast<std::size_t>(found - topics_.begin()), robot::Refusal::kUnmatched, 1);
  } else if (ports_.services != nullptr) {
    ports_.services->CountUnmatched();
  }
  events_->Add(EventKind::kUnmatched, {}, writer);
}

}  // namespace understudy::emulator
