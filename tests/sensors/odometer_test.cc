#include "sensors/odometer.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond Heading(double yaw) { return Quaterniond(AngleAxisd(yaw, Vector3d::UnitZ())); }

// Where it says that a robot is after 10 s at 0.5 m/s along its heading, which is told off by `off`
// rad at the end and by as much as the time before.
robot::BaseReading Walk(Odometer* odometer, double yaw, double off) {
  robot::BaseReading truth{.p_WB = {1, 2, 0.3}, .v_WB_W = Heading(yaw) * Vector3d(0.5, 0, 0)};
  odometer->Restart(truth);
  for (int i = 1; i <= 10'000; ++i) {
    truth.p_WB += 0.001 * truth.v_WB_W;
    odometer->Step(truth, Heading(yaw), Heading(yaw + off * i / 10'000));
  }
  return odometer->reading();
}

TEST(OdometerTest, TellsTheTruthBitForBitWithoutErrors) {
  Odometer odometer({}, 0.001);
  const robot::BaseReading truth{.p_WB = {0.1, 0.2, 0.3}, .v_WB_W = {0.4, 0.5, 0.6}};
  odometer.Restart({});
  odometer.Step(truth, Heading(0.7), Heading(0.7));
  EXPECT_EQ(odometer.reading().p_WB, truth.p_WB);
  EXPECT_EQ(odometer.reading().v_WB_W, truth.v_WB_W);
}

TEST(OdometerTest, GoesAstrayWithTheHeadingThatItIsTold) {
  Odometer odometer({}, 0.001);
  const robot::BaseReading told = Walk(&odometer, 0, 0.2);
  // The integral of 0.5 (cos, sin)(0.02 t) from 0 to 10 s.
  EXPECT_NEAR(told.p_WB.x(), 1 + 0.5 * std::sin(0.2) / 0.02, 1e-3);
  EXPECT_NEAR(told.p_WB.y(), 2 + 0.5 * (1 - std::cos(0.2)) / 0.02, 1e-3);
  EXPECT_EQ(told.p_WB.z(), 0.3);
  EXPECT_NEAR(told.v_WB_W.y(), 0.5 * std::sin(0.2), 1e-9);
}

TEST(OdometerTest, StretchesTheWayAlongTheRobotsHeading) {
  Odometer odometer({.odometer = {.scale = 0.1}}, 0.001);
  const double share = Drawn(1, "odometer.scale", "x", 0.1);
  ASSERT_NE(share, 0);
  const robot::BaseReading told = Walk(&odometer, 0.5, 0);
  const Vector3d way = told.p_WB - Vector3d(1, 2, 0.3);
  EXPECT_TRUE(way.isApprox((1 + share) * 5 * Vector3d(std::cos(0.5), std::sin(0.5), 0), 1e-6));
}

TEST(OdometerTest, WalksWithTheRootOfTimeAndBeginsAnewAtTheTruth) {
  double square = 0;
  constexpr int kSeeds = 300;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Odometer odometer({.seed = seed, .odometer = {.walk = 0.01}}, 0.01);
    odometer.Restart({});
    for (int i = 0; i < 400; ++i) odometer.Step({}, Heading(0), Heading(0));
    square += odometer.reading().p_WB.head<2>().squaredNorm() / 2;
    odometer.Restart({});
    EXPECT_TRUE(odometer.reading().p_WB.isZero(0));
  }
  EXPECT_NEAR(std::sqrt(square / kSeeds), 0.02, 0.002);
}

TEST(OdometerTest, StretchesTheWayAsideByAnErrorOfItsOwn) {
  Odometer odometer({.odometer = {.scale = 0.1}}, 0.001);
  const double ahead = Drawn(1, "odometer.scale", "x", 0.1);
  const double aside = Drawn(1, "odometer.scale", "y", 0.1);
  ASSERT_GT(std::abs(ahead - aside), 1e-3);
  const robot::BaseReading truth{.v_WB_W = {0.3, 0.4, 0}};
  odometer.Restart({});
  odometer.Step(truth, Heading(0), Heading(0));
  EXPECT_NEAR(odometer.reading().v_WB_W.x(), (1 + ahead) * 0.3, 1e-12);
  EXPECT_NEAR(odometer.reading().v_WB_W.y(), (1 + aside) * 0.4, 1e-12);
}

TEST(OdometerTest, GoesOnWithOtherErrorsAndKeepsWhatItHasAddedUp) {
  Odometer odometer({.odometer = {.scale = 0.1}}, 0.001);
  const robot::BaseReading truth{.v_WB_W = {0.3, 0.4, 0}};
  odometer.Restart({});
  for (int i = 0; i < 100; ++i) odometer.Step(truth, Heading(0), Heading(0));
  const Vector3d off = odometer.reading().p_WB - truth.p_WB;
  ASSERT_GT(off.norm(), 1e-4);
  odometer.Apply({});
  odometer.Step(truth, Heading(0), Heading(0));
  EXPECT_EQ(odometer.reading().v_WB_W, truth.v_WB_W);
  EXPECT_EQ(odometer.reading().p_WB - truth.p_WB, off);
}

}  // namespace
}  // namespace understudy::sensors
