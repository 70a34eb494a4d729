#include "signals/watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/world.h"
#include "judge/condition.h"
#include "physics/world_reading.h"

namespace understudy::signals {
namespace {

using Source = Signal::Source;

}  // namespace

Watch::Watch(signals::Conditions conditions, const emulator::World& world)
    : conditions_(std::move(conditions)),
      slots_(conditions_.signals.size()),
      events_(&world.events()),
      qpos_(physics::PositionCount(world.physics())),
      qvel_(physics::RateCount(world.physics())),
      foot_force_(world.robot().spec().feet.size()) {
  const std::vector<std::string>& topics = world.robot().topics();
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Signal& signal = conditions_.signals[i];
    Slot& slot = slots_[i];
    values_.push_back(
        signal.of_one_instant() || signal.source == Source::kEventCount ? 0 : judge::kUnknown);
    slot.word = judge::WordNumber(signal.printed);
    slot.topic = static_cast<std::size_t>(std::ranges::find(topics, signal.topic) - topics.begin());
    if (signal.source == Source::kRate) {
      slot.recent =
          RecentArrivals(static_cast<std::size_t>(std::ceil(1 / world.physics().timestep())));
    }
    if (signal.source == Source::kFirstJump) {
      slot.row = &emulator::RowOf(emulator::EventKind::kFirstCommand);
    }
    if (signal.origin() != Origin::kEvents) continue;
    const auto row =
        std::ranges::find(emulator::EventTable(), signal.topic, &emulator::EventRow::name);
    if (row != emulator::EventTable().end()) {
      slot.row = &*row;
      slot.field = static_cast<std::size_t>(
          std::ranges::find(row->fields, signal.field, &emulator::EventField::name) -
          row->fields.begin());
    } else {
      slot.row = &emulator::RowOf(emulator::EventKind::kRequest);
      slot.request =
          &*std::ranges::find(emulator::RequestRows(), signal.topic, &emulator::RequestRow::name);
    }
  }
}

void Watch::Look(const emulator::World& world, bool measure) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (conditions_.signals[i].of_one_instant()) values_[i] = 0;
  }
  for (emulator::Event event; events_.Next(&event);) Take(event);
  Hear(world);
  if (measure) Measure(world);
}

bool Watch::Holds(std::size_t condition) const {
  const double margin = judge::MarginOf(conditions_.formulas[condition], values_);
  return judge::IsKnown(margin) && judge::Holds(margin);
}

void Watch::Take(const emulator::Event& event) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    if (slot.row == nullptr || slot.row->kind != event.kind) continue;
    if (slot.request != nullptr && slot.request != event.request.row) continue;
    switch (conditions_.signals[i].source) {
      case Source::kEventField:
      case Source::kFirstJump:
        values_[i] = emulator::FieldNumber(event, slot.field);
        break;
      case Source::kPrint:
        if (emulator::FieldNumber(event, slot.field) == slot.word) values_[i] += 1;
        break;
      default:
        values_[i] += 1;
        break;
    }
  }
}

void Watch::Hear(const emulator::World& world) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Source source = conditions_.signals[i].source;
    if (source != Source::kArrival && source != Source::kGap && source != Source::kRate) continue;
    Slot& slot = slots_[i];
    const std::uint64_t heard = world.robot().heard(slot.topic);
    const auto arrived = static_cast<double>(heard - slot.heard);
    if (source == Source::kArrival) values_[i] = arrived;
    if (source == Source::kGap && heard > 0) {
      values_[i] = slot.heard == 0 ? 0 : world.time() - slot.last;
      if (heard > slot.heard) slot.last = world.time();
    }
    if (source == Source::kRate) {
      const std::int64_t now = std::llround(world.time() * 1e9);
      if (heard > slot.heard) slot.recent.Add(now, heard - slot.heard);
      values_[i] = slot.recent.RateAt(now);
    }
    slot.heard = heard;
  }
}

void Watch::Measure(const emulator::World& world) {
  const auto from = [this](Origin origin) {
    return std::ranges::any_of(
        conditions_.signals, [origin](const Signal& signal) { return signal.origin() == origin; });
  };
  Truth truth;
  if (from(Origin::kTruth)) {
    const physics::Crane& crane = world.robot().crane();
    physics::ReadPositions(world.physics(), qpos_);
    physics::ReadRates(world.physics(), qvel_);
    world.physics().robot().FootForces(foot_force_);
    truth = {.qpos = qpos_,
             .qvel = qvel_,
             .tau = world.robot().torque(),
             .foot_force = foot_force_,
             .crane_tension = crane.attached() ? crane.tension() : 0};
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Signal& signal = conditions_.signals[i];
    if (signal.source == Source::kTruth) values_[i] = signal.Told(signal.of(truth, signal.index));
    if (signal.source == Source::kField) {
      values_[i] = signal.Told(signal.of_sample(world.robot().sampled(), signal.index));
    }
  }
}

}  // namespace understudy::signals
