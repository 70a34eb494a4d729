#include "robot/parallel_joint.h"

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

// A = pitch + 2 roll, B = pitch - 2 roll
const ParallelJoint kJoint({.pitch = 4, .roll = 5, .roll_ratio = 2});

TEST(ParallelJointTest, KnowsItsSlots) {
  EXPECT_EQ(kJoint.pitch(), 4);
  EXPECT_EQ(kJoint.roll(), 5);
}

TEST(ParallelJointTest, MovesBothMotorsAlikeInPitch) {
  const auto motors = kJoint.ToMotors({.pitch = 3, .roll = 0});
  EXPECT_EQ(motors.a, 3);
  EXPECT_EQ(motors.b, 3);
}

TEST(ParallelJointTest, PartsTheMotorsInRoll) {
  const auto motors = kJoint.ToMotors({.pitch = 0, .roll = 1});
  EXPECT_EQ(motors.a, 2);
  EXPECT_EQ(motors.b, -2);
}

TEST(ParallelJointTest, AddsTheTorquesOfTheMotorsInPitch) {
  const auto tau = kJoint.TorqueToSerial({.a = 3, .b = 1});
  EXPECT_EQ(tau.pitch, 4);
  EXPECT_EQ(tau.roll, 4);
}

TEST(ParallelJointTest, BringsTorquesBackFromBothSides) {
  const auto tau = kJoint.TorqueToMotors(kJoint.TorqueToSerial({.a = 3, .b = -7}));
  EXPECT_EQ(tau.a, 3);
  EXPECT_EQ(tau.b, -7);
  const auto serial = kJoint.TorqueToSerial(kJoint.TorqueToMotors({.pitch = 5, .roll = 8}));
  EXPECT_EQ(serial.pitch, 5);
  EXPECT_EQ(serial.roll, 8);
}

TEST(ParallelJointTest, GivesTheSamePowerOnBothSides) {
  const ParallelJoint::Motors tau{.a = 3, .b = -5};
  const ParallelJoint::Serial rate{.pitch = 7, .roll = -2};
  const auto motor_rate = kJoint.ToMotors(rate);
  const auto serial = kJoint.TorqueToSerial(tau);
  EXPECT_EQ(tau.a * motor_rate.a + tau.b * motor_rate.b,
            serial.pitch * rate.pitch + serial.roll * rate.roll);
}

}  // namespace
}  // namespace understudy::robot
