#include "authority/hand_gate.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "authority/intake.h"

namespace understudy::authority {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

robot::HandSpec TwoMotors() {
  return {.name = "left", .motors = {{.joint = "thumb"}, {.joint = "index"}}, .timeout = 1};
}

robot::MotorCommand Torque(double tau, bool watched = false) {
  return {.enabled = true, .tau = tau, .watched = watched};
}

robot::RobotCommand Torques(double first, double second, bool watched = false) {
  return {.motors = {Torque(first, watched), Torque(second, watched)}};
}

class HandGateTest : public testing::Test {
 protected:
  robot::Refusal Offer(const robot::RobotCommand& command, double t = 0) {
    return Offer(&strict_, command, robot::Refusal::kNone, t);
  }
  robot::Refusal Offer(Intake* intake, const robot::RobotCommand& command, robot::Refusal form,
                       double t = 0) {
    return intake->Judge(form, [&] { return gate_.Offer(command, t); });
  }
  std::uint64_t Refused(robot::Refusal refusal) const {
    return strict_.counts().refused[static_cast<std::size_t>(refusal)];
  }
  bool IsLocked(std::size_t motor, double t) { return !gate_.Current(t).motors[motor].enabled; }
  bool TimedOut(std::size_t motor, double t) { return gate_.Current(t).motors[motor].timed_out; }
  // A command whose second motor is `motor`, and what comes of it.
  void ExpectRefused(const robot::MotorCommand& motor, robot::Refusal refusal) {
    ASSERT_EQ(Offer(Torques(1, 2)), robot::Refusal::kNone);
    robot::RobotCommand command = Torques(3, 4);
    command.motors[1] = motor;
    EXPECT_EQ(Offer(command), refusal);
    EXPECT_EQ(Refused(refusal), 1U);
    EXPECT_EQ(strict_.counts().accepted, 1U);
    EXPECT_EQ(gate_.Current(0).motors[0], Torque(1));
    EXPECT_EQ(gate_.Current(0).motors[1], Torque(2));
  }

