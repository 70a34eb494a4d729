// Hands in whole ticks: of the fixture robot's neck a hand is made.
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

constexpr int kRoll = 0;  // its motors, the other way round than the model's joints
constexpr int kPitch = 1;

class HandsTest : public EmulatorTest {
 protected:
  HandsTest() {
    robot::RobotSpec& robot = config_.robot;
    robot.motors.resize(4);
    robot.parallel.clear();
    for (robot::PoseSpec* pose : {&robot.lying, &robot.standing, &robot.hanging}) pose->q.resize(4);
    robot.hands = {{.name = "neck",
                    .topic = "neck",
                    .motors = {{.joint = "neck_roll_joint", .torque_limit = 5},
                               {.joint = "neck_pitch_joint", .torque_limit = 5}},
                    .timeout = 0.1,
                    .lock_kd = 1}};
    StartAs("clamped");
  }

  // Both motors to these angles.
  static robot::RobotCommand Reach(double roll, double pitch, bool watched = false) {
    const auto motor = [watched](double q) -> robot::MotorCommand {
      return {.enabled = true, .q = q, .kp = 20, .kd = 1, .watched = watched};
    };
    return {.motors = {motor(roll), motor(pitch)}};
  }

  robot::HandReading Reading() const { return port_.last().state.hands.at(0); }
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
  EXPECT_NEAR(Reading().motors[kRoll].q, 0.5, 1e-3);
  EXPECT_NEAR(Reading().motors[kPitch].q, -0.25, 1e-3);
}

TEST_F(HandsTest, AreShownBehindTheBody) {
  Frame frame = world_->MakeFrame();
  frame.parts = kPartMotors | kPartCommand;
  world_->Show(&frame);  // before the first tick
  port_.SendHand(0, Reach(0.5, -0.25));
  Tick(1500);
  world_->Show(&frame);
  ASSERT_EQ(frame.motors.size(), 6U);
  ASSERT_EQ(frame.motor_names.size(), 6U);
  EXPECT_EQ(frame.motor_names[4], "neck_roll_joint");
  EXPECT_NEAR(frame.motors[4].q, 0.5, 1e-3);
  EXPECT_NEAR(frame.motors[5].q, -0.25, 1e-3);
  EXPECT_EQ(frame.command.size(), 4U);
}

TEST_F(HandsTest, HoldWhatTheyWereLastToldWhenNobodyWatches) {
  port_.SendHand(0, Reach(0.5, 0.5));
  Tick(5000);
  EXPECT_NEAR(Reading().motors[kPitch].q, 0.5, 1e-3);
  EXPECT_EQ(HandOf(world_->status()).commands.timeouts, 0U);
}

TEST_F(HandsTest, LockWhenWatchedAndCommandsStop) {
  robot::RobotCommand spin = Reach(0, 0, /*watched=*/true);
  spin.motors[kRoll] = {.enabled = true, .dq = 2, .kd = 5, .watched = true};
  port_.SendHand(0, spin);
  Tick(50);
  const double before = Reading().motors[kRoll].dq;
  Tick(200);
  EXPECT_GT(before, 1);
  EXPECT_NEAR(Reading().motors[kRoll].dq, 0, 1e-2);
  EXPECT_EQ(Reading().timed_out[kRoll], 1);
  EXPECT_FALSE(Reading().motors[kRoll].enabled);
  EXPECT_EQ(HandOf(world_->status()).commands.timeouts, 1U);
}

TEST_F(HandsTest, BrakeWhenLocked) {
  robot::RobotCommand spin = Reach(0, 0);
  spin.motors[kRoll] = {.enabled = true, .dq = 2, .kd = 5};
  port_.SendHand(0, spin);
  Tick(50);
  spin.motors[kRoll].enabled = false;
  port_.SendHand(0, spin);
  Tick(4);
  EXPECT_FALSE(Reading().motors[kRoll].enabled);
  EXPECT_GT(Reading().motors[kRoll].dq, 1);
  EXPECT_EQ(Reading().motors[kRoll].tau, -Reading().motors[kRoll].dq);
}

TEST_F(HandsTest, GiveNoMoreTorqueThanTheirMotorsHave) {
  robot::RobotCommand command = Reach(0, 0);
  command.motors[kPitch].tau = 100;
  port_.SendHand(0, command);
  Tick();
  EXPECT_EQ(Reading().motors[kPitch].tau, 5);
}

TEST_F(HandsTest, AreLockedAgainAfterAReset) {
  port_.SendHand(0, Reach(0.5, 0.5));
  Tick(500);
  Ask("reset");
  Tick(5);
  EXPECT_NEAR(Reading().motors[kPitch].q, 0, 1e-6);
  EXPECT_FALSE(Reading().motors[kPitch].enabled);
}

TEST_F(HandsTest, CountRefusalsByReasonApartFromTheBodys) {
  robot::RobotCommand harm = Reach(0, 0);
  harm.motors[0].q = NAN;
  port_.SendHand(0, harm);
  port_.SendHand(0, Reach(0, 0), robot::Refusal::kMotorMode);
  port_.SendHand(0, {}, robot::Refusal::kMotorCount);
  port_.SendHand(0, Reach(0, 0));
  Tick();
  const Status status = world_->status();
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
  EXPECT_NEAR(Reading().motors[kPitch].q, 0, 0.02);
  EXPECT_EQ(port_.last().state.motors.size(), 4U);
  EXPECT_NEAR(port_.last().state.motors[0].q, 0.3, 0.1);
}

}  // namespace
}  // namespace understudy::emulator
