#include "robot/buses.h"

#include <algorithm>
#include <utility>

namespace understudy::robot {

std::vector<MotorBus> BusesOf(const RobotSpec& spec) {
  std::vector<MotorBus> buses;
  MotorBus others;
  for (const BusSpec& bus : spec.buses) {
    buses.push_back({.name = bus.name, .motors = {}, .delay = bus.delay});
  }
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const auto has = [slot = spec.motors[i].slot](const BusSpec& bus) {
      return std::ranges::find(bus.slots, slot) != bus.slots.end();
    };
    const auto found = std::ranges::find_if(spec.buses, has);
    const auto place = static_cast<std::size_t>(found - spec.buses.begin());
    (found == spec.buses.end() ? others : buses[place]).motors.push_back(i);
  }
  std::size_t next = spec.motors.size();
  for (const HandSpec& hand : spec.hands) {
    MotorBus bus{.name = hand.name + "_hand"};
    for (std::size_t i = 0; i < hand.motors.size(); ++i) bus.motors.push_back(next++);
    buses.push_back(std::move(bus));
  }
  if (!others.motors.empty()) buses.push_back(std::move(others));
  return buses;
}

}  // namespace understudy::robot
