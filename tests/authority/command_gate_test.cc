#include "authority/command_gate.h"

#include <limits>

#include <gtest/gtest.h>

namespace understudy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RobotCommand Torques(double first, double second) {
  RobotCommand command;
  command.motors = {{.enabled = true, .tau = first}, {.enabled = true, .tau = second}};
  return command;
}

std::uint64_t Refused(const CommandGate& gate, Refusal refusal) {
  return gate.counts().refused[static_cast<std::size_t>(refusal)];
}

std::uint64_t RefusedInAll(const CommandGate& gate) {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : gate.counts().refused) sum += count;
  return sum;
}

class CommandGateTest : public testing::Test {
 protected:
  const RobotCommand start_ = Torques(-1, -2);
  CommandGate gate_{GateConfig{.timeout = 0.2, .damping_kd = 3}, start_};
  CommandGate lenient_{GateConfig{.lenient = true, .timeout = 0.2, .damping_kd = 3}, start_};
};

TEST_F(CommandGateTest, FollowsTheStartCommandUntilOneIsTaken) {
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.Current(0).motors, start_.motors);
  EXPECT_EQ(gate_.Current(1e6).motors, start_.motors);
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.counts().timeouts, 0U);
}

TEST_F(CommandGateTest, RefusesEveryCommandWhileClosedAndSaysWhatIsWrongWithIt) {
  gate_.Close();
  EXPECT_EQ(gate_.Offer(Torques(5, 6), Refusal::kNone, 1), Refusal::kMotionService);
  EXPECT_EQ(gate_.Offer(Torques(5, 6), Refusal::kCrc, 1), Refusal::kCrc);
  EXPECT_EQ(gate_.Offer(Torques(kNan, 6), Refusal::kNone, 1), Refusal::kNotFinite);
  EXPECT_EQ(gate_.state(), GateState::kClosed);
  EXPECT_EQ(Refused(gate_, Refusal::kMotionService), 1U);
  EXPECT_EQ(RefusedInAll(gate_), 3U);
  EXPECT_EQ(gate_.counts().accepted, 0U);
}

TEST_F(CommandGateTest, RefusesWhileClosedThoughLenient) {
  lenient_.Close();
  EXPECT_EQ(lenient_.Offer(Torques(5, 6), Refusal::kCrc, 1), Refusal::kMotionService);
}

TEST_F(CommandGateTest, RestsInDampingOrLimpUntilACommandIsTaken) {
  gate_.Close();
  gate_.Rest();
  EXPECT_EQ(gate_.state(), GateState::kDamping);
  EXPECT_EQ(gate_.Current(1).motors, DampingCommand(2, 3).motors);
  gate_.Rest(/*limp=*/true);
  EXPECT_EQ(gate_.state(), GateState::kLimp);
  for (const MotorCommand& motor : gate_.Current(1).motors) EXPECT_FALSE(motor.enabled);
  EXPECT_EQ(gate_.counts().timeouts, 0U);
  EXPECT_EQ(gate_.Offer(Torques(5, 6), Refusal::kNone, 1), Refusal::kNone);
  EXPECT_EQ(gate_.Current(1).motors, Torques(5, 6).motors);
}

TEST_F(CommandGateTest, FollowsATakenCommandAtOnce) {
  EXPECT_EQ(gate_.Offer(Torques(5, 6), Refusal::kNone, 1), Refusal::kNone);
  EXPECT_EQ(gate_.Current(1).motors, Torques(5, 6).motors);
  EXPECT_EQ(gate_.state(), GateState::kFollowing);
  EXPECT_EQ(gate_.counts().accepted, 1U);
}

TEST_F(CommandGateTest, FollowsTheLastOfSeveral) {
  gate_.Offer(Torques(5, 6), Refusal::kNone, 1);
  gate_.Offer(Torques(7, 8), Refusal::kNone, 1);
  EXPECT_EQ(gate_.Current(1).motors, Torques(7, 8).motors);
  EXPECT_EQ(gate_.counts().accepted, 2U);
}

TEST_F(CommandGateTest, KeepsTheJointSpaceOfTheCommand) {
  RobotCommand command = Torques(5, 6);
  command.joint_space = JointSpace::kMotors;
  gate_.Offer(command, Refusal::kNone, 0);
  EXPECT_EQ(gate_.Current(0).joint_space, JointSpace::kMotors);
}

