// That a step of a motion service allocates nothing: operator new of this program counts.
#include "tests/motion/humanoid/fixture.h"
#include "tests/support/allocations.h"

namespace understudy::motion {
namespace {

class MotionAllocationTest : public test::MujocoTest {};

TEST_F(MotionAllocationTest, AHumanoidStepsAndListensWithoutAllocating) {
  HumanoidRig rig("g1");
  rig.Start("standing");
  rig.Run(1);
  const std::uint64_t before = test::Allocations();
  rig.SetFsm(501);
  rig.Run(0.1);
  rig.Ask(goal::ArmAction{26});
  rig.Ask(goal::SetStandHeight{0.5});
  rig.Run(1.6);
  rig.SetFsm(706);
  rig.Run(0.1);
  rig.SetFsm(1);
  rig.SetFsm(2);
  rig.Run(0.1);
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace understudy::motion
