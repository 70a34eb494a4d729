#include "robot/battery.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

// 40 V full, 30 V empty, 1 ohm, 10 Ah.
BatterySpec Pack() {
  return {.cells = 10,
          .capacity_ah = 10,
          .start_soc = 1,
          .cell_full_v = 4,
          .cell_empty_v = 3,
          .internal_ohm = 1};
}

void Draw(Battery* battery, double tau, double dq, double dt = 1e-9) {
  battery->Step(std::vector{tau}, std::vector{dq}, dt);
}

TEST(BatteryTest, StartsAtItsStartCharge) {
  BatterySpec spec = Pack();
  spec.start_soc = 0.5;
  const Battery battery(spec);
  EXPECT_EQ(battery.reading().soc, 0.5);
  EXPECT_EQ(battery.reading().voltage, 35);
  EXPECT_EQ(battery.reading().current, 0);
}

TEST(BatteryTest, DrawsItsIdleCurrentFromTheStart) {
  BatterySpec spec = Pack();
  spec.idle_a = 2;
  Battery battery(spec);
  EXPECT_EQ(battery.reading().current, -2);
  EXPECT_EQ(battery.reading().voltage, 38);
  Draw(&battery, 0, 0);
  EXPECT_EQ(battery.reading().current, -2);
  EXPECT_EQ(battery.reading().voltage, 38);
}

// 144 W are 4 A at 36 V, and 4 A cost 4 V at 1 ohm: of this instant, not of the step before.
TEST(BatteryTest, GivesThePowerOfTheMotors) {
  Battery battery(Pack());
  Draw(&battery, 12, 12);
  EXPECT_NEAR(battery.reading().current, -4, 1e-9);
  EXPECT_NEAR(battery.reading().voltage, 36, 1e-9);
}

TEST(BatteryTest, TakesNothingBackFromABrakingMotor) {
  Battery battery(Pack());
  Draw(&battery, 12, -12);
  EXPECT_EQ(battery.reading().current, 0);
  EXPECT_EQ(battery.reading().voltage, 40);
}

TEST(BatteryTest, LetsBrakingMotorsFeedDrivingOnes) {
  Battery battery(Pack());
  battery.Step(std::vector<double>{20, 16}, std::vector<double>{10, -3.5}, 1e-9);  // 200 W - 56 W
  EXPECT_NEAR(battery.reading().current, -4, 1e-9);
}

TEST(BatteryTest, HeatsBySquareOfTorque) {
  BatterySpec spec = Pack();
  spec.watt_per_nm2 = 0.5;
  Battery battery(spec);
  battery.Step(std::vector<double>{-12, 12}, std::vector<double>{0, 0}, 1e-9);  // 72 W each
  EXPECT_NEAR(battery.reading().current, -4, 1e-9);
}

TEST(BatteryTest, LosesItsChargeByCurrentAndTime) {
  BatterySpec spec = Pack();
  spec.idle_a = 1;
  Battery battery(spec);
  Draw(&battery, 0, 0, 3600);  // 1 of 10 Ah
  EXPECT_NEAR(battery.reading().soc, 0.9, 1e-12);
}

TEST(BatteryTest, FallsWithItsCharge) {
  BatterySpec spec = Pack();
  spec.idle_a = 1;
  Battery battery(spec);
  Draw(&battery, 0, 0, 5 * 3600);
  Draw(&battery, 0, 0);
  EXPECT_NEAR(battery.reading().voltage, 34, 1e-6);  // 35 V less 1 V at 1 ohm
}

TEST(BatteryTest, StaysEmptyAndGoesOn) {
  BatterySpec spec = Pack();
  spec.idle_a = 1;
  Battery battery(spec);
  for (int i = 0; i < 20; ++i) Draw(&battery, 0, 0, 3600);
  EXPECT_EQ(battery.reading().soc, 0);
  EXPECT_EQ(battery.reading().voltage, 29);
  EXPECT_EQ(battery.reading().current, -1);
}

// No pack gives more than at half its voltage: 40 V, 1 ohm, 20 A, 400 W.
TEST(BatteryTest, GivesNoMoreThanHalvesItsVoltage) {
  Battery battery(Pack());
  for (const double tau : {20.0, 21.0, 1e3, 1e6}) {
    Draw(&battery, tau, 20);
    EXPECT_NEAR(battery.reading().voltage, 20, 1e-6) << tau;
    EXPECT_NEAR(battery.reading().current, -20, 1e-6) << tau;
  }
  Draw(&battery, 0, 0);
  EXPECT_NEAR(battery.reading().voltage, 40, 1e-6);
}

TEST(BatteryTest, NeverCharges) {
  Battery battery(Pack());
  double before = battery.reading().soc;
  for (int i = 0; i < 1000; ++i) {
    Draw(&battery, 100 * std::sin(i), 50, 0.001);
    ASSERT_LE(battery.reading().soc, before);
    ASSERT_LE(battery.reading().current, 0);
    before = battery.reading().soc;
  }
}

TEST(BatteryTest, KeepsItsVoltageWithoutResistance) {
  BatterySpec spec = Pack();
  spec.internal_ohm = 0;
  Battery battery(spec);
  Draw(&battery, 1000, 1000);
  EXPECT_NEAR(battery.reading().voltage, 40, 1e-6);
  EXPECT_NEAR(battery.reading().current, -25000, 1e-6);
}

}  // namespace
}  // namespace understudy::robot
