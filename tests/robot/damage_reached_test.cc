#include "robot/damage_reached.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string MarkAt(double value, double limit) {
  return std::string(
      NameOf(ReachedOf({"worst_tilt", limit, "rad", ""}, {.worst_tilt = value}, {}).mark));
}

TEST(DamageReachedTest, AFigureIsNearFromFourFifthsOfItsLimitOnAndBeyondItAboveIt) {
  EXPECT_EQ(MarkAt(0.79, 1), "ok");
  EXPECT_EQ(MarkAt(0.81, 1), "near");
  EXPECT_EQ(MarkAt(1, 1), "near");
  EXPECT_EQ(MarkAt(1.01, 1), "beyond");
  EXPECT_EQ(MarkAt(1.01, kNone), "ok");
}

TEST(DamageReachedTest, OneFallIsBeyondTheLimitOfNone) {
  const DamageLimit falls{"falls", 0, "", ""};
  EXPECT_EQ(ReachedOf(falls, {.falls = 0}, {}).mark, DamageMark::kOk);
  EXPECT_EQ(ReachedOf(falls, {.falls = 1}, {}).mark, DamageMark::kBeyond);
}

TEST(DamageReachedTest, OfMotorsTheOneThatIsWorstByItsOwnLimitCounts) {
  const DamageTotals sheet{.motors = {{.largest_jump = 0.5}, {.largest_jump = 0.4}}};
  const DamageReached reached =
      ReachedOf({"largest_jump", kNone, "rad", ""}, sheet, {{.jump = 1}, {.jump = 0.3}});
  EXPECT_EQ(reached.motor, 1U);
  EXPECT_EQ(reached.value, 0.4);
  EXPECT_EQ(reached.limit, 0.3);
  EXPECT_EQ(reached.mark, DamageMark::kBeyond);
}

TEST(DamageReachedTest, AnyTimeAtALimitIsBeyondItAndIsInSeconds) {
  const DamageLimit limit{"at_torque_limit", kNone, "N·m", ""};
  const std::vector<MotorLimits> motors = {{.torque = 23}, {.torque = 45}};
  EXPECT_EQ(ReachedOf(limit, {.motors = {{}, {}}}, motors).motor, std::nullopt);
  const DamageReached reached =
      ReachedOf(limit, {.motors = {{}, {.at_torque_limit = 0.02}}}, motors);
  EXPECT_EQ(reached.mark, DamageMark::kBeyond);
  EXPECT_EQ(reached.unit, "s");
  EXPECT_EQ(reached.limit, 45);
  EXPECT_EQ(reached.motor, 1U);
}

TEST(DamageReachedTest, AMotorHasTheWorstMarkOfItsFigures) {
  const std::vector<DamageLimit> limits = {
      {"shock", 1, "m/s²", ""}, {"hottest", 100, "°C", ""}, {"largest_jump", kNone, "rad", ""}};
  EXPECT_EQ(WorstMark({.hottest_c = 50}, {}, limits), DamageMark::kOk);
  EXPECT_EQ(WorstMark({.hottest_c = 90}, {}, limits), DamageMark::kNear);
  EXPECT_EQ(WorstMark({.hottest_c = 90, .largest_jump = 2}, {.jump = 1}, limits),
            DamageMark::kBeyond);
  // A jump of which no limit is known is none.
  EXPECT_EQ(WorstMark({.largest_jump = 2}, {}, limits), DamageMark::kOk);
}

}  // namespace
}  // namespace understudy::robot
