#include "wire/slots.h"

#include <string>
#include <utility>

#include "base/errors.h"

namespace understudy::wire {

void CheckFits(const robot::RobotSpec& spec, std::size_t slots, std::size_t cells) {
  int last = -1;
  for (const robot::MotorSpec& motor : spec.motors) {
    const std::string where =
        spec.name + ": motor " + motor.joint + " in slot " + std::to_string(motor.slot);
    if (motor.slot <= last) throw ModelError(where + " comes after slot " + std::to_string(last));
    if (std::cmp_greater_equal(motor.slot, slots)) {
      throw ModelError(where + ": the message has slots 0.." + std::to_string(slots - 1));
    }
    last = motor.slot;
  }
  if (spec.battery.cells < 1 || std::cmp_greater(spec.battery.cells, cells)) {
    throw ModelError(spec.name + ": battery.cells is " + std::to_string(spec.battery.cells) +
                     ", the message takes 1.." + std::to_string(cells));
  }
}

}  // namespace understudy::wire
