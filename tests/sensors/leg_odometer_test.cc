#include "sensors/leg_odometer.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

using Eigen::Vector3d;

class LegOdometerTest : public testing::Test {
 protected:
  LegOdometerTest() {
    config_.odometer.legs = OdometrySource::kEstimate;
    sample_.motion = robot::MotionState{.body_height = 0.3, .estimates = true};
    sample_.base.p_WB = {5, 5, 0.3};
  }
  void Begin() {
    odometer_.Apply(config_);
    odometer_.Restart(sample_.base);
    odometer_.Read(sample_);
  }
  // Turns on the spot and then walks straight ahead, as truth and estimate alike.
  robot::LegOdometry Move(double turn, double way) {
    for (int i = 0; i < 100; ++i) {
      yaw_ += turn / 100;
      sample_.imu.R_WI = Eigen::AngleAxisd(yaw_, Vector3d::UnitZ());
      sample_.truth.imu.R_WI = sample_.imu.R_WI;
      odometer_.Read(sample_);
    }
    const Vector3d ahead = sample_.imu.R_WI * Vector3d::UnitX();
    for (int i = 0; i < 100; ++i) {
      sample_.motion->p_WB += way / 100 * ahead;
      sample_.base.p_WB += way / 100 * ahead;
      odometer_.Read(sample_);
    }
    return *odometer_.Read(sample_);
  }

  SensorConfig config_;
  LegOdometer odometer_{config_};
  robot::RobotState sample_;
  double yaw_ = 0;
};

TEST_F(LegOdometerTest, BeginsAtZeroAndFallsShortOfTheWay) {
  config_.odometer.shortfall = 1 - 1 / 1.1995;
  Begin();
  const robot::LegOdometry reading = Move(0, 10);
  EXPECT_NEAR(reading.p_OB.x(), 8.337, 1e-3) << "a tape has 1.1995 m for each that it tells";
  EXPECT_NEAR(reading.p_OB.y(), 0, 1e-9);
  EXPECT_EQ(reading.p_OB.z(), 0.3) << "over the feet";
}

TEST_F(LegOdometerTest, FallsShortInItsVelocityAsWell) {
  config_.odometer.shortfall = 0.2;
  Begin();
  Move(std::numbers::pi / 2, 0);
  sample_.motion->v_WB_W = {0, 1, 0};
  const Vector3d v = odometer_.Read(sample_)->v_OB_B;
  EXPECT_NEAR(v.x(), 0.8, 1e-9) << "in the base, which looks along y";
  EXPECT_NEAR(v.y(), 0, 1e-9);
}

TEST_F(LegOdometerTest, LosesItsHeadingByAShareOfEachTurn) {
  config_.odometer.turn = 0.17 / 360;
  Begin();
  double off = 0;
  for (int turn = 1; turn <= 10; ++turn) {
    const robot::LegOdometry reading = Move(2 * std::numbers::pi, 0);
    const Vector3d ahead = reading.R_OB * Vector3d::UnitX();
    off = std::atan2(ahead.y(), ahead.x()) * 180 / std::numbers::pi;
    EXPECT_NEAR(off, 0.17 * turn, 1e-6);
  }
  const robot::LegOdometry there = Move(0, 10);
  EXPECT_NEAR(there.p_OB.y(), 10 * std::sin(off * std::numbers::pi / 180), 1e-6)
      << "it takes the way along the heading that it tells";
}

TEST_F(LegOdometerTest, HasTheTruthFromWhereItBeganIfAskedFor) {
  config_.odometer = {.legs = OdometrySource::kTruth, .shortfall = 0.5, .turn = 0.5};
  Begin();
  const robot::LegOdometry reading = Move(std::numbers::pi / 2, 10);
  EXPECT_TRUE(reading.p_OB.isApprox(Vector3d(0, 10, 0.3), 1e-9));
  EXPECT_EQ(reading.R_OB.coeffs(), sample_.truth.imu.R_WI.coeffs());
}

TEST_F(LegOdometerTest, SaysNothingAndAddsNothingWhileNoMotionServiceEstimates) {
  Begin();
  const Vector3d before = Move(0, 1).p_OB;
  const robot::MotionState motion = *sample_.motion;
  sample_.motion.reset();
  EXPECT_FALSE(odometer_.Read(sample_).has_value());
  sample_.motion = motion;
  sample_.motion->p_WB.setZero();  // as a service that begins anew
  EXPECT_EQ(odometer_.Read(sample_)->p_OB, before);
}

}  // namespace
}  // namespace understudy::sensors
