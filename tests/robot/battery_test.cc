#include "robot/battery.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

// 40 V full, 30 V empty, 1 ohm, 10 Ah.
BatterySpec Pack() {
  return {.cells = 10,
          .capacity_ah = 10,
          .start_soc = 1,
          .cell_v = {3, 3.1, 3.2, 3.3, 3.4, 3.5, 3.6, 3.7, 3.8, 3.9, 4},
          .internal_ohm = 1,
          .cell_spread = 0};
}

void Draw(Battery* battery, double power, double dt = 1e-9) { battery->Step(power, dt); }

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
  Draw(&battery, 0);
  EXPECT_EQ(battery.reading().current, -2);
  EXPECT_EQ(battery.reading().voltage, 38);
}

// 144 W are 4 A at 36 V, and 4 A cost 4 V at 1 ohm: of this instant, not of the step before.
TEST(BatteryTest, GivesThePowerOfTheMotors) {
  Battery battery(Pack());
  Draw(&battery, 144);
  EXPECT_NEAR(battery.reading().current, -4, 1e-9);
  EXPECT_NEAR(battery.reading().voltage, 36, 1e-9);
}

// -144 W of a pack at 36 V are 3.6 A, of one without resistance 4 A.
TEST(BatteryTest, IsChargedByBrakingMotors) {
  BatterySpec spec = Pack();
  spec.start_soc = 0.6;
  spec.internal_ohm = 0;
  Battery battery(spec);
  Draw(&battery, -144, 3600);
  EXPECT_NEAR(battery.reading().current, 4, 1e-9);
  EXPECT_NEAR(battery.reading().soc, 1, 1e-9);
}

TEST(BatteryTest, TakesNoMoreThanWouldBringItOverTheVoltageOfFullCells) {
  Battery battery(Pack());
  Draw(&battery, -500);
  EXPECT_EQ(battery.reading().voltage, 40);
  EXPECT_EQ(battery.reading().current, 0);
  BatterySpec spec = Pack();
  spec.start_soc = 0.8;  // 38 V
  Battery lower(spec);
  Draw(&lower, -500);
  EXPECT_EQ(lower.reading().voltage, 40);
  EXPECT_NEAR(lower.reading().current, 2, 1e-9);
}

TEST(BatteryTest, LosesItsChargeByCurrentAndTime) {
  BatterySpec spec = Pack();
  spec.idle_a = 1;
  Battery battery(spec);
  Draw(&battery, 0, 3600);  // 1 of 10 Ah
  EXPECT_NEAR(battery.reading().soc, 0.9, 1e-12);
}

TEST(BatteryTest, FallsWithItsCharge) {
  BatterySpec spec = Pack();
  spec.idle_a = 1;
  Battery battery(spec);
  Draw(&battery, 0, 5 * 3600);
  Draw(&battery, 0);
  EXPECT_NEAR(battery.reading().voltage, 34, 1e-6);  // 35 V less 1 V at 1 ohm
}

TEST(BatteryTest, FollowsTheVoltageOfItsCellsOverCharge) {
  BatterySpec spec = Pack();
  spec.cell_v = {2, 3.4, 3.5, 3.6, 3.65, 3.7, 3.75, 3.8, 3.9, 4, 4.2};
  const auto voltage = [&](double soc) {
    spec.start_soc = soc;
    return Battery(spec).reading().voltage;
  };
  EXPECT_EQ(voltage(1), 42);
  EXPECT_NEAR(voltage(0.95), 41, 1e-9);
  EXPECT_NEAR(voltage(0.05), 27, 1e-9);
  EXPECT_EQ(voltage(0), 20);
}

TEST(BatteryTest, CutsOffWhenItIsEmptyAndStaysSo) {
  BatterySpec spec = Pack();
  spec.idle_a = 1;
  Battery battery(spec);
  for (int i = 0; i < 20; ++i) Draw(&battery, 0, 3600);
  EXPECT_EQ(battery.reading().soc, 0);
  EXPECT_EQ(battery.cut_off(), CutOff::kEmpty);
  EXPECT_EQ(battery.reading().current, 0);
  EXPECT_EQ(battery.reading().voltage, 30);  // of its cells
  EXPECT_FALSE(battery.supply().on);
  EXPECT_EQ(battery.supply().voltage, 0);
  battery.Restart();
  EXPECT_EQ(battery.cut_off(), CutOff::kEmpty);
}

