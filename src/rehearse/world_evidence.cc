#include "rehearse/world_evidence.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "emulator/event_table.h"

namespace understudy::rehearse {
namespace {

bool IsOfWorld(const std::string& kind) {
  const auto row = std::ranges::find(emulator::EventTable(), kind, &emulator::EventRow::name);
  return row != emulator::EventTable().end() && row->of_world;
}

}  // namespace

WorldEvidence::WorldEvidence(std::vector<Signal> signals, std::vector<std::string> robots,
                             Evidence::Give give)
    : signals_(std::move(signals)),
      robots_(std::move(robots)),
      give_(std::move(give)),
      parts_(std::max<std::size_t>(1, robots_.size())),
      waiting_(parts_.size()) {
  for (const Signal& signal : signals_) values_.push_back(Evidence::ValueBefore(signal));
}

void WorldEvidence::Begin(std::size_t robot, std::uint64_t start) {
  const std::lock_guard lock(mutex_);
  parts_[robot] = std::make_unique<Evidence>(
      signals_, start,
      [this, robot](judge::Time at, std::span<const double> values) { Add(robot, at, values); },
      robot);
}

void WorldEvidence::Take(std::size_t robot, const record::McapChannel& channel,
                         std::string_view ros_type, const record::McapMessage& message) {
  const std::lock_guard lock(mutex_);
  parts_[robot]->Take(channel, ros_type, message);
}

void WorldEvidence::Add(std::size_t robot, judge::Time at, std::span<const double> values) {
  if (parts_.size() == 1) return give_(at, values);
  waiting_[robot].push_back({.at = at, .values = {values.begin(), values.end()}});
  while (GiveNext(false)) {
  }
}

// Gives the sample of the next instant if every robot has got there, or else of `all` that wait.
// Returns whether it did.
bool WorldEvidence::GiveNext(bool all) {
  std::optional<judge::Time> next;
  for (const std::deque<Sample>& waiting : waiting_) {
    if (waiting.empty() && !all) return false;
    if (!waiting.empty()) next = std::min(next.value_or(waiting.front().at), waiting.front().at);
  }
  if (!next) return false;
  for (std::size_t robot = 0; robot < waiting_.size(); ++robot) {
    if (waiting_[robot].empty() || waiting_[robot].front().at != *next) continue;
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      if (signals_[i].robot == robot) values_[i] = waiting_[robot].front().values[i];
    }
    waiting_[robot].pop_front();
  }
  give_(*next, values_);
  return true;
}

void WorldEvidence::Finish() {
  for (std::size_t robot = 0; robot < parts_.size(); ++robot) {
    if (parts_[robot] == nullptr) Begin(robot, 0);
    parts_[robot]->Finish();
  }
  while (GiveNext(true)) {
  }
}

std::string WorldEvidence::WhyUnknown(std::size_t signal) const {
  return parts_[signals_[signal].robot]->WhyUnknown(signal);
}

std::vector<Evidence::Told> WorldEvidence::events() const {
  std::vector<Evidence::Told> all;
  for (std::size_t robot = 0; robot < parts_.size(); ++robot) {
    for (Evidence::Told told : parts_[robot]->events()) {
      const bool of_world = IsOfWorld(told.event.kind);
      if (of_world && robot > 0) continue;
      if (!of_world && !robots_.empty()) told.event.text = robots_[robot] + ": " + told.event.text;
      all.push_back(std::move(told));
    }
  }
  std::ranges::stable_sort(all, std::ranges::less(), &Evidence::Told::at);
  return all;
}

}  // namespace understudy::rehearse
