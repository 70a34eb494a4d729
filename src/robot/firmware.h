// Versions of the robot's software, as the vendor writes them: numbers between dots.
#pragma once

#include <string_view>

#include "robot/robot_spec.h"

namespace understudy::robot {

// Numbers between dots: "1.1.6".
bool IsFirmware(std::string_view version);

// Whether `version` is `since` or later, number by number; what is missing counts as 0. Both are
// IsFirmware.
bool FirmwareReaches(std::string_view version, std::string_view since);

// Whether that firmware has the service: not before `since`, not from `before` on, where they are
// set.
bool HasService(std::string_view firmware, const ServiceSpec& service);

// Whether the robot tells the id of its state machine's state; see RobotSpec::state_id_since.
bool TellsStateId(const RobotSpec& spec);

}  // namespace understudy::robot
