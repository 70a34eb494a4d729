// Tests in whole ticks who moves the motors.
#include <gmock/gmock.h>

#include "tests/emulator/emulator_test.h"
#include "tests/emulator/state_bytes.h"

namespace understudy::emulator {
namespace {

class OwnerTest : public EmulatorTest {
 protected:
  OwnerTest() {
    port_.TellEvery(1);
    config_.robots[0].spec.services = {{.name = "sport_mode", .alias = "normal"},
                                       {.name = "ai_sport", .alias = "ai"}};
    config_.robots[0].spec.remote.chords = {{.keys = "L2+B", .does = "damp"},
                                            {.keys = "L2+Y", .does = "zero_torque"},
                                            {.keys = "L2+R2", .does = "debug"}};
    config_.robots[0].spec.arm_sdk.slots = {6, 7};
    config_.robots[0].start.pose = "clamped";
  }

  double Torque0() const { return port_.last().state.motors[0].tau; }
  std::string_view Service() const { return robot().owner().active(); }
  std::uint64_t Refused() const {
    return world_->status(0)
        .commands.refused[static_cast<std::size_t>(robot::Refusal::kMotionService)];
  }
};

TEST_F(OwnerTest, TheRobotsOwnServiceHoldsTheMotorsAtTheStart) {
  Start();
  Tick(10);
  EXPECT_EQ(Service(), "normal");
  EXPECT_STREQ(world_->status(0).motion_service.data(), "normal");
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kClosed);
  ASSERT_TRUE(port_.last().state.motion.has_value());
  EXPECT_EQ(port_.last().state.motion->id, 1001);
  EXPECT_TRUE(port_.last().state.motors[0].enabled);
}

TEST_F(OwnerTest, LowCmdChangesNothingWhileAServiceIsOn) {
  test::FakePort quiet_port;
  quiet_port.TellEvery(1);
  Inbox quiet_inbox;
  Start();
  const auto quiet = Make(&quiet_port, &quiet_inbox);
  for (int i = 0; i < 100; ++i) {
    port_.Send(Torque(9));
    Tick();
    ASSERT_EQ(quiet->Tick({}), physics::StepHealth::kFine);
    ASSERT_EQ(Bytes(port_.last().state), Bytes(quiet_port.last().state)) << i;
  }
  EXPECT_EQ(Refused(), 100U);
  EXPECT_THAT(Told(EventKind::kRefused).back(), testing::HasSubstr("LowCmd (motion_service)"));
  EXPECT_EQ(world_->status(0).commands.accepted, 0U);
}

TEST_F(OwnerTest, SaysOnceWhichJointsTheArmsCommandTakesAndDoesNotHold) {
  Start();
  robot::RobotCommand arms;
  arms.motors.assign(config_.robots[0].spec.motors.size(), {.enabled = true, .kd = 1});
  const auto held = std::ranges::find(config_.robots[0].spec.motors, 6, &robot::MotorSpec::slot);
  const auto unheld = std::ranges::find(config_.robots[0].spec.motors, 7, &robot::MotorSpec::slot);
  arms.motors[static_cast<std::size_t>(held - config_.robots[0].spec.motors.begin())].kp = 40;
  port_.SendArms(arms, 0);
  Tick();
  EXPECT_THAT(Told(EventKind::kUnheld), testing::IsEmpty()) << "it takes nothing yet";
  port_.SendArms(arms, 0.5);
  Tick();
  port_.SendArms(arms, 0.6);
  Tick();
  EXPECT_THAT(Told(EventKind::kUnheld),
              testing::ElementsAre("rt/arm_sdk: " + unheld->joint +
                                   ": kp and tau of their commands are 0, so nothing holds them"));
}

TEST_F(OwnerTest, LowCmdIsFollowedAfterRelease) {
  Start();
  Tick(10);
  services_.Call([](authority::MotorOwner* owner) { owner->Release(); });
  Tick();
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kDamping);
  EXPECT_FALSE(port_.last().state.motion.has_value());
  port_.Send(Torque(2));
  Tick();
  EXPECT_EQ(Torque0(), 2);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kFollowing);
}

TEST_F(OwnerTest, CallsOfServicesAreEvents) {
  Start();
  Tick(10);
  services_.Call([](authority::MotorOwner* owner) { owner->Release(); });
  Tick();
  Tick();
  EXPECT_EQ(Told(EventKind::kCall), std::vector<std::string>{"fake 1 answers 0"});
  EXPECT_EQ(Answered("service.call", {{"service", "release"}, {"api", 1003}}), "");
  EXPECT_EQ(Told(EventKind::kCall).back(), "release 1003 answers 0");
}

TEST_F(OwnerTest, ASelectedServiceTakesTheMotorsBack) {
  Start();
  services_.Call([](authority::MotorOwner* owner) { owner->Release(); });
  port_.SendEveryTick(Torque(2));
  Tick(5);
  EXPECT_EQ(Torque0(), 2);
  services_.Call([](authority::MotorOwner* owner) {
    EXPECT_EQ(owner->Select("ai"), authority::OwnerVerdict::kDone);
  });
  Tick(2);
  EXPECT_NE(Torque0(), 2);
  EXPECT_EQ(Refused(), 2U);
}

