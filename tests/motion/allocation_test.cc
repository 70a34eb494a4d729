// That a step of a motion service allocates nothing: operator new of this program counts.
#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/motion/humanoid_fixture.h"

namespace {

std::atomic<std::int64_t> allocations = 0;

}  // namespace

// Never inlined: seen from inside one of them, the compiler takes malloc and free for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace understudy {
namespace {

class MotionAllocationTest : public MujocoTest {};

TEST_F(MotionAllocationTest, AHumanoidStepsAndListensWithoutAllocating) {
  HumanoidRig rig("g1");
  rig.Stand();
  rig.Run(1);
  const std::int64_t before = allocations;
  rig.SetFsm(500);
  rig.Run(0.1);
  rig.Ask(MotionAction::kArmAction, 26);
  rig.Ask(MotionAction::kSetStandHeight, 0.5);
  rig.Run(1.6);
  rig.SetFsm(706);
  rig.Run(0.1);
  rig.SetFsm(1);
  rig.SetFsm(2);
  rig.Run(0.1);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace understudy
