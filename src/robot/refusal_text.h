// What a refusal means and what to do about it, in words.
#pragma once

#include <string_view>

#include "robot/refusal.h"

namespace understudy::robot {

// One line. "" for what is none.
std::string_view Explain(Refusal refusal);
// The same for a command to a hand.
std::string_view ExplainForHand(Refusal refusal);

}  // namespace understudy::robot
