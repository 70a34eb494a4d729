#include "authority/overlay.h"

#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "robot/motor.h"

namespace understudy::authority {
namespace {

constexpr robot::MotorCommand kHold{
    .enabled = true, .q = 1, .dq = 0.5, .tau = 3, .kp = 40, .kd = 2};
constexpr robot::MotorCommand kOther{
    .enabled = true, .q = -1, .dq = 0, .tau = 1, .kp = 10, .kd = 1};
constexpr robot::MotorCommand kDamp{.enabled = true, .q = robot::kNoPosition, .kd = 4};

// The torques of two motors, of which the second scales gains and keeps angles within a clamp.
class MixTest : public ::testing::Test {
 protected:
  MixTest() {
    spec_.motors.resize(2, {.joint = "", .slot = 0, .torque_limit = 1000});
    spec_.motors[1].slot = 1;
    spec_.motors[1].kp_scale = 0.9;
    spec_.motors[1].kd_scale = 0.8;
    spec_.motors[1].q_clamp = {-0.52, 0.52};
    spec_.dynamics = {.use = robot::DynamicsSource::kFitted,
                      .fitted = {{.slots = {1}, .kd_share = 0.5}}};
  }
  double Torque(std::size_t motor, const robot::MotorCommand& command, double q, double dq) const {
    robot::MotorBank bank(spec_, 0.001);
    const std::vector<double> at(2, q), rate(2, dq);
    const robot::RobotCommand both{.motors = {2, command}};
    return bank.Step({.command = both, .q = at, .dq = rate})[motor];
  }
  robot::MotorCommand Mixed(std::size_t motor, const robot::MotorCommand& under,
                            const robot::MotorCommand& over, double weight) const {
    return Mix(under, over, weight, spec_.motors[motor].q_clamp);
  }

  robot::RobotSpec spec_;
};

TEST_F(MixTest, GivesTheWeightedTorqueOfItsMotorAtEveryAngleAndRate) {
  for (const robot::MotorCommand& over : {kOther, kDamp, robot::MotorCommand{}}) {
    for (const double weight : {0.0, 0.25, 0.7, 1.0}) {
      for (const std::size_t motor : {0U, 1U}) {
        const robot::MotorCommand mixed = Mixed(motor, kHold, over, weight);
        for (const double q : {-2.0, 0.0, 1.5}) {
          for (const double dq : {-3.0, 0.0, 2.0}) {
            EXPECT_NEAR(
                Torque(motor, mixed, q, dq),
                (1 - weight) * Torque(motor, kHold, q, dq) + weight * Torque(motor, over, q, dq),
                1e-9)
                << motor << ' ' << weight << ' ' << q << ' ' << dq;
          }
        }
      }
    }
  }
}

TEST_F(MixTest, AsksForTheAngleThatBothSidesAskFor) {
  for (const double weight : {0.0, 0.001, 0.5, 1.0}) {
    EXPECT_NEAR(Mixed(0, kHold, kHold, weight).q, kHold.q, 1e-12) << weight;
  }
  const robot::MotorCommand damped = Mixed(0, kDamp, kDamp, 0.5);
  EXPECT_EQ(damped.q, robot::kNoPosition);
  EXPECT_FALSE(robot::AsksForAngle(damped));
}

class OverlayTest : public ::testing::Test {
 protected:
  OverlayTest() {
    for (const int slot : {2, 5, 7}) spec_.motors.push_back({.joint = "", .slot = slot});
    spec_.arm_sdk.slots = {5, 7};
  }
  robot::RobotCommand Of(const robot::MotorCommand& motor, double weight = 0) const {
    return {.motors = {3, motor}, .weight = weight};
  }

