// What the emulator shows of itself.
#include <cmath>
#include <filesystem>

#include "physics/world_model.h"
#include "tests/emulator/emulator_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::emulator {
namespace {

class FrameTest : public EmulatorTest {
 protected:
  Frame Shown(FrameParts parts = kAllFrameParts) {
    Frame frame = world_->MakeFrame();
    frame.parts = parts;
    world_->Show(&frame);
    return frame;
  }
};

TEST_F(FrameTest, IsThereBeforeTheFirstTick) {
  StartAs("standing");
  const Frame frame = Shown();
  EXPECT_EQ(frame.step, 0);
  EXPECT_EQ(frame.body_names.size(), frame.bodies.size());
  EXPECT_EQ(frame.motor_names.size(), frame.motors.size());
  EXPECT_DOUBLE_EQ(frame.bodies[1][2], Height());
}

TEST_F(FrameTest, HasTheRobotWhereItIs) {
  StartAs("standing");
  Tick(20);
  const Frame frame = Shown();
  EXPECT_EQ(frame.step, 20);
  EXPECT_DOUBLE_EQ(frame.time, 0.02);
  EXPECT_FALSE(frame.paused);
  EXPECT_DOUBLE_EQ(frame.bodies[1][2], Height());
  EXPECT_NEAR(frame.positions[2], Height(), 0.01);
  ASSERT_EQ(frame.command.size(), 6u);
  EXPECT_GT(frame.command[0].kp, 0);
  ASSERT_FALSE(frame.contacts.empty());
  double lift = 0;
  for (const physics::ContactReading& contact : frame.contacts) {
    EXPECT_EQ(contact.bodies[0], 0);  // the ground's geom comes first
    lift += contact.force[2];
  }
  EXPECT_GT(lift, 0);
}

// In a scene with a body of its own, which is heavier and 5 m away.
TEST_F(FrameTest, HasTheCentreOfMassOfTheRobotAlone) {
  const test::TemporaryFolder folder;
  const std::filesystem::path scene = folder.Write("scene.xml", R"(<mujoco><worldbody>
      <geom type="plane" size="0 0 1" contype="0" conaffinity="1"/>
      <body name="rock" pos="5 0 0.5"><geom type="box" size="0.5 0.5 0.5" mass="1000"/></body>
      </worldbody></mujoco>)");
  config_.start.pose = "standing";
  const std::vector<physics::PlacedRobot> robots{{config_.robot, config_.robot.model}};
  world_ = MakeIn({physics::LoadWorldModel(robots, scene, config_.physics.timestep), robots},
                  &port_, &inbox_);
  Tick();
  EXPECT_NEAR(Shown().com[0], 0, 0.1);
}

TEST_F(FrameTest, HasTheCraneAndItsPull) {
  StartAs("hanging");
  Tick(20);
  const Frame frame = Shown(kPartCrane);
  EXPECT_TRUE(frame.crane.attached);
  EXPECT_GT(frame.crane.tension, 0);
  EXPECT_GT(frame.crane.top[2], frame.crane.hook[2]);
}

TEST_F(FrameTest, HasPushesWhileTheyLast) {
  StartAs("standing");
  Ask("push", {{"force", {0, 5, 0}}, {"for", 0.01}});
  Tick(2);
  const Frame frame = Shown(kPartPushes);
  ASSERT_EQ(frame.pushes.size(), 1u);
  EXPECT_EQ(frame.pushes[0].force[1], 5);
  Tick(20);
  EXPECT_TRUE(Shown(kPartPushes).pushes.empty());
}

TEST_F(FrameTest, TellsThatItIsPaused) {
  Start();
  Tick();
  Ask("pause");
  world_->Attend({});
  EXPECT_TRUE(Shown(0).paused);
}

TEST_F(FrameTest, NamesTheTopicsThatTheRobotHas) {
  config_.robot.arm_sdk.slots = {6, 7};
  StartAs("standing");  // without a motion service
  port_.SendArms(Torque(1), 1);
  port_.SendUser(Torque(1));
  Tick();
  EXPECT_EQ(Told(EventKind::kRefused).size(), 2U);
  const Frame frame = Shown(0);
  ASSERT_EQ(frame.command_topics.size(), robot::kFirstHandTopic);
  EXPECT_EQ(frame.command_topics[robot::kArmSdkTopic], "rt/arm_sdk");
  EXPECT_EQ(frame.command_topics[robot::kUserLowCmdTopic], "");  // it has none
  const Status status = world_->status();
  EXPECT_EQ(CommandCounts(status, robot::kArmSdkTopic)
                .refused[static_cast<std::size_t>(robot::Refusal::kNoMotionService)],
            1u);
}

}  // namespace
}  // namespace understudy::emulator
