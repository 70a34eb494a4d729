// Counts what C++ allocates in this test program: operator new, on all threads. Cyclone's C is not
// counted.
#pragma once

#include <cstdint>

namespace understudy::test {

// Calls of operator new since the program's start.
std::uint64_t Allocations();
// Those of the thread that asks.
std::uint64_t AllocationsOfThisThread();

}  // namespace understudy::test