  robot::RobotSpec spec_;
};

TEST_F(OverlayTest, ChangesNothingBeforeTheFirstCommand) {
  const Overlay arms = OverArms(spec_);
  robot::RobotCommand command = Of(kHold);
  arms.MixOver(0, command.motors);
  EXPECT_EQ(command.motors, Of(kHold).motors);
}

TEST_F(OverlayTest, MovesItsOwnMotorsOnly) {
  Overlay arms = OverArms(spec_);
  arms.Offer(Of(kOther, 1), 0);
  robot::RobotCommand command = Of(kHold);
  arms.MixOver(0, command.motors);
  EXPECT_EQ(command.motors[0], kHold);
  EXPECT_EQ(command.motors[1], kOther);
  EXPECT_EQ(command.motors[2], kOther);
}

TEST_F(OverlayTest, CutsTheWeight) {
  Overlay arms = OverArms(spec_);
  arms.Offer(Of(kOther, 7), 0);
  EXPECT_EQ(arms.weight(0), 1);
  arms.Offer(Of(kOther, -1), 0);
  EXPECT_EQ(arms.weight(0), 0);
}

TEST_F(OverlayTest, RefusesACommandToAnotherNumberOfMotors) {
  Overlay arms = OverArms(spec_);
  robot::RobotCommand command = Of(kOther, 1);
  command.motors.pop_back();
  EXPECT_EQ(arms.Offer(command, 0), robot::Refusal::kMotorCount);
  EXPECT_EQ(arms.weight(0), 0);
}

TEST_F(OverlayTest, LeavesOutWhatWouldHarm) {
  Overlay arms = OverArms(spec_);
  arms.Offer(Of(kOther, 0.5), 0);
  robot::MotorCommand bad = kOther;
  bad.kp = -1;
  arms.Offer(Of(bad, 1), 0);
  arms.Offer(Of(kOther, std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(arms.weight(0), 0.5);
}

TEST_F(OverlayTest, KeepsTheLastCommandUnlessItsRobotDropsIt) {
  Overlay forever = OverArms(spec_);
  forever.Offer(Of(kOther, 1), 0);
  EXPECT_EQ(forever.weight(1000), 1);
  spec_.arm_sdk.timeout = 0.5;
  Overlay fading = OverArms(spec_);
  fading.Offer(Of(kOther, 1), 0);
  EXPECT_EQ(fading.weight(0.5), 1);
  EXPECT_EQ(fading.weight(0.51), 0);
}

TEST_F(OverlayTest, OverHandsMovesThoseThatHandSdkReaches) {
  spec_.hands = {{.name = "left", .motors = {{.joint = "a"}}},
                 {.name = "right", .motors = {{.joint = "b"}, {.joint = "c"}}, .sdk_slot = 2}};
  spec_.hand_sdk_timeout = 0.5;
  Overlay hands = OverHands(spec_);
  EXPECT_EQ(hands.Offer(Of(kOther, 1), 0), robot::Refusal::kNone);
  robot::RobotCommand command = Of(kHold);
  hands.MixOver(0.5, command.motors);
  EXPECT_EQ(command.motors, (std::vector{kHold, kOther, kOther}));
  EXPECT_EQ(hands.weight(0.51), 0);
}

TEST_F(OverlayTest, ALockedMotorBrakesWithWhatTheWeightLeaves) {
  spec_.hands = {{.name = "claw", .motors = {{.joint = "a", .lock_kd = 0.2}}, .sdk_slot = 0}};
  Overlay hands = OverHands(spec_);
  std::vector<robot::MotorCommand> locked(1);
  hands.MixOver(0, locked);
  EXPECT_EQ(locked[0], robot::MotorCommand{}) << "no weight";
  hands.Offer({.motors = {{.enabled = true, .tau = 1}}, .weight = 0.75}, 0);
  hands.MixOver(0, locked);
  EXPECT_TRUE(locked[0].enabled);
  EXPECT_DOUBLE_EQ(locked[0].tau, 0.75);
  EXPECT_DOUBLE_EQ(locked[0].kd, 0.05);
  EXPECT_EQ(locked[0].dq, 0);
}

}  // namespace
}  // namespace understudy::authority
