#include "authority/command_gate.h"

#include <limits>

#include <gtest/gtest.h>

#include "authority/intake.h"

namespace understudy::authority {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

robot::RobotCommand Torques(double first, double second) {
  robot::RobotCommand command;
  command.motors = {{.enabled = true, .tau = first}, {.enabled = true, .tau = second}};
  return command;
}

// A gate and what comes before it.
struct Entrance {
  robot::Refusal Offer(const robot::RobotCommand& command, robot::Refusal form, double t) {
    return intake.Judge(form, [&] { return gate.Offer(command, t); });
  }

  CommandGate gate;
  Intake intake;
};

std::uint64_t Refused(const Entrance& to, robot::Refusal refusal) {
  return to.intake.counts().refused[static_cast<std::size_t>(refusal)];
}

std::uint64_t RefusedInAll(const Entrance& to) {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : to.intake.counts().refused) sum += count;
  return sum;
}

class CommandGateTest : public testing::Test {
 protected:
  const robot::RobotCommand start_ = Torques(-1, -2);
  const GateConfig config_{.timeout = 0.2, .damping_kd = 3};
  Entrance strict_{CommandGate(config_, start_), Intake(/*lenient=*/false)};
  Entrance lenient_{CommandGate(config_, start_), Intake(/*lenient=*/true)};
  CommandGate& gate_ = strict_.gate;
};

TEST_F(CommandGateTest, FollowsTheStartCommandUntilOneIsTaken) {
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.Current(0).motors, start_.motors);
  EXPECT_EQ(gate_.Current(1e6).motors, start_.motors);
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.timeouts(), 0U);
}

TEST_F(CommandGateTest, RefusesACommandToAnotherNumberOfMotors) {
  robot::RobotCommand command = Torques(5, 6);
  command.motors.emplace_back();
  EXPECT_EQ(lenient_.gate.Offer(command, 1), robot::Refusal::kMotorCount);
  command.motors.resize(1);
  EXPECT_EQ(lenient_.gate.Offer(command, 1), robot::Refusal::kMotorCount);
  EXPECT_EQ(lenient_.gate.Current(1).motors, start_.motors);
}

TEST_F(CommandGateTest, RefusesEveryCommandWhileClosedAndSaysWhatIsWrongWithIt) {
  gate_.Close();
  EXPECT_EQ(strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 1), robot::Refusal::kMotionService);
  EXPECT_EQ(strict_.Offer(Torques(5, 6), robot::Refusal::kCrc, 1), robot::Refusal::kCrc);
  EXPECT_EQ(strict_.Offer(Torques(kNan, 6), robot::Refusal::kNone, 1), robot::Refusal::kNotFinite);
  EXPECT_EQ(gate_.state(), GateState::kClosed);
  EXPECT_EQ(Refused(strict_, robot::Refusal::kMotionService), 1U);
  EXPECT_EQ(RefusedInAll(strict_), 3U);
  EXPECT_EQ(strict_.intake.counts().accepted, 0U);
}

TEST_F(CommandGateTest, RefusesWhileClosedThoughLenient) {
  lenient_.gate.Close();
  EXPECT_EQ(lenient_.Offer(Torques(5, 6), robot::Refusal::kCrc, 1), robot::Refusal::kMotionService);
}

TEST_F(CommandGateTest, RestsInDampingOrLimpUntilACommandIsTaken) {
  gate_.Close();
  gate_.OpenPassive();
  EXPECT_EQ(gate_.state(), GateState::kDamping);
  EXPECT_EQ(gate_.Current(1).motors, DampingCommand(2, 3).motors);
  gate_.OpenPassive(/*limp=*/true);
  EXPECT_EQ(gate_.state(), GateState::kLimp);
  for (const robot::MotorCommand& motor : gate_.Current(1).motors) EXPECT_FALSE(motor.enabled);
  EXPECT_EQ(gate_.timeouts(), 0U);
  EXPECT_EQ(strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 1), robot::Refusal::kNone);
  EXPECT_EQ(gate_.Current(1).motors, Torques(5, 6).motors);
}

TEST_F(CommandGateTest, FollowsATakenCommandAtOnce) {
  EXPECT_EQ(strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 1), robot::Refusal::kNone);
  EXPECT_EQ(gate_.Current(1).motors, Torques(5, 6).motors);
  EXPECT_EQ(gate_.state(), GateState::kFollowing);
  EXPECT_EQ(strict_.intake.counts().accepted, 1U);
}

TEST_F(CommandGateTest, FollowsTheLastOfSeveral) {
  strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 1);
  strict_.Offer(Torques(7, 8), robot::Refusal::kNone, 1);
  EXPECT_EQ(gate_.Current(1).motors, Torques(7, 8).motors);
  EXPECT_EQ(strict_.intake.counts().accepted, 2U);
}

