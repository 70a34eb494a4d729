#include "signals/condition_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/world.h"
#include "judge/condition.h"
#include "robot/hand_law.h"
#include "robot/pads.h"

namespace understudy::signals {
namespace {

using Source = Signal::Source;

}  // namespace

ConditionWatch::ConditionWatch(signals::Conditions conditions, const emulator::World& world)
    : conditions_(std::move(conditions)),
      slots_(conditions_.signals.size()),
      events_(&world.events()),
      measured_(world.robot_count()) {
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    if (AsksForObstacles(conditions_.signals, i)) {
      measured_[i].obstacles.emplace(world.physics(), i);
    }
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Signal& signal = conditions_.signals[i];
    Slot& slot = slots_[i];
    const emulator::Robot& robot = world.robot(signal.robot);
    if (signal.source == Source::kTruth) measured_[signal.robot].asked = true;
    if (!signal.object.empty()) slot.object = world.physics().FindObject(signal.object);
    measured_[signal.robot].foot_force.resize(robot.spec().feet.size());
    measured_[signal.robot].hand_force.resize(robot::HandNames(robot.spec()).size());
    measured_[signal.robot].touch.resize(robot::PadNames(robot.spec()).size());
    measured_[signal.robot].cells.resize(robot::CellsOf(robot.spec()));
    values_.push_back(
        signal.of_one_instant() || signal.source == Source::kEventCount ? 0 : judge::kUnknown);
    slot.word = judge::WordNumber(signal.printed);
    slot.topic = static_cast<std::size_t>(std::ranges::find(robot.topics(), signal.topic) -
                                          robot.topics().begin());
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

void ConditionWatch::Look(const emulator::World& world, bool measure) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (conditions_.signals[i].of_one_instant()) values_[i] = 0;
  }
  for (emulator::Event event; events_.Next(&event);) Take(event);
  Hear(world);
  if (measure) Measure(world);
}

bool ConditionWatch::Holds(std::size_t condition) const {
  const double margin = judge::MarginOf(conditions_.formulas[condition], values_);
  return judge::IsKnown(margin) && judge::Holds(margin);
}

void ConditionWatch::Take(const emulator::Event& event) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    if (slot.row == nullptr || slot.row->kind != event.kind) continue;
    if (slot.request != nullptr && slot.request != event.request.row) continue;
    const bool other = event.robot != conditions_.signals[i].robot;
    if (other && !emulator::RowOf(event.kind).of_world) continue;
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

void ConditionWatch::Hear(const emulator::World& world) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Source source = conditions_.signals[i].source;
    if (source != Source::kArrival && source != Source::kGap && source != Source::kRate) continue;
    Slot& slot = slots_[i];
    const std::uint64_t heard = world.robot(conditions_.signals[i].robot).heard(slot.topic);
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

void ConditionWatch::Measure(const emulator::World& world) {
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    Measured& of = measured_[i];
    if (!of.asked) continue;
    const emulator::Robot& robot = world.robot(i);
    const physics::RobotBody& body = world.physics().robot(i);
    body.FootForces(of.foot_force);
    body.HandForces(of.hand_force);
    body.ReadTouch(of.cells);
    robot::StrongestCells(robot.spec(), of.cells, of.touch);
    of.truth = {.base_position = body.base_position(),
                .base_velocity = body.base_velocity(),
                .tau = robot.torque(),
                .foot_force = of.foot_force,
                .hand_force = of.hand_force,
                .touch = of.touch,
                .crane_tension = robot.crane().attached() ? robot.crane().tension() : 0};
    if (of.obstacles) {
      of.truth.nearest_obstacle = of.obstacles->Measure(world.step(), world.physics().data());
    }
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Signal& signal = conditions_.signals[i];
    if (slots_[i].object != nullptr) {
      const physics::LooseBody& object = *slots_[i].object;
      values_[i] = signal.of_object({.position = world.physics().ObjectPosition(object),
                                     .velocity = world.physics().ObjectVelocity(object)});
    } else if (signal.of != nullptr) {
      values_[i] = signal.Told(signal.of(measured_[signal.robot].truth, signal.index));
    }
    if (signal.source == Source::kField) {
      values_[i] = signal.Told(signal.of_sample(world.robot(signal.robot).sampled(), signal.index));
    }
  }
}

}  // namespace understudy::signals
