// Counts what C++ allocates in this test program: operator new, on all threads. Cyclone's C is not
// counted.
#ifndef UNDERSTUDY_TESTS_SUPPORT_ALLOCATIONS_H_
#define UNDERSTUDY_TESTS_SUPPORT_ALLOCATIONS_H_

#include <cstdint>

namespace understudy::test {

// Calls of operator new since the program's start.
std::uint64_t Allocations();
// Those of the thread that asks.
std::uint64_t AllocationsOfThisThread();

}  // namespace understudy::test

#endif  // UNDERSTUDY_TESTS_SUPPORT_ALLOCATIONS_H_