TEST_F(CommandGateTest, GoesToDampingWhenCommandsStop) {
  gate_.Offer(Torques(5, 6), Refusal::kNone, 1);
  EXPECT_EQ(gate_.Current(1.199).motors, Torques(5, 6).motors);
  EXPECT_EQ(gate_.counts().timeouts, 0U);
  for (const MotorCommand& motor : gate_.Current(1.201).motors) {
    EXPECT_EQ(motor, (MotorCommand{.enabled = true, .q = kNoPosition, .kd = 3}));
  }
  EXPECT_EQ(gate_.state(), GateState::kDamping);
  EXPECT_EQ(gate_.Current(1.3).motors.size(), 2U);
}

TEST_F(CommandGateTest, CountsAStopOfCommandsOnce) {
  gate_.Offer(Torques(5, 6), Refusal::kNone, 0);
  gate_.Current(1);
  gate_.Current(2);
  EXPECT_EQ(gate_.counts().timeouts, 1U);
}

TEST_F(CommandGateTest, FollowsAgainWhenCommandsResume) {
  gate_.Offer(Torques(5, 6), Refusal::kNone, 0);
  gate_.Current(1);
  gate_.Offer(Torques(7, 8), Refusal::kNone, 1);
  EXPECT_EQ(gate_.Current(1).motors, Torques(7, 8).motors);
  EXPECT_EQ(gate_.state(), GateState::kFollowing);
  gate_.Current(2);
  EXPECT_EQ(gate_.counts().timeouts, 2U);
}

TEST_F(CommandGateTest, StaysFreshWhileCommandsCome) {
  for (int i = 0; i < 100; ++i) {
    gate_.Offer(Torques(i, i), Refusal::kNone, 0.1 * i);
    EXPECT_EQ(gate_.Current(0.1 * i).motors, Torques(i, i).motors);
  }
  EXPECT_EQ(gate_.counts().timeouts, 0U);
}

TEST_F(CommandGateTest, ChangesNothingForARefusedCommand) {
  gate_.Offer(Torques(5, 6), Refusal::kNone, 0);
  EXPECT_EQ(gate_.Offer(Torques(7, 8), Refusal::kCrc, 0.15), Refusal::kCrc);
  EXPECT_EQ(gate_.Current(0.15).motors, Torques(5, 6).motors);
  // Nor does it keep the one before it fresh.
  gate_.Current(0.25);
  EXPECT_EQ(gate_.state(), GateState::kDamping);
}

TEST_F(CommandGateTest, StaysAtTheStartWhenTheFirstCommandIsRefused) {
  gate_.Offer(Torques(7, 8), Refusal::kHead, 0);
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.Current(1).motors, start_.motors);
  EXPECT_EQ(gate_.counts().accepted, 0U);
}

TEST_F(CommandGateTest, StaysDampedWhenARefusedCommandEndsTheSilence) {
  gate_.Offer(Torques(5, 6), Refusal::kNone, 0);
  gate_.Current(1);
  gate_.Offer(Torques(7, 8), Refusal::kCrc, 1);
  gate_.Current(1);
  EXPECT_EQ(gate_.state(), GateState::kDamping);
}

TEST_F(CommandGateTest, CountsRefusalsByReason) {
  for (const Refusal wire : {Refusal::kCrc, Refusal::kHead, Refusal::kHead, Refusal::kModeMachine,
                             Refusal::kModePr, Refusal::kMotorMode}) {
    EXPECT_EQ(gate_.Offer(start_, wire, 0), wire);
  }
  gate_.Offer(Torques(kNan, 0), Refusal::kNone, 0);
  RobotCommand pushing = Torques(0, 0);
  pushing.motors[1].kp = -1;
  gate_.Offer(pushing, Refusal::kNone, 0);

  EXPECT_EQ(Refused(gate_, Refusal::kHead), 2U);
  for (const Refusal once : {Refusal::kCrc, Refusal::kModeMachine, Refusal::kModePr,
                             Refusal::kMotorMode, Refusal::kNotFinite, Refusal::kGain}) {
    EXPECT_EQ(Refused(gate_, once), 1U) << Name(once);
  }
  EXPECT_EQ(Refused(gate_, Refusal::kNone), 0U);
  EXPECT_EQ(gate_.counts().accepted, 0U);
}

TEST_F(CommandGateTest, CountsACommandThatIsWrongTwiceOnce) {
  EXPECT_EQ(gate_.Offer(Torques(kNan, 0), Refusal::kCrc, 0), Refusal::kCrc);
  EXPECT_EQ(RefusedInAll(gate_), 1U);
}

