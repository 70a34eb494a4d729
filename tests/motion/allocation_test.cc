// That a step of a motion service allocates nothing: operator new of this program counts.
#include "tests/motion/humanoid/fixture.h"
#include "tests/motion/policy_rig.h"
#include "tests/motion/quadruped/rig.h"
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

TEST_F(MotionAllocationTest, AHumanoidWalksWithoutAllocating) {
  HumanoidRig rig("g1");
  rig.Start("standing");
  rig.Run(1.5);
  rig.SetFsm(501);
  rig.Run(1);
  const std::uint64_t before = test::Allocations();
  rig.Ask(goal::Move{0.3, 0, 0.2, 1});
  rig.Run(4);
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_GT(rig.world().robot().base().p_WB.norm(), 0.8);
}

TEST_F(MotionAllocationTest, AQuadrupedWalksByAPolicyWithoutAllocating) {
  const PolicyFiles policy = TrotOfGo2();
  WalkingRig rig("go2", Plays("mcf", policy));
  rig.Start("standing");
  rig.Run(1.5);
  rig.Walk({0.5, 0, 0}, 0.5);
  const std::uint64_t before = test::Allocations();
  rig.Run(0.5);
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_EQ(rig.state().name, "walking");
}

TEST_F(MotionAllocationTest, AHumanoidWalksByAPolicyWithoutAllocating) {
  const PolicyFiles policy = StandOfG1();
  std::vector<std::string> settings = Plays("ai_sport", policy);
  settings.emplace_back("robot.motion.humanoid.walk=[501]");
  HumanoidRig rig(ConfigOf("g1", settings));
  rig.Start("standing");
  rig.Run(1.5);
  const std::uint64_t before = test::Allocations();
  rig.SetFsm(501);
  rig.Run(0.5);
  rig.Ask(goal::Move{0, 0, 0.1, 0.2});
  rig.Run(0.5);
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_EQ(rig.state().id, 501);
}

}  // namespace
}  // namespace understudy::motion
