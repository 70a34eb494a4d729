// The cores and the priority of the calling thread.
#pragma once

#include <optional>
#include <utility>

#include "base/unique_fd.h"

namespace understudy::simclock {

void Pin(int core);
// Lets this thread run on all its cores but that one, which another may keep.
void KeepOff(int core);
// Takes real-time priority below that of programs; false: there is no right to it.
bool TakeFifo();
// A core that no other run on this machine has for itself, with its lock. The first core is never
// one: the rest of the machine needs it.
std::optional<std::pair<int, UniqueFd>> CoreOfOurOwn();

}  // namespace understudy::simclock
