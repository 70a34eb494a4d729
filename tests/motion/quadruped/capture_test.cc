#include "motion/quadruped/capture.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// Feet on a rectangle of 0.4 m by 0.2 m, the centre of mass over its middle, turned by `yaw`.
QuadrupedReading Standing(double yaw = 0) {
  QuadrupedReading reading{};
  reading.feet = {Vector3d(0.2, -0.1, -0.3), Vector3d(0.2, 0.1, -0.3), Vector3d(-0.2, -0.1, -0.3),
                  Vector3d(-0.2, 0.1, -0.3)};
  reading.com.setZero();
  reading.w_WB_B.setZero();
  reading.R_TB.setIdentity();
  reading.R_WB = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  return reading;
}

TEST(CaptureTest, AFallingPendulumComesToRestAheadBySpeedOverRate) {
  EXPECT_TRUE(CapturePoint(Standing(), {0.5, -0.1, 0}, 5).isApprox(Vector3d(0.1, -0.02, 0)));
  const Vector3d turned = CapturePoint(Standing(M_PI / 2), {0.5, -0.1, 0}, 5);
  EXPECT_TRUE(turned.isApprox(Vector3d(-0.02, -0.1, 0))) << "as the base faces";
}

TEST(CaptureTest, SpeedIsThatOfTheCentreOfMassNotOfTheBase) {
  QuadrupedReading reading = Standing();
  reading.com = {0.1, 0, 0};
  reading.w_WB_B = {0, 0, 1};
  EXPECT_TRUE(CapturePoint(reading, Vector3d::Zero(), 5).isApprox(Vector3d(0.1, 0.02, 0)));
}

TEST(CaptureTest, OverhangCountsFromTheMiddleToTheNearestEdge) {
  const QuadrupedReading reading = Standing();
  EXPECT_NEAR(Overhang(reading, {0, 0, 0}), 0, 1e-9);
  for (const double way : {-1.0, 1.0}) {
    EXPECT_NEAR(Overhang(reading, {way * 0.1, 0, 0}), 0.5, 1e-9);
    EXPECT_NEAR(Overhang(reading, {0, way * 0.1, 0}), 1, 1e-9);
    EXPECT_NEAR(Overhang(reading, {way * 0.1, way * 0.15, 5}), 1.5, 1e-9);
  }
}

TEST(CaptureTest, FeetThatEncloseNothingHoldNothing) {
  QuadrupedReading reading = Standing();
  std::swap(reading.feet[0], reading.feet[1]);
  std::swap(reading.feet[2], reading.feet[3]);
  EXPECT_GT(Overhang(reading, {0, 0, 0}), 1e6);
}

TEST(CaptureTest, ThePairOfFeetThatHoldsIsTheOneTheFallCrossesLeast) {
  EXPECT_TRUE(NearerToFrontRight(Standing(), {0.2, -0.1, 0}));
  EXPECT_TRUE(NearerToFrontRight(Standing(), {-0.3, 0.1, 0}));
  EXPECT_FALSE(NearerToFrontRight(Standing(), {0.2, 0.1, 0}));
}

}  // namespace
}  // namespace understudy::motion