TEST_F(CommandGateTest, LenientTakesWrongFormAndCountsIt) {
  for (const Refusal wire : {Refusal::kCrc, Refusal::kHead, Refusal::kModeMachine, Refusal::kModePr,
                             Refusal::kMotorMode}) {
    EXPECT_EQ(lenient_.Offer(Torques(5, 6), wire, 0), Refusal::kNone) << Name(wire);
    EXPECT_EQ(Refused(lenient_, wire), 1U);
  }
  EXPECT_EQ(lenient_.counts().accepted, 5U);
  EXPECT_EQ(lenient_.Current(0).motors, Torques(5, 6).motors);
}

// One bad field of one motor refuses the whole command, lenient or not.
class HarmTest : public CommandGateTest, public testing::WithParamInterface<MotorCommand> {};

TEST_P(HarmTest, IsRefusedInAnyCase) {
  RobotCommand command = Torques(0, 0);
  command.motors[1] = GetParam();
  for (CommandGate* gate : {&gate_, &lenient_}) {
    const Refusal refusal = gate->Offer(command, Refusal::kNone, 0);
    EXPECT_TRUE(refusal == Refusal::kNotFinite || refusal == Refusal::kGain) << Name(refusal);
    EXPECT_EQ(gate->Current(0).motors, start_.motors);
  }
  EXPECT_NE(lenient_.Offer(command, Refusal::kCrc, 0), Refusal::kNone);
  EXPECT_EQ(lenient_.state(), GateState::kStart);
}

INSTANTIATE_TEST_SUITE_P(Fields, HarmTest,
                         testing::Values(MotorCommand{.q = kNan}, MotorCommand{.dq = kNan},
                                         MotorCommand{.tau = kNan}, MotorCommand{.kp = kNan},
                                         MotorCommand{.kd = kNan}, MotorCommand{.q = kInfinity},
                                         MotorCommand{.dq = -kInfinity},
                                         MotorCommand{.tau = kInfinity},
                                         MotorCommand{.kp = kInfinity},
                                         MotorCommand{.kd = kInfinity}, MotorCommand{.kp = -0.001},
                                         MotorCommand{.kd = -0.001}));

TEST_F(CommandGateTest, TakesTheMarksForNoPositionAndNoVelocity) {
  RobotCommand command = Torques(0, 0);
  command.motors[0].q = kNoPosition;
  command.motors[0].dq = kNoVelocity;
  EXPECT_EQ(gate_.Offer(command, Refusal::kNone, 0), Refusal::kNone);
}

TEST_F(CommandGateTest, RestartsAtTheStartCommandAndKeepsItsCounts) {
  gate_.Offer(Torques(5, 6), Refusal::kNone, 0);
  gate_.Offer(Torques(5, 6), Refusal::kCrc, 0);
  gate_.Restart();
  EXPECT_EQ(gate_.state(), GateState::kStart);
  EXPECT_EQ(gate_.Current(10).motors, start_.motors);
  EXPECT_EQ(gate_.counts().accepted, 1U);
  EXPECT_EQ(Refused(gate_, Refusal::kCrc), 1U);
  EXPECT_EQ(gate_.counts().timeouts, 0U);
}

TEST_F(CommandGateTest, RestartsAtAnotherStartCommandAndKeepsToIt) {
  gate_.Restart(Torques(7, 8));
  EXPECT_EQ(gate_.Current(0).motors, Torques(7, 8).motors);
  gate_.Restart();
  EXPECT_EQ(gate_.Current(0).motors, Torques(7, 8).motors);
}

TEST(DampingCommandTest, BrakesEveryMotorAndHoldsNone) {
  const RobotCommand command = DampingCommand(3, 2);
  ASSERT_EQ(command.motors.size(), 3U);
  for (const MotorCommand& motor : command.motors) {
    EXPECT_EQ(motor, (MotorCommand{.enabled = true, .q = kNoPosition, .kd = 2}));
  }
  EXPECT_EQ(command.joint_space, JointSpace::kPitchRoll);
}

TEST(RefusalTest, HasAWordForEveryReason) {
  for (std::size_t i = 0; i < kRefusals; ++i) {
    EXPECT_FALSE(Name(static_cast<Refusal>(i)).empty()) << i;
  }
  EXPECT_EQ(Name(Refusal::kGain), "gain");
}

}  // namespace
}  // namespace understudy
