// Takes the commands that have arrived, and reads the remote controller.
#include <algorithm>

#include "authority/onboard.h"
#include "emulator/computer.h"

namespace understudy::emulator {

void Computer::TakeCommands(double t) {
  StepPower(t);
  wire::LinkFaults faults;
  if (FollowHandPrograms()) {
    const std::span<const robot::LinkEffects> links = link_effects_;
    faults = {links.first(topics_.size()), links.subspan(topics_.size())};
  }
  ports_.topics->BeginTick(t, faults);
  if (!power_.computes()) return ports_.topics->Clear();
  router_.RunHands(hand_effects_, t);
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

bool Computer::FollowHandPrograms() {
  const robot::Effects& faulty = faults_.effects();
  std::ranges::copy(faulty.links, link_effects_.begin());
  std::ranges::copy(faulty.hands, hand_effects_.begin());
  bool any = faults_.any();
  for (std::size_t i = 0; i < hand_effects_.size(); ++i) {
    const std::string_view program = authority::HandProgram(spec_.hands[i]);
    if (program.empty() || router_.owner().Runs(program)) continue;
    any = hand_effects_[i].dead = true;
    for (const std::size_t link : hand_links_[i]) link_effects_[link].drops = true;
  }
  return any;
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
