// Faults that the configuration plans: when they begin and end; and a mainboard that comes back.
#include <cstddef>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

using PlannedFaultsTest = EmulatorTest;

TEST_F(PlannedFaultsTest, BeginAtTheirTimeAndEndAfterIt) {
  config_.robots[0].faults = {
      {.component = "imu", .fault = "off"},
      {.component = "battery", .fault = "weak", .at = 0.02, .times = {.lasts = 0.01}}};
  StartAs("clamped");
  Tick();
  EXPECT_TRUE(robot().faults().effects().imus[0].dead);
  EXPECT_EQ(robot().faults().effects().battery.resistance, 1);
  Tick(24);
  EXPECT_EQ(robot().faults().effects().battery.resistance, 3);
  Tick(10);
  EXPECT_EQ(robot().faults().effects().battery.resistance, 1);
  EXPECT_TRUE(robot().faults().effects().imus[0].dead);
  EXPECT_EQ(Told(EventKind::kFault).size(), 3U);
}

TEST_F(PlannedFaultsTest, ComeAlthoughAllThereWereAreTakenAway) {
  config_.robots[0].faults = {{.component = "imu", .fault = "off", .at = 0.02}};
  StartAs("clamped");
  Ask("fault", {{"component", "all"}, {"fault", "none"}});
  Tick(30);
  EXPECT_TRUE(robot().faults().effects().imus[0].dead);
}

TEST_F(PlannedFaultsTest, AreRefusedWhereTheRobotHasNoSuchComponent) {
  config_.robots[0].faults = {{.component = "imv", .fault = "off"}};
  EXPECT_THROW(Start(), ConfigError);
}

TEST_F(PlannedFaultsTest, OfTheMainboardSilenceTheRobotUntilItHasBootedAgain) {
  config_.robots[0].spec.boot = {.states = 0.05, .services = 0.06, .motion = 0.07};
  config_.robots[0].faults = {
      {.component = "mainboard", .fault = "off", .at = 0.1, .times = {.lasts = 0.1}}};
  StartAs("clamped");
  port_.SendEveryTick(Torque(1));
  Tick(90);
  EXPECT_NE(robot().torque()[0], 0);
  const std::size_t before = port_.samples().size();
  Tick(60);
  const std::size_t dead = port_.samples().size();
  EXPECT_LE(dead, before + 6);
  EXPECT_EQ(robot().torque()[0], 0);
  EXPECT_EQ(Answered("power", {{"on", true}}), "its mainboard is off");
  Tick(94);
  EXPECT_EQ(port_.samples().size(), dead);
  Tick(40);
  EXPECT_GT(port_.samples().size(), dead + 5);
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOn);
}

}  // namespace
}  // namespace understudy::emulator
