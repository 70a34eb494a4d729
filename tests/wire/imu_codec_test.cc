#include "wire/imu_codec.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>

namespace understudy::wire {
namespace {

using Go = unitree_go_msg_dds__IMUState_;
using Hg = unitree_hg_msg_dds__IMUState_;
using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::FloatNear;

constexpr double kPi = std::numbers::pi;

Eigen::Quaterniond FromRpy(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

TEST(RollPitchYawTest, UndoesTheRotations) {
  for (const double roll : {-3.0, 0.0, 0.4}) {
    for (const double pitch : {-1.5, 0.0, 0.7}) {
      for (const double yaw : {-2.0, 0.0, 3.0}) {
        const Eigen::Vector3d rpy = RollPitchYaw(FromRpy(roll, pitch, yaw));
        EXPECT_TRUE(rpy.isApprox(Eigen::Vector3d(roll, pitch, yaw), 1e-9) ||
                    (rpy - Eigen::Vector3d(roll, pitch, yaw)).norm() < 1e-9)
            << rpy.transpose();
      }
    }
  }
}

TEST(RollPitchYawTest, IsFiniteWhenTheNosePointsUpOrDown) {
  for (const double pitch : {-kPi / 2, kPi / 2}) {
    for (const double yaw : {-2.0, 0.0, 1.0}) {
      // Slightly longer than 1, as rounding leaves it: the sine is then over 1.
      Eigen::Quaterniond R_WI = FromRpy(0.3, pitch, yaw);
      R_WI.coeffs() *= 1 + 1e-12;
      const Eigen::Vector3d rpy = RollPitchYaw(R_WI);
      EXPECT_TRUE(rpy.allFinite());
      EXPECT_NEAR(rpy[1], pitch, 1e-5);
    }
  }
}

template <typename Imu>
class ImuCodecTest : public ::testing::Test {};
using Families = ::testing::Types<Go, Hg>;
TYPED_TEST_SUITE(ImuCodecTest, Families);

TYPED_TEST(ImuCodecTest, WritesWXYZGyroAccelerometerAndTemperature) {
  robot::ImuReading reading;
  reading.R_WI = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  reading.w_WI_I = {1, 2, 3};
  reading.f_WI_I = {4, 5, 9.8125};
  reading.temperature_c = 79.6;
  TypeParam message{};
  EncodeImu(reading, &message);
  EXPECT_THAT(message.quaternion, ElementsAre(0.5F, 0.5F, -0.5F, 0.5F));
  EXPECT_THAT(message.gyroscope, ElementsAre(1, 2, 3));
  EXPECT_THAT(message.accelerometer, ElementsAre(4, 5, 9.8125F));
  EXPECT_EQ(message.temperature, 80);
}

TYPED_TEST(ImuCodecTest, WritesAUnitQuaternionBeforeTheFirstReading) {
  TypeParam message{};
  EncodeImu(robot::ImuReading{}, &message);
  EXPECT_THAT(message.quaternion, ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(message.rpy, ElementsAre(0, 0, 0));
}

TYPED_TEST(ImuCodecTest, NormalisesTheQuaternion) {
  robot::ImuReading reading;
  reading.R_WI = Eigen::Quaterniond(0, 0, 3, 4);
  TypeParam message{};
  EncodeImu(reading, &message);
  EXPECT_THAT(message.quaternion, ElementsAre(0, 0, FloatEq(0.6F), FloatEq(0.8F)));
}

TYPED_TEST(ImuCodecTest, MakesTheIdentityOfNoRotation) {
  for (const double bad : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    robot::ImuReading reading;
    reading.R_WI = Eigen::Quaterniond(bad, bad, bad, bad);
    TypeParam message{};
    EncodeImu(reading, &message);
    EXPECT_THAT(message.quaternion, ElementsAre(1, 0, 0, 0));
    EXPECT_THAT(message.rpy, ElementsAre(0, 0, 0));
  }
}

TYPED_TEST(ImuCodecTest, StartsWithAPositiveW) {
  robot::ImuReading reading;
  reading.R_WI = Eigen::Quaterniond(-1, 0, 0, 0);
  TypeParam message{};
  EncodeImu(reading, &message);
  EXPECT_EQ(message.quaternion[0], 1);
}

TYPED_TEST(ImuCodecTest, DoesNotJumpBetweenTheTwoSigns) {
  TypeParam message{};
  robot::ImuReading reading;
  float before[4] = {1, 0, 0, 0};
  for (int step = 0; step <= 100; ++step) {  // once around and more, a sign at random
    reading.R_WI = FromRpy(0, 0, 0.1 * step);
    if (step % 3 == 0) reading.R_WI.coeffs() *= -1;
    EncodeImu(reading, &message);
    for (int i = 0; i < 4; ++i) {
      EXPECT_THAT(message.quaternion[i], FloatNear(before[i], 0.051F));
      before[i] = message.quaternion[i];
    }
  }
}

TEST(GoImuCodecTest, KeepsTheTemperatureWithinWhatPythonPacks) {
  Go message{};
  EncodeImu({.temperature_c = 150}, &message);
  EXPECT_EQ(message.temperature, 127);
  EncodeImu({.temperature_c = -20}, &message);
  EXPECT_EQ(message.temperature, 0);
}

TEST(HgImuCodecTest, KnowsFrost) {
  Hg message{};
  EncodeImu({.temperature_c = -20}, &message);
  EXPECT_EQ(message.temperature, -20);
}

}  // namespace
}  // namespace understudy::wire