TEST_F(OwnerTest, StartsReleasedOnRequestAndHoldsItsPoseThen) {
  config_.robots[0].motion.service = authority::kNoService;
  config_.robots[0].start.pose = "standing";
  Start();
  Tick(500);
  EXPECT_EQ(Service(), "");
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kStart);
  EXPECT_NEAR(Height(), config_.robots[0].spec.standing.height, 0.01);
}

TEST_F(OwnerTest, StaysReleasedOverAReset) {
  Start();
  Tick();
  services_.Call([](authority::MotorOwner* owner) { owner->Release(); });
  Ask("reset");
  Tick();
  EXPECT_EQ(Service(), "");
  port_.Send(Torque(2));
  Tick();
  EXPECT_EQ(Torque0(), 2);
}

TEST_F(OwnerTest, FightsWhereFirmwareDoes) {
  config_.robots[0].motion.fight = true;
  Start();
  Tick(2);
  port_.SendEveryTick(Torque(2));
  Tick();
  EXPECT_EQ(Torque0(), 2);
  EXPECT_EQ(Service(), "normal");
  EXPECT_EQ(Refused(), 0U);
}

TEST_F(OwnerTest, ChordsActOnTheService) {
  Start();
  Tick();
  Ask("remote.press", {{"keys", "L2+Y"}, {"for", 0.01}});  // L2+Y
  Tick(3);
  EXPECT_FALSE(port_.last().state.motors[0].enabled);
  Tick(10);
  Ask("remote.press", {{"keys", "L2+B"}, {"for", 0.01}});  // L2+B
  Tick(3);
  EXPECT_TRUE(port_.last().state.motors[0].enabled);
  EXPECT_TRUE(port_.last().state.remote.there);
  EXPECT_EQ(port_.last().state.remote.keys, 0x220);
}

TEST_F(OwnerTest, DebugByTheRemoteReleasesToLowCmd) {
  Start();
  Tick();
  Ask("remote.press", {{"keys", "L2+R2"}, {"for", 0.01}});  // L2+R2
  Tick();
  EXPECT_EQ(Service(), "");
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kDamping);
  port_.Send(Torque(2));
  Tick();
  EXPECT_EQ(Torque0(), 2);
}

TEST_F(OwnerTest, StatesAreToldByNameWithTheVendorsNumber) {
  config_.robots[0].spec.kind = robot::RobotKind::kHumanoid;
  Start();
  Tick(10);
  EXPECT_EQ(world_->status(0).motion.name, "damping");
  EXPECT_EQ(Answered("remote.press", {{"keys", "L2+Y"}}), "");
  Tick(10);
  EXPECT_EQ(world_->status(0).motion.name, "zero torque");
  EXPECT_EQ(Told(EventKind::kMotion), std::vector<std::string>{"zero torque (0)"});
}

TEST_F(OwnerTest, AChordThatNoServiceHearsIsToldWithWhatBringsItBack) {
  config_.robots[0].spec.remote.chords.push_back({.keys = "L2+A", .does = "stand_up"});
  Start();
  Tick(10);
  EXPECT_EQ(Answered("remote.press", {{"keys", "L2+R2"}}), "");
  Tick(200);
  EXPECT_EQ(Service(), "");
  EXPECT_THAT(Told(EventKind::kUnheeded), testing::IsEmpty());
  EXPECT_EQ(Answered("remote.press", {{"keys", "L2+A"}}), "");
  Tick(200);
  EXPECT_THAT(Told(EventKind::kUnheeded),
              testing::ElementsAre(testing::HasSubstr(
                  "L2+A: no motion service is on that could obey; `understudy ctl service call "
                  "motion_switcher 1002 '{\"name\": \"normal\"}'` switches it on")));
}

TEST_F(OwnerTest, WhatTheServiceDoesNotDoIsToldWithTheStateItStaysIn) {
  config_.robots[0].spec.remote.chords.push_back({.keys = "L2+A", .does = "stand_up"});
  Start();
  Tick(10);
  EXPECT_EQ(Answered("remote.press", {{"keys", "L2+A"}}), "");
  Tick();
  ASSERT_EQ(Told(EventKind::kUnheeded).size(), 1u);
  EXPECT_THAT(Told(EventKind::kUnheeded)[0], testing::HasSubstr("damping (1001)"));
}

TEST_F(OwnerTest, ArmSdkMovesItsJointsOverTheService) {
  Start();
  Tick(10);
  port_.SendArms(Torque(2), 1);
  Tick();
  EXPECT_EQ(port_.last().state.motors[4].tau, 2);
  EXPECT_EQ(port_.last().state.motors[5].tau, 2);
  EXPECT_NE(Torque0(), 2);
  EXPECT_EQ(world_->status(0).arm_weight, 1);
}

TEST_F(OwnerTest, ServiceCommandsAtItsOwnRate) {
  config_.robots[0].spec.rates.service_hz = 100;
  Start();
  Tick(2);  // it commands in the first step, then in the one after each sample
  Ask("remote.press", {{"keys", "L2+Y"}, {"for", 0.05}});
  Tick(9);
  EXPECT_TRUE(port_.last().state.motors[0].enabled);
  Tick(1);
  EXPECT_FALSE(port_.last().state.motors[0].enabled);
}

}  // namespace
}  // namespace understudy::emulator
