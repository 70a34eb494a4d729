// Tests hands in whole ticks.
#include <cmath>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

constexpr std::size_t kRoll = 0;  // its motors, the other way round than the model's joints
constexpr std::size_t kPitch = 1;

class HandsTest : public EmulatorTest {
 protected:
  HandsTest() {
    config_.robots[0].spec = test::FixtureRobotWithHand();
    StartAs("clamped");
  }

  // Both motors to these angles.
  static robot::RobotCommand Reach(double roll, double pitch, bool watched = false) {
    const auto motor = [watched](double q) -> robot::MotorCommand {
      return {.enabled = true, .q = q, .kp = 20, .kd = 1, .watched = watched};
    };
    return {.motors = {motor(roll), motor(pitch)}};
  }

  // Of its motor, behind the body's four.
  robot::MotorReading Reading(std::size_t motor) const {
    return port_.last().state.motors.at(4 + motor);
  }
  double JointAngle(const char* joint) const {
    const mjModel& model = world_->physics().model();
    return world_->physics().data().qpos[model.jnt_qposadr[mj_name2id(&model, mjOBJ_JOINT, joint)]];
  }
  HandStatus HandOf(const Status& status) { return status.hands[0]; }
};

TEST_F(HandsTest, FollowPositionCommandsMotorByMotor) {
  port_.SendHand(0, Reach(0.5, -0.25));
  Tick(1500);
  EXPECT_NEAR(JointAngle("neck_roll_joint"), 0.5, 1e-3);
  EXPECT_NEAR(JointAngle("neck_pitch_joint"), -0.25, 1e-3);
  EXPECT_NEAR(Reading(kRoll).q, 0.5, 1e-3);
  EXPECT_NEAR(Reading(kPitch).q, -0.25, 1e-3);
}

TEST_F(HandsTest, AreShownBehindTheBody) {
  Snapshot snapshot = world_->MakeSnapshot(0);
  snapshot.parts = kPartMotors | kPartCommand;
  world_->Show(&snapshot);  // before the first tick
  port_.SendHand(0, Reach(0.5, -0.25));
  Tick(1500);
  world_->Show(&snapshot);
  ASSERT_EQ(snapshot.motors.size(), 6U);
  ASSERT_EQ(snapshot.motor_names.size(), 6U);
  EXPECT_EQ(snapshot.motor_names[4], "neck_roll_joint");
  EXPECT_NEAR(snapshot.motors[4].q, 0.5, 1e-3);
  EXPECT_NEAR(snapshot.motors[5].q, -0.25, 1e-3);
  ASSERT_EQ(snapshot.command.size(), 6U);
  EXPECT_EQ(snapshot.command[5].q, -0.25);
}

TEST_F(HandsTest, AreSaidOnceToHangWhereACommandHoldsOnlyOthers) {
  robot::RobotCommand command = Reach(0.5, 0);
  command.motors[kPitch].kp = 0;
  port_.SendHand(0, command);
  Tick();
  EXPECT_THAT(Told(EventKind::kUnheld), testing::IsEmpty()) << "kd brakes it";
  command.motors[kPitch].kd = 0;
  for (int i = 0; i < 2; ++i) {
    port_.SendHand(0, command);
    Tick();
  }
  EXPECT_THAT(Told(EventKind::kUnheld),
              testing::ElementsAre(testing::HasSubstr("/cmd: neck_pitch_joint: kp and tau")));
}

TEST_F(HandsTest, HoldWhatTheyWereLastToldWhenNobodyWatches) {
  port_.SendHand(0, Reach(0.5, 0.5));
  Tick(5000);
  EXPECT_NEAR(Reading(kPitch).q, 0.5, 1e-3);
  EXPECT_EQ(HandOf(world_->status(0)).commands.timeouts, 0U);
}

TEST_F(HandsTest, LockWhenWatchedAndCommandsStop) {
  robot::RobotCommand spin = Reach(0, 0, /*watched=*/true);
  spin.motors[kRoll] = {.enabled = true, .dq = 2, .kd = 5, .watched = true};
  port_.SendHand(0, spin);
  Tick(50);
  const double before = Reading(kRoll).dq;
  Tick(200);
  EXPECT_GT(before, 1);
  EXPECT_NEAR(Reading(kRoll).dq, 0, 1e-2);
  EXPECT_TRUE(Reading(kRoll).timed_out);
  EXPECT_FALSE(Reading(kRoll).enabled);
  EXPECT_EQ(HandOf(world_->status(0)).commands.timeouts, 1U);
}

TEST_F(HandsTest, BrakeWhenLocked) {
  robot::RobotCommand spin = Reach(0, 0);
  spin.motors[kRoll] = {.enabled = true, .dq = 2, .kd = 5};
  port_.SendHand(0, spin);
  Tick(50);
  spin.motors[kRoll].enabled = false;
  port_.SendHand(0, spin);
  Tick(4);
  EXPECT_FALSE(Reading(kRoll).enabled);
  EXPECT_GT(Reading(kRoll).dq, 1);
  EXPECT_EQ(Reading(kRoll).tau, -Reading(kRoll).dq);
}

TEST_F(HandsTest, GiveNoMoreTorqueThanTheirMotorsHave) {
  robot::RobotCommand command = Reach(0, 0);
  command.motors[kPitch].tau = 100;
  port_.SendHand(0, command);
  Tick();
  EXPECT_EQ(Reading(kPitch).tau, 5);
}