// No pack gives more than at half its voltage: 40 V, 1 ohm, 20 A, 400 W.
TEST(BatteryTest, GivesNoMoreThanHalvesItsVoltage) {
  Battery battery(Pack());
  EXPECT_NEAR(battery.supply().most_power, 400, 1e-9);
  for (const double power : {400.0, 420.0, 2e4, 2e7}) {
    Draw(&battery, power);
    EXPECT_NEAR(battery.reading().voltage, 20, 1e-6) << power;
    EXPECT_NEAR(battery.reading().current, -20, 1e-6) << power;
  }
  Draw(&battery, 0);
  EXPECT_NEAR(battery.reading().voltage, 40, 1e-6);
}

// 5 A cost 5 V: 35 V, of whose current 1 A is not the motors'.
TEST(BatteryTest, HasNoMorePowerForItsMotorsThanItsMostCurrentGives) {
  BatterySpec spec = Pack();
  spec.most_a = 5;
  spec.idle_a = 1;
  Battery battery(spec);
  EXPECT_NEAR(battery.supply().most_power, 35 * 4, 1e-9);
  Draw(&battery, battery.supply().most_power);
  EXPECT_NEAR(battery.reading().current, -5, 1e-9);
}

TEST(BatteryTest, HasLessPowerAndVoltageForItsMotorsTheOlderItIs) {
  Battery battery(Pack());
  battery.Step(100, 1, {.resistance = 4});
  EXPECT_NEAR(battery.supply().most_power, 100, 0.2);
  for (int i = 0; i < 100; ++i) battery.Step(100, 0.01, {.resistance = 4});
  EXPECT_NEAR(battery.supply().voltage, 20, 0.2);
}

TEST(BatteryTest, ShowsItsVoltageToTheDrivesWithALag) {
  Battery battery(Pack());
  battery.Step(144, 0.001);
  EXPECT_NEAR(battery.reading().voltage, 36, 1e-3);
  EXPECT_NEAR(battery.supply().voltage, 40 - 4.0 / 21, 1e-3);
  for (int i = 0; i < 200; ++i) battery.Step(144, 0.001);
  EXPECT_NEAR(battery.supply().voltage, 36, 0.01);
}

// 10 A are twice the limit, so that their mean passes it after ln(2) time constants.
TEST(BatteryTest, CutsOffAfterTooMuchCurrentForTooLong) {
  BatterySpec spec = Pack();
  spec.cutoff_a = 5;
  spec.cutoff_time = 2;
  Battery battery(spec);
  int steps = 0;
  while (battery.cut_off() == CutOff::kNone && steps < 10000) {
    battery.Step(300, 0.001);  // 10 A at 30 V
    ++steps;
  }
  EXPECT_EQ(battery.cut_off(), CutOff::kOvercurrent);
  EXPECT_NEAR(steps * 0.001, 2 * std::log(2), 0.01);
  battery.Step(300, 0.001);
  EXPECT_EQ(battery.reading().current, 0);
  battery.Restart();
  EXPECT_EQ(battery.cut_off(), CutOff::kNone);
  EXPECT_TRUE(battery.supply().on);
  battery.Step(300, 0.001);
  EXPECT_EQ(battery.cut_off(), CutOff::kNone) << "its mean begins anew";
}

TEST(BatteryTest, TakesNoLoadWhileItIsSwitchedOff) {
  Battery battery(Pack());
  battery.Step(300, 0.001);
  battery.SwitchOff();
  EXPECT_EQ(battery.reading().current, 0);
  EXPECT_NEAR(battery.reading().voltage, 40, 1e-3);
  battery.Step(300, 0.001);
  EXPECT_NEAR(battery.reading().current, -10, 1e-3);
}

