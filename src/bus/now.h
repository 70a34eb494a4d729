// The clock of the bus.
#pragma once

#include <chrono>

namespace understudy::bus {

// Since 1970, by the clock that stamps messages: CLOCK_REALTIME, or the simulated one of programs.
std::chrono::nanoseconds Now();

}  // namespace understudy::bus
