// Says who serves a topic on the vendor's robots.
#pragma once

#include <string>
#include <string_view>

namespace understudy::wire {

// Returns what serves the topic on a real robot, without a full stop; "" for a topic that is not
// known to be a robot's.
std::string WhoServes(std::string_view topic);

// Returns the same of a topic for which a program waits. Of one that is not known it says so, with
// the nearest name that a robot has.
std::string WhoWouldSend(std::string_view topic);

}  // namespace understudy::wire
