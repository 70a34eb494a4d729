#include "drive/command_transport.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace understudy::drive {
namespace {

bool TakesTime(const robot::BusEffects& fault) { return fault.drops || fault.delay > 0; }

}  // namespace

CommandTransport::CommandTransport(const robot::RobotSpec& spec, double dt, int seed,
                                   const robot::RobotCommand& start)
    : delay_(std::round(spec.dynamics.delay / dt) * dt), takes_time_(delay_ > 0), followed_(start) {
  std::uint64_t stream = static_cast<std::uint64_t>(seed) + 0xB05;
  for (robot::MotorBus& bus : robot::BusesOf(spec)) {
    takes_time_ = takes_time_ || bus.delay[1] > 0;
    const double most = delay_ + bus.delay[1];
    const std::size_t places = most > 0 ? static_cast<std::size_t>(std::ceil(most / dt)) + 2 : 0;
    const std::vector<robot::MotorCommand> part(bus.motors.size());
    ways_.push_back({std::move(bus), LateQueue(places, part), std::mt19937_64(stream++)});
  }
}

const robot::RobotCommand& CommandTransport::Pass(const robot::RobotCommand& command, double t,
                                                  std::span<const robot::BusEffects> faults) {
  busy_ =
      takes_time_ || std::ranges::any_of(faults, TakesTime) ||
      (busy_ && std::ranges::any_of(ways_, [](const Way& way) { return !way.under_way.empty(); }));
  if (!busy_) {
    std::ranges::copy(command.motors, followed_.motors.begin());
    return followed_;
  }
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    Carry(&ways_[i], command, t, i < faults.size() ? faults[i] : robot::BusEffects{});
  }
  return followed_;
}

void CommandTransport::Carry(Way* way, const robot::RobotCommand& command, double t,
                             const robot::BusEffects& fault) {
  const std::vector<std::size_t>& motors = way->bus.motors;
  double due = t + delay_ + fault.delay;
  if (const auto& [least, most] = way->bus.delay; most > 0) {
    // From [0, 1): the same with every standard library, which a distribution is not.
    due += least + (most - least) * static_cast<double>(way->random() >> 11U) * 0x1p-53;
  }
  if (auto* const sent = fault.drops ? nullptr : way->under_way.Push(due); sent != nullptr) {
    sent->resize(motors.size());
    for (std::size_t i = 0; i < motors.size(); ++i) (*sent)[i] = command.motors[motors[i]];
  }
  while (const auto* arrived = way->under_way.Due(t)) {
    for (std::size_t i = 0; i < motors.size(); ++i) followed_.motors[motors[i]] = (*arrived)[i];
    way->under_way.Pop();
  }
}

void CommandTransport::Restart(const robot::RobotCommand& start) {
  Clear();
  followed_ = start;
}

void CommandTransport::Clear() {
  for (Way& way : ways_) way.under_way.Clear();
  std::ranges::fill(followed_.motors, robot::MotorCommand{});
}

}  // namespace understudy::drive
