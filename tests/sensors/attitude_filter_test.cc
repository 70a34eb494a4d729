#include "sensors/attitude_filter.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDt = 0.001;
constexpr double kG = 9.81;

double Tilt(const Quaterniond& R_WI) {
  return std::acos(std::min(1.0, (R_WI * Vector3d::UnitZ()).z()));
}
double Yaw(const Quaterniond& R_WI) {
  const Vector3d x = R_WI * Vector3d::UnitX();
  return std::atan2(x.y(), x.x());
}

TEST(AttitudeFilterTest, FollowsAnyTurnWithoutAnAccelerometer) {
  AttitudeFilter filter(0, 0, kDt);
  Quaterniond truth(AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()));
  filter.Restart(truth, truth.conjugate() * Vector3d(0, 0, kG));
  EXPECT_LT(filter.R_WI().angularDistance(truth), 1e-12);
  for (int i = 0; i < 5000; ++i) {
    const Vector3d w(3 * std::sin(0.002 * i), 2, -5 * std::cos(0.003 * i));
    truth = truth * AngleAxisd(w.norm() * kDt, w.normalized());
    filter.Step(w, Vector3d(0, 0, kG));
  }
  EXPECT_LT(filter.R_WI().angularDistance(truth), 1e-8);
}

TEST(AttitudeFilterTest, BeginsWithTheTiltThatTheAccelerometerShowsAndTheHeadingItIsGiven) {
  AttitudeFilter filter(0.2, 0.01, kDt);
  const Quaterniond heading(AngleAxisd(2, Vector3d::UnitZ()));
  filter.Restart(heading, Vector3d(1, 0, kG));
  EXPECT_NEAR(Tilt(filter.R_WI()), std::atan2(1, kG), 1e-12);
  EXPECT_NEAR(Yaw(filter.R_WI()), 2, 1e-3);
  const Vector3d up_I = filter.R_WI().conjugate() * Vector3d::UnitZ();
  EXPECT_TRUE(up_I.isApprox(Vector3d(1, 0, kG).normalized(), 1e-12));
}

TEST(AttitudeFilterTest, TurnsToTheVerticalAtItsGain) {
  AttitudeFilter filter(0.5, 0, kDt);
  filter.Restart(Quaterniond(AngleAxisd(0.02, Vector3d::UnitX())), Vector3d::Zero());
  for (int i = 0; i < 2000; ++i) filter.Step(Vector3d::Zero(), Vector3d(0, 0, kG));
  EXPECT_NEAR(Tilt(filter.R_WI()), 0.02 * std::exp(-0.5 * 2), 2e-5);
}

// A constant bias b, critically damped: the tilt is b t exp(-gain t / 2), most at 2 / gain.
TEST(AttitudeFilterTest, LearnsABiasAboutALevelAxis) {
  AttitudeFilter filter(0.2, 0.01, kDt);
  filter.Restart(Quaterniond::Identity(), Vector3d(0, 0, kG));
  const Vector3d bias(0.01, 0, 0);
  for (int i = 0; i < 10'000; ++i) filter.Step(bias, Vector3d(0, 0, kG));
  EXPECT_NEAR(Tilt(filter.R_WI()), 0.01 * 10 * std::exp(-1), 4e-4);
  for (int i = 0; i < 90'000; ++i) filter.Step(bias, Vector3d(0, 0, kG));
  EXPECT_LT(Tilt(filter.R_WI()), 2e-4);
}

TEST(AttitudeFilterTest, TurnsItsHeadingAwayByBiasTimesTime) {
  AttitudeFilter filter(0.2, 0.01, kDt);
  filter.Restart(Quaterniond::Identity(), Vector3d(0, 0, kG));
  for (int i = 0; i < 60'000; ++i) filter.Step(Vector3d(0, 0, 0.002), Vector3d(0, 0, kG));
  EXPECT_NEAR(Yaw(filter.R_WI()), 0.12, 1e-6);
}

TEST(AttitudeFilterTest, LeansUnderAnAccelerationThatLasts) {
  AttitudeFilter filter(0.2, 0, kDt);
  filter.Restart(Quaterniond::Identity(), Vector3d(0, 0, kG));
  const double seeming = std::atan2(2, kG);
  for (int i = 0; i < 1000; ++i) filter.Step(Vector3d::Zero(), Vector3d(2, 0, kG));
  EXPECT_NEAR(Tilt(filter.R_WI()), seeming * (1 - std::exp(-0.2)), 0.01 * seeming);
}

TEST(AttitudeFilterTest, DoesNotBelieveFlightsAndImpacts) {
  AttitudeFilter filter(0.2, 0.01, kDt);
  filter.Restart(Quaterniond::Identity(), Vector3d(0, 0, kG));
  for (int i = 0; i < 1000; ++i) {
    filter.Step(Vector3d::Zero(), i % 2 == 0 ? Vector3d(1, 0, 0) : Vector3d(30, 0, kG));
  }
  EXPECT_LT(Tilt(filter.R_WI()), 1e-9);
}

// Half of gravity more or less is the end of what it believes.
TEST(AttitudeFilterTest, BelievesItsAccelerometerWithinHalfOfGravity) {
  const auto leans = [](double norm) {
    AttitudeFilter filter(0.2, 0.01, kDt);
    filter.Restart(Quaterniond::Identity(), Vector3d(0, 0, kG));
    const Vector3d tilted = norm * Vector3d(0.1, 0, 1).normalized();
    for (int i = 0; i < 100; ++i) filter.Step(Vector3d::Zero(), tilted);
    return Tilt(filter.R_WI()) > 1e-6;
  };
  EXPECT_FALSE(leans(0.49 * kG));
  EXPECT_TRUE(leans(0.51 * kG));
  EXPECT_TRUE(leans(1.49 * kG));
  EXPECT_FALSE(leans(1.51 * kG));
}

TEST(AttitudeFilterTest, TurnsToTheVerticalAtItsGainHoweverHardItIsPressed) {
  AttitudeFilter filter(0.5, 0, kDt);
  filter.Restart(Quaterniond(AngleAxisd(0.02, Vector3d::UnitX())), Vector3d::Zero());
  for (int i = 0; i < 2000; ++i) filter.Step(Vector3d::Zero(), Vector3d(0, 0, 1.4 * kG));
  EXPECT_NEAR(Tilt(filter.R_WI()), 0.02 * std::exp(-0.5 * 2), 2e-5);
}

TEST(AttitudeFilterTest, ForgetsAtARestartTheBiasThatItHasLearnt) {
  AttitudeFilter filter(0.2, 0.01, kDt);
  filter.Restart(Quaterniond::Identity(), Vector3d(0, 0, kG));
  for (int i = 0; i < 60'000; ++i) filter.Step(Vector3d(0.01, 0, 0), Vector3d(0, 0, kG));
  filter.Restart(Quaterniond::Identity(), Vector3d(0, 0, kG));
  for (int i = 0; i < 100; ++i) filter.Step(Vector3d::Zero(), Vector3d(0, 0, kG));
  EXPECT_LT(Tilt(filter.R_WI()), 1e-12);
}

}  // namespace
}  // namespace understudy::sensors