  const robot::HandSpec spec_ = TwoMotors();
  HandGate gate_{spec_};
  Intake strict_{/*lenient=*/false};
  Intake lenient_{/*lenient=*/true};
};

TEST_F(HandGateTest, IsLockedUntilACommandIsTaken) {
  for (const double t : {0.0, 1e6}) {
    for (const std::size_t motor : {0U, 1U}) {
      EXPECT_TRUE(IsLocked(motor, t));
      EXPECT_FALSE(TimedOut(motor, t));
    }
  }
  EXPECT_EQ(gate_.timeouts(), 0U);
}

TEST_F(HandGateTest, FollowsTheLastTakenCommand) {
  EXPECT_EQ(Offer(Torques(1, 2)), robot::Refusal::kNone);
  EXPECT_EQ(Offer(Torques(3, 4)), robot::Refusal::kNone);
  EXPECT_EQ(gate_.Current(0).motors[0], Torque(3));
  EXPECT_EQ(gate_.Current(0).motors[1], Torque(4));
  EXPECT_FALSE(IsLocked(0, 0));
  EXPECT_EQ(strict_.counts().accepted, 2U);
}

TEST_F(HandGateTest, FollowsForEverWhatIsNotWatched) {
  Offer(Torques(1, 2));
  EXPECT_EQ(gate_.Current(1e6).motors[0], Torque(1));
  EXPECT_EQ(gate_.timeouts(), 0U);
}

TEST_F(HandGateTest, LocksTheMotorsThatACommandLocks) {
  robot::RobotCommand command = Torques(1, 2);
  command.motors[0].enabled = false;
  Offer(command);
  EXPECT_TRUE(IsLocked(0, 0));
  EXPECT_EQ(gate_.Current(0).motors[1], Torque(2));
}

TEST_F(HandGateTest, LocksWatchedMotorsWhenCommandsStop) {
  robot::RobotCommand command = Torques(1, 2);
  command.motors[1].watched = true;
  Offer(command, 5);
  EXPECT_EQ(gate_.Current(6).motors[1], Torque(2, /*watched=*/true));
  EXPECT_EQ(gate_.timeouts(), 0U);
  EXPECT_TRUE(IsLocked(1, 6.001));
  EXPECT_TRUE(TimedOut(1, 6.001));
  EXPECT_EQ(gate_.Current(6.001).motors[0], Torque(1));
}

TEST_F(HandGateTest, CountsAStopOnceForAllMotors) {
  Offer(Torques(1, 2, /*watched=*/true), 0);
  for (const double t : {1.1, 1.2, 30.0}) gate_.Current(t);
  EXPECT_EQ(gate_.timeouts(), 1U);
}

TEST_F(HandGateTest, DoesNotStopWhileCommandsCome) {
  for (const double t : {0.0, 0.9, 1.8, 2.7}) {
    gate_.Current(t);
    Offer(Torques(t, 0, /*watched=*/true), t);
  }
  EXPECT_EQ(gate_.Current(3.6).motors[0], Torque(2.7, /*watched=*/true));
}

TEST_F(HandGateTest, RefusedCommandsDoNotKeepItFromStopping) {
  Offer(Torques(1, 2, /*watched=*/true), 0);
  Offer(Torques(kNan, 2, /*watched=*/true), 0.9);
  EXPECT_TRUE(IsLocked(0, 1.1));
}

TEST_F(HandGateTest, GoesOnWithTheNextCommandAlsoOneThatHasItWatched) {
  Offer(Torques(1, 2, /*watched=*/true), 0);
  gate_.Current(2);
  EXPECT_TRUE(TimedOut(0, 2));
  EXPECT_EQ(Offer(Torques(3, 4, /*watched=*/true), 2), robot::Refusal::kNone);
  EXPECT_EQ(gate_.Current(2).motors[0], Torque(3, /*watched=*/true));
  EXPECT_TRUE(TimedOut(0, 3.1));
  EXPECT_EQ(Offer(Torques(5, 6), 3.2), robot::Refusal::kNone);
  EXPECT_EQ(gate_.Current(3.2).motors[0], Torque(5));
}

TEST_F(HandGateTest, IsAsBeforeTheFirstCommandAfterARestart) {
  Offer(Torques(1, 2, /*watched=*/true), 0);
  gate_.Current(2);
  gate_.Restart();
  EXPECT_TRUE(IsLocked(0, 2));
  EXPECT_FALSE(TimedOut(0, 2));
  EXPECT_TRUE(IsLocked(1, 30));
  EXPECT_EQ(gate_.timeouts(), 1U);
  EXPECT_EQ(strict_.counts().accepted, 1U);
}

TEST_F(HandGateTest, OfADex3GoesOnAcrossADeathOfItsProgram) {
  Offer(Torques(1, 2));
  gate_.SetRunning(false, 1);
  EXPECT_EQ(gate_.Current(9).motors[0], Torque(1));
  gate_.SetRunning(true, 10);
  EXPECT_EQ(gate_.Current(10).motors[0], Torque(1));
}

TEST_F(HandGateTest, OfADex1BrakesOnceItsProgramIsSilentAndUntilACommandToTheNextOne) {
  robot::HandSpec spec = TwoMotors();
  spec.law = "dex1";
  HandGate gate(spec);
  gate.Offer(Torques(1, 2, /*watched=*/true), 0);
  gate.SetRunning(false, 0.5);
  EXPECT_TRUE(gate.Current(0.9).motors[0].enabled);
  EXPECT_FALSE(gate.Current(1.1).motors[0].enabled);
  gate.Offer(Torques(1, 2, /*watched=*/true), 2);
  gate.SetRunning(true, 2.1);
  EXPECT_FALSE(gate.Current(2.2).motors[0].enabled) << "it starts braked";
  gate.Offer(Torques(1, 2, /*watched=*/true), 3);
  gate.SetRunning(true, 3);
  EXPECT_TRUE(gate.Current(3.1).motors[0].enabled) << "it goes on running";
}

TEST_F(HandGateTest, RefusesAnAngleThatIsNoNumber) {
  ExpectRefused({.enabled = true, .q = kNan}, robot::Refusal::kNotFinite);
}

TEST_F(HandGateTest, RefusesATorqueThatIsNotFinite) {
  ExpectRefused({.enabled = true, .tau = std::numeric_limits<double>::infinity()},
                robot::Refusal::kNotFinite);
}

TEST_F(HandGateTest, RefusesHarmToALockedMotor) {
  ExpectRefused({.enabled = false, .kp = kNan}, robot::Refusal::kNotFinite);
}

TEST_F(HandGateTest, RefusesANegativeGain) {
  ExpectRefused({.enabled = true, .kd = -1}, robot::Refusal::kGain);
}

TEST_F(HandGateTest, RefusesWhatThePortFoundWrong) {
  EXPECT_EQ(Offer(&strict_, Torques(1, 2), robot::Refusal::kMotorMode), robot::Refusal::kMotorMode);
  EXPECT_EQ(Refused(robot::Refusal::kMotorMode), 1U);
  EXPECT_TRUE(IsLocked(0, 0));
}

TEST_F(HandGateTest, RefusesACommandForAnotherNumberOfMotors) {
  robot::RobotCommand command = Torques(1, 2);
  command.motors.pop_back();
  EXPECT_EQ(Offer(command), robot::Refusal::kMotorCount);
  EXPECT_EQ(Refused(robot::Refusal::kMotorCount), 1U);
}

TEST_F(HandGateTest, LenientTakesAWrongModeAndCountsIt) {
  EXPECT_EQ(Offer(&lenient_, Torques(1, 2), robot::Refusal::kMotorMode), robot::Refusal::kNone);
  EXPECT_EQ(lenient_.counts().refused[static_cast<std::size_t>(robot::Refusal::kMotorMode)], 1U);
  EXPECT_EQ(gate_.Current(0).motors[0], Torque(1));
}

TEST_F(HandGateTest, LenientRefusesAWrongCountAndHarmAllTheSame) {
  EXPECT_EQ(Offer(&lenient_, Torques(1, 2), robot::Refusal::kMotorCount),
            robot::Refusal::kMotorCount);
  EXPECT_EQ(Offer(&lenient_, Torques(kNan, 2), robot::Refusal::kMotorMode),
            robot::Refusal::kNotFinite);
  EXPECT_TRUE(IsLocked(0, 0));
}

// A hand of two motors that its own controllers lead to goals, at 2 rad/s at most.
class GoalHandTest : public testing::Test {
 protected:
  static robot::HandSpec Hand(const std::string& law) {
    robot::HandSpec spec{.name = "left", .law = law, .timeout = 1};
    for (const char* joint : {"thumb", "index"}) {
      spec.motors.push_back(
          {.joint = joint, .knee_speed = 2, .hold_kp = 8, .hold_kd = 0.2, .span = {1, 0}});
    }
    return spec;
  }
  static robot::RobotCommand Goal(double q, double speed = 0) {
    return {.motors = {{.enabled = true, .q = q, .dq = speed, .tau = 9, .kp = 9, .kd = 9},
                       {.enabled = true, .q = -q, .dq = speed}}};
  }
};

TEST_F(GoalHandTest, AnInspireIsLedAtFullSpeedByItsOwnGainsAndStaysThere) {
  HandGate gate(Hand("inspire"));
  EXPECT_FALSE(gate.Current(0).motors[0].enabled);
  ASSERT_EQ(gate.Offer(Goal(1), 10), robot::Refusal::kNone);
  EXPECT_EQ(gate.Current(10).motors[0].q, 0);
  EXPECT_EQ(gate.Current(10.25).motors[0],
            (robot::MotorCommand{.enabled = true, .q = 0.5, .dq = 2, .kp = 8, .kd = 0.2}));
  EXPECT_EQ(gate.Current(10.25).motors[1].q, -0.5);
  EXPECT_EQ(gate.Current(10.25).motors[1].dq, -2);
  EXPECT_EQ(gate.Current(1000).motors[0],
            (robot::MotorCommand{.enabled = true, .q = 1, .kp = 8, .kd = 0.2}));
  EXPECT_EQ(gate.timeouts(), 0U);
}

TEST_F(GoalHandTest, ANewGoalTakesOverFromWhereTheOldOneHasLed) {
  HandGate gate(Hand("inspire"));
  ASSERT_EQ(gate.Offer(Goal(1), 0), robot::Refusal::kNone);
  ASSERT_EQ(gate.Offer(Goal(0), 0.25), robot::Refusal::kNone);
  EXPECT_EQ(gate.Current(0.25).motors[0].q, 0.5);
  EXPECT_EQ(gate.Current(0.375).motors[0].q, 0.25);
  EXPECT_EQ(gate.Current(9).motors[0].q, 0);
}

TEST_F(GoalHandTest, ARevo2MovesAtTheSpeedOfItsCommandAndNeverAtSpeedZero) {
  HandGate gate(Hand("brainco"));
  ASSERT_EQ(gate.Offer(Goal(0, 2), 0), robot::Refusal::kNone);
  EXPECT_EQ(gate.Current(10).motors[0].q, 0);
  ASSERT_EQ(gate.Offer(Goal(1, 0.5), 10), robot::Refusal::kNone);
  EXPECT_EQ(gate.Current(11).motors[0].q, 0.5);
  ASSERT_EQ(gate.Offer(Goal(1, 0), 11), robot::Refusal::kNone);
  EXPECT_EQ(gate.Current(99).motors[0].q, 0.5);
}

TEST_F(GoalHandTest, ARevo2GoesToZeroBeforeTheFirstCommandAndAfterARestart) {
  HandGate gate(Hand("brainco"));
  EXPECT_TRUE(gate.Current(0).motors[0].enabled);
  EXPECT_EQ(gate.Current(5).motors[0].q, 1) << "the angle of q 0";
  ASSERT_EQ(gate.Offer(Goal(0, 2), 5), robot::Refusal::kNone);
  EXPECT_EQ(gate.Current(9).motors[0].q, 0);
  gate.Restart();
  EXPECT_EQ(gate.Current(9).motors[0].q, 1);
}

// A command to registers: these for the first motor, nothing for the second.
robot::RobotCommand Registers(double q, double speed, double force) {
  return {
      .motors = {{.enabled = true, .q = q, .dq = speed, .tau = force},
                 {.enabled = true, .q = robot::kNoPosition, .dq = robot::kNoVelocity, .tau = -1}}};
}

TEST_F(GoalHandTest, AnFtpKeepsEachRegisterUntilACommandHasAnother) {
  HandGate gate(Hand("inspire_ftp"));
  ASSERT_EQ(gate.Offer(Registers(robot::kNoPosition, 1, 3), 0), robot::Refusal::kNone);
  EXPECT_FALSE(gate.Current(1).motors[0].enabled) << "it has no goal yet";
  ASSERT_EQ(gate.Offer(Registers(1, robot::kNoVelocity, -1), 1), robot::Refusal::kNone);
  EXPECT_EQ(
      gate.Current(1.5).motors[0],
      (robot::MotorCommand{.enabled = true, .q = 0.5, .dq = 1, .kp = 8, .kd = 0.2, .most = 3}));
  ASSERT_EQ(gate.Offer(Registers(robot::kNoPosition, 0.5, -1), 1.5), robot::Refusal::kNone);
  EXPECT_EQ(gate.Current(2).motors[0].q, 0.75) << "on to the same goal, slower";
  EXPECT_EQ(gate.Current(99).motors[0].q, 1);
  EXPECT_EQ(gate.Current(99).motors[0].most, 3);
  EXPECT_FALSE(gate.Current(99).motors[1].enabled);
}

TEST_F(GoalHandTest, AnFtpBeginsAtFullSpeedAndForceAlsoAfterARestart) {
  HandGate gate(Hand("inspire_ftp"));
  for (const double t : {0.0, 10.0}) {
    ASSERT_EQ(gate.Offer(Registers(1, robot::kNoVelocity, -1), t), robot::Refusal::kNone);
    EXPECT_EQ(gate.Current(t + 0.25).motors[0].q, 0.5);
    EXPECT_EQ(gate.Current(t + 0.25).motors[0].most, robot::MotorCommand{}.most);
    ASSERT_EQ(gate.Offer(Registers(0, 0, 0), t + 1), robot::Refusal::kNone);
    EXPECT_EQ(gate.Current(t + 2).motors[0].q, 1) << "speed 0";
    gate.Restart();
  }
}

TEST_F(GoalHandTest, AnInspireReachesItsLastGoalAndStaysThereWhenItsProgramDiesAndComesBack) {
  HandGate gate(Hand("inspire"));
  ASSERT_EQ(gate.Offer(Goal(1), 0), robot::Refusal::kNone);
  gate.SetRunning(false, 0.25);
  EXPECT_EQ(gate.Current(9).motors[0].q, 1);
  gate.SetRunning(true, 10);
  EXPECT_EQ(gate.Current(20).motors[0].q, 1);
}

TEST_F(GoalHandTest, ARevo2GoesToZeroAtFullSpeedWhenItsProgramComesBack) {
  HandGate gate(Hand("brainco"));
  ASSERT_EQ(gate.Offer(Goal(0, 2), 0), robot::Refusal::kNone);
  gate.SetRunning(false, 5);
  EXPECT_EQ(gate.Current(9).motors[0].q, 0);
  gate.SetRunning(true, 10);
  EXPECT_EQ(gate.Current(10.25).motors[0].q, 0.5);
  gate.SetRunning(true, 10.5);
  EXPECT_EQ(gate.Current(20).motors[0].q, 1) << "the angle of q 0";
}

TEST_F(GoalHandTest, RefusesWhatIsNotFiniteAndGoesOn) {
  HandGate gate(Hand("inspire"));
  ASSERT_EQ(gate.Offer(Goal(1), 0), robot::Refusal::kNone);
  EXPECT_EQ(gate.Offer(Goal(kNan), 0.25), robot::Refusal::kNotFinite);
  EXPECT_EQ(gate.Current(0.25).motors[0].q, 0.5);
}

}  // namespace
}  // namespace understudy::authority