TEST_F(CommandGateTest, KeepsTheJointSpaceOfTheCommand) {
  robot::RobotCommand command = Torques(5, 6);
  command.motors[1].space = robot::JointSpace::kMotors;
  strict_.Offer(command, robot::Refusal::kNone, 0);
  EXPECT_EQ(gate_.Current(0).motors, command.motors);
}

TEST_F(CommandGateTest, GoesToDampingWhenCommandsStop) {
  strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 1);
  EXPECT_EQ(gate_.Current(1.199).motors, Torques(5, 6).motors);
  EXPECT_EQ(gate_.timeouts(), 0U);
  for (const robot::MotorCommand& motor : gate_.Current(1.201).motors) {
    EXPECT_EQ(motor, (robot::MotorCommand{.enabled = true, .q = robot::kNoPosition, .kd = 3}));
  }
  EXPECT_EQ(gate_.state(), GateState::kDamping);
  EXPECT_EQ(gate_.Current(1.3).motors.size(), 2U);
}

TEST_F(CommandGateTest, CountsAStopOfCommandsOnce) {
  strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 0);
  gate_.Current(1);
  gate_.Current(2);
  EXPECT_EQ(gate_.timeouts(), 1U);
}

TEST_F(CommandGateTest, FollowsAgainWhenCommandsResume) {
  strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 0);
  gate_.Current(1);
  strict_.Offer(Torques(7, 8), robot::Refusal::kNone, 1);
  EXPECT_EQ(gate_.Current(1).motors, Torques(7, 8).motors);
  EXPECT_EQ(gate_.state(), GateState::kFollowing);
  gate_.Current(2);
  EXPECT_EQ(gate_.timeouts(), 2U);
}

TEST_F(CommandGateTest, StaysFreshWhileCommandsCome) {
  for (int i = 0; i < 100; ++i) {
    strict_.Offer(Torques(i, i), robot::Refusal::kNone, 0.1 * i);
    EXPECT_EQ(gate_.Current(0.1 * i).motors, Torques(i, i).motors);
  }
  EXPECT_EQ(gate_.timeouts(), 0U);
}

TEST_F(CommandGateTest, ChangesNothingForARefusedCommand) {
  strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 0);
  EXPECT_EQ(strict_.Offer(Torques(7, 8), robot::Refusal::kCrc, 0.15), robot::Refusal::kCrc);
  EXPECT_EQ(gate_.Current(0.15).motors, Torques(5, 6).motors);
  // Nor does it keep the one before it fresh.
  gate_.Current(0.25);
  EXPECT_EQ(gate_.state(), GateState::kDamping);
}

TEST_F(CommandGateTest, StaysAtTheStartWhenTheFirstCommandIsRefused) {
  strict_.Offer(Torques(7, 8), robot::Refusal::kHead, 0);
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.Current(1).motors, start_.motors);
  EXPECT_EQ(strict_.intake.counts().accepted, 0U);
}

TEST_F(CommandGateTest, StaysDampedWhenARefusedCommandEndsTheSilence) {
  strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 0);
  gate_.Current(1);
  strict_.Offer(Torques(7, 8), robot::Refusal::kCrc, 1);
  gate_.Current(1);
  EXPECT_EQ(gate_.state(), GateState::kDamping);
}

TEST_F(CommandGateTest, CountsRefusalsByReason) {
  for (const robot::Refusal wire :
       {robot::Refusal::kCrc, robot::Refusal::kHead, robot::Refusal::kHead,
        robot::Refusal::kModeMachine, robot::Refusal::kModePr, robot::Refusal::kMotorMode}) {
    EXPECT_EQ(strict_.Offer(start_, wire, 0), wire);
  }
  strict_.Offer(Torques(kNan, 0), robot::Refusal::kNone, 0);
  robot::RobotCommand pushing = Torques(0, 0);
  pushing.motors[1].kp = -1;
  strict_.Offer(pushing, robot::Refusal::kNone, 0);

  EXPECT_EQ(Refused(strict_, robot::Refusal::kHead), 2U);
  for (const robot::Refusal once :
       {robot::Refusal::kCrc, robot::Refusal::kModeMachine, robot::Refusal::kModePr,
        robot::Refusal::kMotorMode, robot::Refusal::kNotFinite, robot::Refusal::kGain}) {
    EXPECT_EQ(Refused(strict_, once), 1U) << robot::Name(once);
  }
  EXPECT_EQ(Refused(strict_, robot::Refusal::kNone), 0U);
  EXPECT_EQ(strict_.intake.counts().accepted, 0U);
}

