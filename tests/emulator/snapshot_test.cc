// Tests the snapshots of a world.
#include <cmath>
#include <filesystem>

#include "physics/world_model.h"
#include "tests/emulator/emulator_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::emulator {
namespace {

class SnapshotTest : public EmulatorTest {
 protected:
  Snapshot Shown(SnapshotParts parts = kAllSnapshotParts) {
    Snapshot snapshot = world_->MakeSnapshot(0);
    snapshot.parts = parts;
    world_->Show(&snapshot);
    return snapshot;
  }
};

TEST_F(SnapshotTest, IsThereBeforeTheFirstTick) {
  StartAs("standing");
  const Snapshot snapshot = Shown();
  EXPECT_EQ(snapshot.step, 0);
  EXPECT_EQ(snapshot.body_names.size(), snapshot.bodies.size());
  EXPECT_EQ(snapshot.motor_names.size(), snapshot.motors.size());
  EXPECT_DOUBLE_EQ(snapshot.bodies[1][2], Height());
}

TEST_F(SnapshotTest, HasTheRobotWhereItIs) {
  StartAs("standing");
  Tick(20);
  const Snapshot snapshot = Shown();
  EXPECT_EQ(snapshot.step, 20);
  EXPECT_DOUBLE_EQ(snapshot.time, 0.02);
  EXPECT_FALSE(snapshot.paused);
  EXPECT_DOUBLE_EQ(snapshot.bodies[1][2], Height());
  EXPECT_NEAR(snapshot.positions[2], Height(), 0.01);
  ASSERT_EQ(snapshot.command.size(), 6u);
  EXPECT_GT(snapshot.command[0].kp, 0);
  ASSERT_FALSE(snapshot.contacts.empty());
  double lift = 0;
  for (const physics::ContactReading& contact : snapshot.contacts) {
    EXPECT_EQ(contact.bodies[0], 0);  // the ground's geom comes first
    lift += contact.force[2];
  }
  EXPECT_GT(lift, 0);
}

TEST_F(SnapshotTest, HasTheForcesOnTheRobotWhateverItsGroundIsMadeOf) {
  const test::TemporaryFolder folder;
  const std::filesystem::path scene = folder.Write("scene.xml", R"(<mujoco><worldbody>
      <geom type="box" pos="0 0 -0.5" size="5 5 0.5" contype="0" conaffinity="1"/>
      </worldbody></mujoco>)");
  config_.robots[0].start.pose = "standing";
  const std::vector<physics::PlacedRobot> robots{
      {config_.robots[0].spec, config_.robots[0].spec.model}};
  world_ = MakeIn({physics::LoadWorldModel(robots, scene, config_.physics.timestep), robots},
                  &port_, &inbox_);
  Tick(20);
  const Snapshot snapshot = Shown(kPartContacts);
  ASSERT_FALSE(snapshot.contacts.empty());
  for (const physics::ContactReading& contact : snapshot.contacts) {
    EXPECT_EQ(contact.bodies[0], 0);
    EXPECT_GT(contact.force[2], 0);
  }
}

// In a scene with a body of its own, which is heavier and 5 m away.
TEST_F(SnapshotTest, HasTheCentreOfMassOfTheRobotAlone) {
  const test::TemporaryFolder folder;
  const std::filesystem::path scene = folder.Write("scene.xml", R"(<mujoco><worldbody>
      <geom type="plane" size="0 0 1" contype="0" conaffinity="1"/>
      <body name="rock" pos="5 0 0.5"><geom type="box" size="0.5 0.5 0.5" mass="1000"/></body>
      </worldbody></mujoco>)");
  config_.robots[0].start.pose = "standing";
  const std::vector<physics::PlacedRobot> robots{
      {config_.robots[0].spec, config_.robots[0].spec.model}};
  world_ = MakeIn({physics::LoadWorldModel(robots, scene, config_.physics.timestep), robots},
                  &port_, &inbox_);
  Tick();
  EXPECT_NEAR(Shown().com[0], 0, 0.1);
}

TEST_F(SnapshotTest, HasTheCraneAndItsPull) {
  StartAs("hanging");
  Tick(20);
  const Snapshot snapshot = Shown(kPartCrane);
  EXPECT_TRUE(snapshot.crane.attached);
  EXPECT_GT(snapshot.crane.tension, 0);
  EXPECT_GT(snapshot.crane.top[2], snapshot.crane.hook[2]);
}

TEST_F(SnapshotTest, HasPushesWhileTheyLast) {
  StartAs("standing");
  Ask("push", {{"force", {0, 5, 0}}, {"for", 0.01}});
  Tick(2);
  const Snapshot snapshot = Shown(kPartPushes);
  ASSERT_EQ(snapshot.pushes.size(), 1u);
  EXPECT_EQ(snapshot.pushes[0].force[1], 5);
  Tick(20);
  EXPECT_TRUE(Shown(kPartPushes).pushes.empty());
}

TEST_F(SnapshotTest, TellsThatItIsPaused) {
  Start();
  Tick();
  Ask("pause");
  world_->Attend({});
  EXPECT_TRUE(Shown(0).paused);
}

TEST_F(SnapshotTest, NamesTheTopicsThatTheRobotHas) {
  config_.robots[0].spec.arm_sdk.slots = {6, 7};
  StartAs("standing");  // without a motion service
  port_.SendArms(Torque(1), 1);
  port_.SendUser(Torque(1));
  Tick();
  EXPECT_EQ(Told(EventKind::kRefused).size(), 2U);
  const Snapshot snapshot = Shown(0);
  ASSERT_EQ(snapshot.command_topics.size(), robot::kFirstHandTopic);
  EXPECT_EQ(snapshot.command_topics[robot::kArmSdkTopic], "rt/arm_sdk");
  EXPECT_EQ(snapshot.command_topics[robot::kUserLowCmdTopic], "");  // it has none
  const Status status = world_->status(0);
  EXPECT_EQ(CommandCounts(status, robot::kArmSdkTopic)
                .refused[static_cast<std::size_t>(robot::Refusal::kNoMotionService)],
            1u);
}

}  // namespace
}  // namespace understudy::emulator
