// Explains refusals and their remedies.
#pragma once

#include <string_view>

#include "robot/refusal.h"

namespace understudy::robot {

// Returns one line; "" for kNone.
std::string_view Explain(Refusal refusal);
// The same for a command to a hand.
std::string_view ExplainForHand(Refusal refusal);

}  // namespace understudy::robot
