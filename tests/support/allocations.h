// Counts the calls of operator new in this test program, in all threads. Allocations of Cyclone's C
// are not counted.
#pragma once

#include <cstdint>

namespace understudy::test {

// Calls of operator new since the program's start.
std::uint64_t Allocations();
// Those of the calling thread.
std::uint64_t AllocationsOfThisThread();

}  // namespace understudy::test
