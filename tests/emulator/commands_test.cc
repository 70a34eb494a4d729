#include <limits>

#include <gmock/gmock.h>

#include "tests/emulator/emulator_test.h"
#include "tests/emulator/state_bytes.h"

namespace understudy::emulator {
namespace {

class CommandsTest : public EmulatorTest {
 protected:
  CommandsTest() {
    port_.TellEvery(1);
    config_.robots[0].start.pose = "clamped";
    Start();
  }
};

TEST_F(CommandsTest, ShowInTheStateOfTheStepThatTakesThem) {
  Tick(3);
  port_.Send(Torque(2));
  Tick();
  EXPECT_EQ(port_.last().state.tick_ms, 3);
  for (const robot::MotorReading& motor : port_.last().state.motors) {
    EXPECT_EQ(motor.tau, 2);
    EXPECT_TRUE(motor.enabled);
  }
  for (const robot::MotorReading& motor : port_.samples()[2].state.motors)
    EXPECT_NEAR(motor.tau, 0, 1e-3);
}

TEST_F(CommandsTest, ReachTheMotorsAfterTheDelayOfTheRobot) {
  config_.robots[0].spec.dynamics.delay = 0.002;
  Start();
  port_.Send(Torque(2));
  Tick(3);
  const auto& samples = port_.samples();
  EXPECT_NEAR(samples[0].state.motors[0].tau, 0, 1e-3);
  EXPECT_NEAR(samples[1].state.motors[0].tau, 0, 1e-3);
  EXPECT_EQ(samples[2].state.motors[0].tau, 2);
}

TEST_F(CommandsTest, ReachTheMotorTheyAreMeantFor) {
  for (std::size_t i = 0; i < 6; ++i) {
    robot::RobotCommand command = Torque(0);
    command.motors[i].tau = 1 + static_cast<double>(i);
    port_.Send(command);
    Tick();
    for (std::size_t m = 0; m < 6; ++m) {
      EXPECT_EQ(port_.last().state.motors[m].tau, m == i ? 1 + static_cast<double>(i) : 0);
    }
  }
}

TEST_F(CommandsTest, AreTakenAllAndTheLastIsFollowed) {
  for (int i = 1; i <= 5; ++i) port_.Send(Torque(i));
  Tick();
  EXPECT_TRUE(port_.idle());
  EXPECT_EQ(world_->status(0).commands.accepted, 5U);
  EXPECT_EQ(port_.last().state.motors[0].tau, 5);
}

TEST_F(CommandsTest, AreTakenEightAtOnceAndTheOthersInLaterTicks) {
  for (int i = 1; i <= 20; ++i) {
    port_.Send(Torque(i));
    port_.SendUser(Torque(i));
  }
  Tick();
  EXPECT_EQ(port_.last().state.motors[0].tau, 8);
  Tick();
  EXPECT_EQ(port_.last().state.motors[0].tau, 16);
  EXPECT_FALSE(port_.idle());
  Tick();
  EXPECT_TRUE(port_.idle());
  EXPECT_EQ(port_.last().state.motors[0].tau, 20);
  EXPECT_EQ(world_->status(0).commands.accepted, 20U);
  EXPECT_EQ(world_->status(0)
                .user_commands.refused[static_cast<std::size_t>(robot::Refusal::kNoMotionService)],
            20U);
}

TEST_F(CommandsTest, OfNoTopicKeepThoseOfAnotherWaiting) {
  for (int i = 1; i <= 20; ++i) {
    port_.Send(Torque(i));
    port_.SendArms(Torque(i), 1);
    port_.SendUser(Torque(i));
  }
  Tick();
  const Status status = world_->status(0);
  const auto refused = static_cast<std::size_t>(robot::Refusal::kNoMotionService);
  EXPECT_EQ(status.commands.accepted, 6U);
  EXPECT_EQ(status.arm_commands.refused[refused], 5U);
  EXPECT_EQ(status.user_commands.refused[refused], 5U);
}

TEST_F(CommandsTest, ThatWereLostAreCountedAndTold) {
  port_.Lose(robot::kLowCmdTopic, 12);
  Tick(2);
  const auto lost = static_cast<std::size_t>(robot::Refusal::kLost);
  EXPECT_EQ(world_->status(0).commands.refused[lost], 12U);
  EXPECT_THAT(Told(EventKind::kLostCommands),
              testing::ElementsAre(testing::StartsWith("refused 12 LowCmd (lost): more came")));
}

TEST_F(CommandsTest, AreGatheredButNotTakenWhileTimeStandsStill) {
  ASSERT_EQ(Answered("pause"), "");
  port_.Send(Torque(1));
  const int before = port_.rests();
  world_->Attend({});
  EXPECT_EQ(port_.rests(), before + 1);
  EXPECT_FALSE(port_.idle());
}

TEST_F(CommandsTest, OfAWriterThatDoesNotMatchAreCountedAsWriters) {
  robot().NoteUnmatched("rt/lowcmd", "rt/lowcmd by process 7 (a): ownership");
  robot().NoteUnmatched("rt/api/sport/request", "rt/api/sport/request by process 7 (a): type X");
  const Status status = world_->status(0);
  EXPECT_EQ(status.commands.refused[static_cast<std::size_t>(robot::Refusal::kUnmatched)], 1U);
  EXPECT_EQ(status.services.refused[static_cast<std::size_t>(services::CallRefusal::kUnmatched)],
            1U);
  EXPECT_THAT(
      Told(EventKind::kUnmatched),
      testing::ElementsAre("nothing arrives on rt/lowcmd by process 7 (a): ownership",
                           "nothing arrives on rt/api/sport/request by process 7 (a): type X"));
}

TEST_F(CommandsTest, ToServicesThatComeToNothingAreToldWithReasonAndCode) {
  using services::CallRefusal;
  services_.Bring({.service = "sport",
                   .api_id = 1008,
                   .code = 4206,
                   .refusal = CallRefusal::kState,
                   .name = "Move"});
  services_.Bring({.service = "sport",
                   .api_id = 7104,
                   .refusal = CallRefusal::kIgnored,
                   .name = "SetStandHeight"});
  services_.Bring({.service = "sport",
                   .code = services::Call::kNoCode,
                   .refusal = CallRefusal::kTooMany,
                   .times = 7});
  Tick();
  EXPECT_THAT(
      Told(EventKind::kCallRefused),
      testing::ElementsAre(
          "refused 1 call of sport 1008 Move (state): the motion service does not do it in "
          "its present state, 0; code 4206",
          "refused 1 call of sport 7104 SetStandHeight (ignored): it is accepted and has no "
          "effect, "
          "as on the real robot in that state, 0; code 0",
          "refused 7 calls of sport (too_many): more came than the robot can serve, and the "
          "oldest were dropped; not answered"));
  EXPECT_THAT(Told(EventKind::kCall), testing::SizeIs(2));
}

TEST_F(CommandsTest, AreCutToWhatTheMotorGives) {
  port_.Send(Torque(1000));
  Tick();
  EXPECT_EQ(port_.last().state.motors[0].tau, 50);
}

TEST_F(CommandsTest, AreFollowedInMotorSpaceToo) {
  robot::RobotCommand command = Torque(0);
  for (robot::MotorCommand& motor : command.motors) motor.space = robot::JointSpace::kMotors;
  command.motors[5].tau = 3;  // A of the neck
  port_.Send(command);
  Tick();
  EXPECT_EQ(port_.last().state.motors[4].tau, 3);
  EXPECT_EQ(port_.last().state.motors[5].tau, 6);
  EXPECT_EQ(port_.last().state.joint_space, robot::JointSpace::kMotors);
}

TEST_F(CommandsTest, MoveTheRobot) {
  robot::RobotCommand command;
  for (int i = 0; i < 6; ++i) {
    command.motors.push_back({.enabled = true, .q = 0.1 * (i - 2), .kp = 200, .kd = 5});
  }
  port_.SendEveryTick(command);
  Tick(2000);
  for (std::size_t i = 0; i < 6; ++i) {
    // Legs bear 1 kg · 10 m/s² · 0.2 m · sin q against 200 N·m/rad: within 2 mrad.
    EXPECT_NEAR(port_.last().state.motors[i].q, command.motors[i].q, 0.005);
  }
}

TEST_F(CommandsTest, EndInDampingAfterSilence) {
  port_.Send(Torque(2));
  Tick(200);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kFollowing);
  EXPECT_EQ(port_.last().state.motors[0].tau, 2);
  Tick(2);  // 0.2 s is over
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kDamping);
  EXPECT_EQ(world_->status(0).commands.timeouts, 1U);
  for (const robot::MotorReading& motor : port_.last().state.motors) {
    EXPECT_NEAR(motor.tau, -config_.robots[0].gate.damping_kd * motor.dq, 1e-12);
    EXPECT_TRUE(motor.enabled);
  }
  port_.Send(Torque(2));
  Tick();
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kFollowing);
  EXPECT_EQ(port_.last().state.motors[0].tau, 2);
}

