#include "tests/support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};
thread_local std::uint64_t allocations_here = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  ++allocations_here;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// What a sanitizer would have of its own, as std::stable_sort asks for.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  ++allocations_here;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace understudy::test {

std::uint64_t Allocations() { return allocations; }
std::uint64_t AllocationsOfThisThread() { return allocations_here; }

}  // namespace understudy::test