TEST_F(CommandGateTest, CountsACommandThatIsWrongTwiceOnce) {
  EXPECT_EQ(strict_.Offer(Torques(kNan, 0), robot::Refusal::kCrc, 0), robot::Refusal::kCrc);
  EXPECT_EQ(RefusedInAll(strict_), 1U);
}

TEST_F(CommandGateTest, LenientTakesWrongFormAndCountsIt) {
  for (const robot::Refusal wire :
       {robot::Refusal::kCrc, robot::Refusal::kHead, robot::Refusal::kModeMachine,
        robot::Refusal::kModePr, robot::Refusal::kMotorMode}) {
    EXPECT_EQ(lenient_.Offer(Torques(5, 6), wire, 0), robot::Refusal::kNone) << robot::Name(wire);
    EXPECT_EQ(Refused(lenient_, wire), 1U);
  }
  EXPECT_EQ(lenient_.intake.counts().accepted, 5U);
  EXPECT_EQ(lenient_.gate.Current(0).motors, Torques(5, 6).motors);
}

// One bad field of one motor refuses the whole command, lenient or not.
class HarmTest : public CommandGateTest, public testing::WithParamInterface<robot::MotorCommand> {};

TEST_P(HarmTest, IsRefusedInAnyCase) {
  robot::RobotCommand command = Torques(0, 0);
  command.motors[1] = GetParam();
  for (Entrance* to : {&strict_, &lenient_}) {
    const robot::Refusal refusal = to->Offer(command, robot::Refusal::kNone, 0);
    EXPECT_TRUE(refusal == robot::Refusal::kNotFinite || refusal == robot::Refusal::kGain)
        << robot::Name(refusal);
    EXPECT_EQ(to->gate.Current(0).motors, start_.motors);
  }
  EXPECT_NE(lenient_.Offer(command, robot::Refusal::kCrc, 0), robot::Refusal::kNone);
  EXPECT_EQ(lenient_.gate.state(), GateState::kStart);
}

INSTANTIATE_TEST_SUITE_P(
    Fields, HarmTest,
    testing::Values(robot::MotorCommand{.q = kNan}, robot::MotorCommand{.dq = kNan},
                    robot::MotorCommand{.tau = kNan}, robot::MotorCommand{.kp = kNan},
                    robot::MotorCommand{.kd = kNan}, robot::MotorCommand{.q = kInfinity},
                    robot::MotorCommand{.dq = -kInfinity}, robot::MotorCommand{.tau = kInfinity},
                    robot::MotorCommand{.kp = kInfinity}, robot::MotorCommand{.kd = kInfinity},
                    robot::MotorCommand{.kp = -0.001}, robot::MotorCommand{.kd = -0.001}));

TEST_F(CommandGateTest, TakesTheMarksForNoPositionAndNoVelocity) {
  robot::RobotCommand command = Torques(0, 0);
  command.motors[0].q = robot::kNoPosition;
  command.motors[0].dq = robot::kNoVelocity;
  EXPECT_EQ(strict_.Offer(command, robot::Refusal::kNone, 0), robot::Refusal::kNone);
}

TEST_F(CommandGateTest, RestartsAtTheStartCommandAndKeepsItsCounts) {
  strict_.Offer(Torques(5, 6), robot::Refusal::kNone, 0);
  strict_.Offer(Torques(5, 6), robot::Refusal::kCrc, 0);
  gate_.Restart();
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.Current(10).motors, start_.motors);
  EXPECT_EQ(strict_.intake.counts().accepted, 1U);
  EXPECT_EQ(Refused(strict_, robot::Refusal::kCrc), 1U);
  EXPECT_EQ(gate_.timeouts(), 0U);
}

TEST_F(CommandGateTest, RestartsAtAnotherStartCommandAndKeepsToIt) {
  gate_.Restart(Torques(7, 8));
  EXPECT_EQ(gate_.Current(0).motors, Torques(7, 8).motors);
  gate_.Restart();
  EXPECT_EQ(gate_.Current(0).motors, Torques(7, 8).motors);
}

TEST(DampingCommandTest, BrakesEveryMotorAndHoldsNone) {
  const robot::RobotCommand command = DampingCommand(3, 2);
  ASSERT_EQ(command.motors.size(), 3U);
  for (const robot::MotorCommand& motor : command.motors) {
    EXPECT_EQ(motor, (robot::MotorCommand{.enabled = true, .q = robot::kNoPosition, .kd = 2}));
  }
}

TEST(RefusalTest, HasAWordForEveryReason) {
  for (std::size_t i = 0; i < robot::kRefusals; ++i) {
    EXPECT_FALSE(robot::Name(static_cast<robot::Refusal>(i)).empty()) << i;
  }
  EXPECT_EQ(robot::Name(robot::Refusal::kGain), "gain");
}

}  // namespace
}  // namespace understudy::authority