TEST_F(CommandsTest, ChangeNothingWhenRefused) {
  test::FakePort quiet_port;
  quiet_port.TellEvery(1);
  Inbox quiet_inbox;
  const auto quiet = Make(&quiet_port, &quiet_inbox);
  for (int i = 0; i < 300; ++i) {
    if (i == 20) {
      port_.Send(Torque(2));
      quiet_port.Send(Torque(2));
    }
    port_.Send(Torque(9), robot::Refusal::kCrc);
    Tick();
    ASSERT_EQ(quiet->Tick({}), physics::StepHealth::kFine);
    ASSERT_EQ(Bytes(port_.last().state), Bytes(quiet_port.last().state)) << i;
  }
  EXPECT_EQ(world_->status(0).commands.refused[static_cast<std::size_t>(robot::Refusal::kCrc)],
            300U);
  EXPECT_EQ(Told(EventKind::kRefused).size(), 300U);
  EXPECT_THAT(Told(EventKind::kRefused).back(), testing::HasSubstr("LowCmd (crc)"));
  EXPECT_EQ(Told(EventKind::kTimeout).size(), 1U);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kDamping);
}

TEST_F(CommandsTest, DoNoHarmWhenTheyHoldNoNumbers) {
  test::FakePort quiet_port;
  quiet_port.TellEvery(1);
  Inbox quiet_inbox;
  const auto quiet = Make(&quiet_port, &quiet_inbox);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const robot::MotorCommand nothing{
      .enabled = true, .q = kNan, .dq = kNan, .tau = kNan, .kp = kNan, .kd = kNan};
  port_.SendEveryTick({.motors = std::vector<robot::MotorCommand>(6, nothing)});
  for (int i = 0; i < 300; ++i) {
    Tick();
    ASSERT_EQ(quiet->Tick({}), physics::StepHealth::kFine);
    ASSERT_EQ(Bytes(port_.last().state), Bytes(quiet_port.last().state)) << i;
  }
  EXPECT_THAT(Told(EventKind::kRefused).back(), testing::HasSubstr("LowCmd (not_finite)"));
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kStart);
}

TEST_F(CommandsTest, PassALenientGateWithWrongForm) {
  config_.robots[0].gate.lenient = true;
  Start();
  port_.Send(Torque(2), robot::Refusal::kCrc);
  Tick();
  EXPECT_EQ(port_.last().state.motors[0].tau, 2);
  EXPECT_EQ(world_->status(0).commands.refused[static_cast<std::size_t>(robot::Refusal::kCrc)], 1U);
}

TEST_F(CommandsTest, DrawOnTheBattery) {
  Tick(10);
  const double before = port_.last().state.battery.current;
  port_.Send(Torque(20));
  Tick();
  // 0.1 W/(N·m)² · 6 · 20² (N·m)² at about 40 V.
  EXPECT_LT(port_.last().state.battery.current, before - 4);
}

TEST_F(CommandsTest, OfDisabledMotorsGiveNoTorque) {
  robot::RobotCommand command = Torque(2);
  command.motors[3].enabled = false;
  port_.Send(command);
  Tick();
  EXPECT_EQ(port_.last().state.motors[3].tau, 0);
  EXPECT_FALSE(port_.last().state.motors[3].enabled);
  EXPECT_EQ(port_.last().state.motors[2].tau, 2);
}

}  // namespace
}  // namespace understudy::emulator