TEST(BatteryTest, BearsShortPeaksOfCurrent) {
  BatterySpec spec = Pack();
  spec.cutoff_a = 5;
  spec.cutoff_time = 2;
  Battery battery(spec);
  for (int i = 0; i < 20000; ++i) battery.Step(i % 1000 < 300 ? 300 : 0, 0.001);  // mean 3 A
  EXPECT_EQ(battery.cut_off(), CutOff::kNone);
}

TEST(BatteryTest, CutsOffForItsWeakestCell) {
  BatterySpec spec = Pack();
  spec.cutoff_v = 2.999;
  spec.capacity_ah = 1e6;
  spec.start_soc = 0.5;  // 35 V
  Battery even(spec);
  spec.cell_spread = 0.001;
  Battery uneven(spec);
  for (int i = 0; i < 60000; ++i) {
    even.Step(150, 0.001);  // 5 A at 30 V: 3 V a cell, and the end cells have less
    uneven.Step(150, 0.001);
  }
  EXPECT_EQ(even.cut_off(), CutOff::kNone);
  EXPECT_EQ(uneven.cut_off(), CutOff::kUndervoltage);
}

TEST(BatteryTest, HasCellsThatDifferByTheSeed) {
  BatterySpec spec = Pack();
  spec.cell_spread = 0.0004;
  const auto off = [&](int seed) { return Battery(spec, 25, seed).reading().cell_off_v; };
  EXPECT_EQ(off(1), off(1));
  EXPECT_NE(off(1), off(2));
  double sum = 0;
  for (const double cell : off(1)) sum += cell;
  EXPECT_NEAR(sum, 0, 1e-12);
  for (int seed = 1; seed < 50; ++seed) {
    const auto cells = off(seed);
    for (std::size_t i = 1; i < 9; ++i) {
      EXPECT_LT(cells[0], cells[i]);
      EXPECT_LT(cells[9], cells[i]);
      EXPECT_NEAR(cells[i] - cells[0], 0.008, 0.008);
    }
  }
  spec.cell_spread = 0;
  for (const double cell : off(1)) EXPECT_EQ(cell, 0);
}

// 4 A are 16 W, which warm it by 8 °C in the end.
TEST(BatteryTest, WarmsByWhatItLoses) {
  BatterySpec spec = Pack();
  spec.capacity_ah = 1e6;
  spec.rise_per_w_c = 0.5;
  spec.time_constant = 100;
  Battery battery(spec, 20);
  EXPECT_EQ(battery.reading().temperature_c, 20);
  for (int i = 0; i < 10000; ++i) battery.Step(144, 0.01);
  EXPECT_NEAR(battery.reading().temperature_c, 20 + 8 * (1 - std::exp(-1)), 0.01);
}

TEST(BatteryTest, IsWhatItWasAfterPhysicsThatDiverge) {
  for (const double power : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300}) {
    Battery battery(Pack());
    Draw(&battery, power, 1);
    EXPECT_EQ(battery.reading().soc, 1);
    EXPECT_EQ(battery.reading().voltage, 40);
    EXPECT_EQ(battery.reading().current, 0);
  }
}

TEST(BatteryTest, HasNoMoreChargeThanAFaultLeavesIt) {
  Battery battery(Pack());
  battery.Step(0, 0.001, {.most_charge = 0.25});
  EXPECT_EQ(battery.reading().soc, 0.25);
  battery.Step(0, 0.001);
  EXPECT_EQ(battery.reading().soc, 0.25);  // what went is gone
}

TEST(BatteryTest, IsLowBelowItsLowCharge) {
  BatterySpec spec = Pack();
  spec.start_soc = 0.2;
  EXPECT_FALSE(Battery(spec).low());
  spec.start_soc = 0.19;
  EXPECT_TRUE(Battery(spec).low());
}

TEST(BatteryTest, KeepsItsVoltageWithoutResistance) {
  BatterySpec spec = Pack();
  spec.internal_ohm = 0;
  Battery battery(spec);
  Draw(&battery, 1e6);
  EXPECT_NEAR(battery.reading().voltage, 40, 1e-6);
  EXPECT_NEAR(battery.reading().current, -25000, 1e-6);
  EXPECT_EQ(battery.supply().most_power, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace understudy::robot
