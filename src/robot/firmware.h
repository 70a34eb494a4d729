// Compares versions of the robot's software: numbers between dots.
#pragma once

#include <string_view>

#include "robot/robot_spec.h"

namespace understudy::robot {

// Returns whether the text is numbers between dots, such as "1.1.6".
bool IsFirmware(std::string_view version);

// Returns whether `version` is `since` or later, compared number by number; missing numbers count
// as 0. Both must be IsFirmware.
bool FirmwareReaches(std::string_view version, std::string_view since);

// Returns whether that firmware has the service: from `since` on, if set, and before `before`, if
// set.
bool HasService(std::string_view firmware, const ServiceSpec& service);

// Returns whether the robot publishes the id of its state (RobotSpec::state_id_since).
bool TellsStateId(const RobotSpec& spec);

// Returns whether its SportModeState has the distances of obstacles: that of a robot with a lidar
// that does not publish that id. Newer ones publish zeros (docs/dev/sources.md).
bool TellsRanges(const RobotSpec& spec);

}  // namespace understudy::robot
