#include "wire/port.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "wire/states.h"

namespace understudy::wire {

Port::Port(const bus::Participant& participant, const robot::RobotSpec& spec, double timestep)
    : participant_(participant), spec_(spec), lowstate_(spec.rates.lowstate_hz, timestep) {
  spec.family == robot::WireFamily::kGo ? HearGo() : HearHg();
  for (const StateRow& row : StateRows(spec)) {
    publications_.push_back(row.open(participant, timestep));
  }
}

bool Port::Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) {
  return sources_[topic] != nullptr && sources_[topic]->Take(command, form);
}

std::uint64_t Port::TakeLost(std::size_t topic) {
  return sources_[topic] == nullptr ? 0 : sources_[topic]->TakeLost();
}

void Port::Rest() {
  for (const auto& source : sources_) {
    if (source != nullptr) source->Rest();
  }
}

std::vector<const bus::ReaderCore*> Port::readers() const {
  std::vector<const bus::ReaderCore*> readers;
  for (const auto& source : sources_) {
    if (source != nullptr) readers.push_back(&source->reader());
  }
  return readers;
}

bool Port::Due(std::int64_t step) const {
  return std::ranges::any_of(publications_, [step](const auto& p) { return p->Due(step); });
}

void Port::Publish(const robot::RobotState& state, std::int64_t step,
                   std::span<const robot::LinkEffects> links) {
  std::uint64_t failures = 0;
  for (const auto& publication : publications_) {
    const std::size_t count = links.empty() ? 0 : publication->topics().size();
    failures += publication->Publish(state, step, links.first(count));
    links = links.subspan(count);
  }
  counts_.write_failures += failures;
  news_.write_failures += failures;
  if (lowstate_.Due(step)) ++counts_.lowstates;
}

std::vector<std::string> Port::topics() const {
  std::vector<std::string> topics;
  for (const auto& publication : publications_) {
    std::ranges::copy(publication->topics(), std::back_inserter(topics));
  }
  return topics;
}

int Port::command_writers() const { return sources_[robot::kLowCmdTopic]->writers(); }

robot::PortNews Port::TakeNews() {
  const int writers = command_writers();
  if (std::exchange(writers_, writers) != writers && writers > 1) news_.writers = writers;
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
