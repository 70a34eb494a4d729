// What rows of the table are made of: edits of a good command, and what the robot does then.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "robot/refusal.h"
#include "tests/bad_commands/rig.h"

namespace understudy::bad_commands {

inline constexpr std::string_view kAssumed = "*assumed*", kVendor = "vendor",
                                  kMeasured = "measured";

using Edit = std::function<void(Message*, const Rig&)>;
using Play = std::function<void(Rig*)>;

std::size_t SlotOf(const Rig& rig, std::size_t motor);

// Edits the slot of the first motor, or of the last.
Edit First(std::function<void(Slot*)> edit);
Edit Last(std::function<void(Slot*)> edit);
// Edits those of all motors.
Edit Each(std::function<void(Slot*)> edit);
Edit Whole(std::function<void(Message*)> edit);

// A good command is followed, the bad one refused: the good one goes on.
Play Refused(robot::Refusal refusal, const Edit& edit);

// It is taken like any; `expect` says what follows within 50 ms.
Play Taken(const Edit& edit, const std::function<void(Rig*)>& expect = {});

}  // namespace understudy::bad_commands