TEST_F(HandsTest, FollowAsLateAsTheBody) {
  config_.robots[0].spec.dynamics.delay = 0.002;
  port_.TellEvery(1);
  StartAs("clamped");
  robot::RobotCommand command = Reach(0, 0);
  command.motors[kPitch].tau = 3;
  port_.SendHand(0, command);
  Tick(2);
  EXPECT_NEAR(Reading(kPitch).tau, 0, 1e-3);
  EXPECT_FALSE(Reading(kPitch).enabled);
  Tick();
  EXPECT_NEAR(Reading(kPitch).tau, 3, 1e-2);
  EXPECT_TRUE(Reading(kPitch).enabled);
}

// 5 N·m are 2.5 W, which are 0.5 °C over the casing in the end, with a time constant of 10 s.
TEST_F(HandsTest, WarmByTheTorqueThatTheyGive) {
  port_.SendHand(0, {.motors = {{.enabled = true}, {.enabled = true, .tau = 100}}});
  Tick(250);
  EXPECT_NEAR(Reading(kPitch).winding_c, 25 + 0.5 * (1 - std::exp(-0.02)), 2e-3);
  EXPECT_GT(Reading(kPitch).casing_c, 25);
  EXPECT_NEAR(Reading(kRoll).winding_c, 25, 1e-4);
}

// 5 N·m each, from rest, are 5 W of heat at 40 V or less.
TEST_F(HandsTest, DrawFromTheBattery) {
  port_.TellEvery(1);
  Tick();
  const double idle = port_.last().state.battery.current;
  port_.SendHand(0, {.motors = {2, {.enabled = true, .tau = 100}}});
  Tick();
  EXPECT_LT(port_.last().state.battery.current, idle - 0.12);
}

TEST_F(HandsTest, OfAServiceBrakeWhileItsProgramIsDeadAndAreLockedWhenItComesBack) {
  config_.robots[0].spec.hands[0].law = "dex1";
  StartAs("clamped");
  port_.SendHand(0, Reach(0.5, 0.5, /*watched=*/true));
  Tick(20);
  ASSERT_TRUE(Reading(kPitch).enabled);
  Ask("fault", {{"component", "hand.neck"}, {"fault", "off"}, {"for", 0.01}});
  Tick(20);
  EXPECT_FALSE(Reading(kPitch).enabled) << "it has started anew";
  EXPECT_THAT(Told(EventKind::kFault),
              testing::ElementsAre(testing::HasSubstr("hand.neck is off"),
                                   testing::HasSubstr("hand.neck is no longer off")));
}

TEST_F(HandsTest, HearNothingWhileRobotStateHasTheirProgramSwitchedOff) {
  robot::RobotSpec& spec = config_.robots[0].spec;
  spec.hands[0].name = "left";
  spec.services = {{.name = "dex3_service_l"}, {.name = "dex3_service_r"}};
  StartAs("clamped");
  const auto hears_after = [this](const char* program, bool on) {
    services_.Call([=](authority::MotorOwner* owner) { owner->Switch(program, on); });
    Tick(2);
    const std::uint64_t before = world_->status(0).hands[0].commands.accepted;
    port_.SendHand(0, Reach(0.5, 0.5));
    Tick(2);
    return world_->status(0).hands[0].commands.accepted > before;
  };
  EXPECT_TRUE(hears_after("dex3_service_r", false)) << "the program of the other hand";
  EXPECT_FALSE(hears_after("dex3_service_l", false));
  EXPECT_TRUE(Reading(kPitch).enabled) << "it holds";
  EXPECT_TRUE(hears_after("dex3_service_l", true));
}

TEST_F(HandsTest, AreLockedAgainAfterAReset) {
  port_.SendHand(0, Reach(0.5, 0.5));
  Tick(500);
  Ask("reset");
  Tick(5);
  EXPECT_NEAR(Reading(kPitch).q, 0, 1e-6);
  EXPECT_FALSE(Reading(kPitch).enabled);
}

TEST_F(HandsTest, CountRefusalsByReasonApartFromTheBodys) {
  robot::RobotCommand harm = Reach(0, 0);
  harm.motors[0].q = NAN;
  port_.SendHand(0, harm);
  port_.SendHand(0, Reach(0, 0), robot::Refusal::kMotorMode);
  port_.SendHand(0, {}, robot::Refusal::kMotorCount);
  port_.SendHand(0, Reach(0, 0));
  Tick();
  const Status status = world_->status(0);
  const HandStatus hand = HandOf(status);
  EXPECT_STREQ(hand.name.data(), "neck");
  EXPECT_EQ(hand.commands.accepted, 1U);
  for (const robot::Refusal refusal :
       {robot::Refusal::kNotFinite, robot::Refusal::kMotorMode, robot::Refusal::kMotorCount}) {
    EXPECT_EQ(hand.commands.refused[static_cast<std::size_t>(refusal)], 1U) << robot::Name(refusal);
  }
  const std::vector<std::string> told = Told(EventKind::kRefused);
  ASSERT_EQ(told.size(), 3U);
  EXPECT_THAT(told[2], testing::HasSubstr("/cmd (motor_count)"));
  EXPECT_THAT(status.commands.refused, testing::Each(0U));
  EXPECT_EQ(status.hands[1].name[0], '\0');
}

// rt/lowcmd does not reach a hand, nor a hand's command the body.
TEST_F(HandsTest, AndBodyDoNotMoveEachOthersMotors) {
  robot::RobotCommand body;
  body.motors.assign(4, {.enabled = true, .q = 0.3, .kp = 100, .kd = 5});
  port_.Send(body);
  Tick(150);
  EXPECT_NEAR(Reading(kPitch).q, 0, 0.02);
  EXPECT_NEAR(port_.last().state.motors[0].q, 0.3, 0.1);
}

}  // namespace
}  // namespace understudy::emulator
