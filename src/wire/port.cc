#include "wire/port.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "robot/hand_law.h"
#include "wire/motion_codec.h"
#include "wire/remote_codec.h"

namespace understudy::wire {
namespace {

bool HasTouch(const robot::RobotSpec& spec, const StateMessage& message) {
  return message.content == Content::kTouch ||
         (message.content == Content::kHand && !spec.hands[message.hand].pads.empty() &&
          robot::LawOf(spec.hands[message.hand]).messages == robot::HandLaw::Messages::kHand);
}

}  // namespace

Port::Port(const bus::Participant& participant, const robot::RobotSpec& spec, double timestep)
    : participant_(participant),
      spec_(spec),
      lowstate_(spec.rates.lowstate_hz, timestep),
      outlets_(participant, timestep) {
  for (std::size_t number = 0; number < robot::kMostCommandTopics; ++number) {
    sources_.push_back(
        {nullptr, Inlet(number < robot::kHandSdkTopic)});  // those of hands have no crc
  }
  const bool go = spec.family == robot::WireFamily::kGo;
  go ? HearGo() : HearHg();
  for (const StateMessage& message : StateMessages(spec)) {
    publications_.push_back(go ? OpenGo(message) : OpenHg(message));
    if (HasTouch(spec, message)) with_touch_.push_back(publications_.back().get());
  }
  lidar_.emplace(spec, &outlets_);
  states_ = outlets_.size();
}

std::unique_ptr<Publication> Port::OpenShared(const StateMessage& message) {
  switch (message.content) {
    case Content::kMotion:
      return Open<unitree_go_msg_dds__SportModeState_>(
          message, [this, fields = MotionFieldsOf(spec_)](
                       const robot::RobotState& state, unitree_go_msg_dds__SportModeState_* sent) {
            EncodeMotion(state, spec_, fields, sent);
            return true;
          });
    case Content::kRemote:
      return Open<unitree_go_msg_dds__WirelessController_>(
          message,
          [](const robot::RobotState& state, unitree_go_msg_dds__WirelessController_* sent) {
            if (state.remote.there) EncodeRemote(state.remote, sent);
            return state.remote.there;
          });
    default:
      throw std::logic_error(message.topics.front().name + ": no port makes this message");
  }
}

void Port::BeginTick(double t, const LinkFaults& faults) {
  now_ = t;
  faults_ = faults.commands;
  outlets_.BeginTick(t, faults.publications);
}

bool Port::Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) {
  Source& source = sources_[topic];
  if (source.commands == nullptr) return false;
  const auto take = [&source](robot::RobotCommand* sent, robot::Refusal* its_form) {
    return source.commands->Take(sent, its_form);
  };
  return source.inlet.Take(faults_.empty() ? robot::LinkEffects{} : faults_[topic], now_, take,
                           command, form);
}

std::uint64_t Port::TakeLost(std::size_t topic) {
  Source& source = sources_[topic];
  return source.commands == nullptr ? 0 : source.commands->TakeLost() + source.inlet.TakeLost();
}

void Port::KeepNewest() {
  for (const Source& source : sources_) {
    if (source.commands != nullptr) source.commands->KeepNewest();
  }
}

void Port::Clear() {
  for (Source& source : sources_) {
    if (source.commands != nullptr) source.commands->Clear();
    source.inlet.Clear();
  }
  outlets_.Clear();
}

std::vector<const bus::ReaderCore*> Port::readers() const {
  std::vector<const bus::ReaderCore*> readers;
  for (const Source& source : sources_) {
    if (source.commands != nullptr) readers.push_back(&source.commands->reader());
  }
  return readers;
}

bool Port::Due(std::int64_t step) const {
  return std::ranges::any_of(publications_, [step](const auto& p) { return p->Due(step); });
}

bool Port::ReadsTouch(std::int64_t step) const {
  return std::ranges::any_of(with_touch_, [step](const auto* p) { return p->Wanted(step); });
}

void Port::Publish(const robot::RobotState& state, std::int64_t step) {
  for (const auto& publication : publications_) publication->Publish(state, step);
  if (lowstate_.Due(step)) ++counts_.lowstates;
}

std::vector<std::string> Port::topics() const {
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < states_; ++i) topics.push_back(outlets_[i].topic().name);
  return topics;
}

robot::PortCounts Port::counts() const {
  robot::PortCounts counts = counts_;
  counts.write_failures = outlets_.failures();
  return counts;
}

int Port::command_writers() const { return sources_[robot::kLowCmdTopic].commands->writers(); }

robot::PortNews Port::TakeNews() {
  const int writers = command_writers();
  if (std::exchange(writers_, writers) != writers && writers > 1) news_.writers = writers;
  news_.write_failures = outlets_.failures() - std::exchange(told_failures_, outlets_.failures());
  return std::exchange(news_, {});
}

void Port::NoteUnusedSlots(const UnusedSlots& slots) {
  if (slots.differ && !told_of_unused_slots_) news_.unused_slot = told_of_unused_slots_ = true;
  counts_.unused_slots += slots.count;
}

void Port::NoteUnsetHead() {
  if (counts_.unset_heads++ == 0) news_.unset_head = true;
}

}  // namespace understudy::wire
