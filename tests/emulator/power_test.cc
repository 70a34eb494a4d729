// What load does to motors and battery, and what becomes of the robot then.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

class PowerTest : public EmulatorTest {
 protected:
  PowerTest() {
    port_.TellEvery(1);
    config_.robots[0].start.pose = "clamped";
  }

  const robot::RobotState& state() { return port_.last().state; }

  std::vector<Event> Events(EventKind kind) const {
    std::vector<Event> events;
    EventRing::Reader reader(&world_->events());
    for (Event event; reader.Next(&event);) {
      if (event.kind == kind) events.push_back(event);
    }
    return events;
  }
};

TEST_F(PowerTest, AStalledMotorGetsHotAndTripsAndSaysSo) {
  config_.robots[0].spec.motors[0].torque_limit = 140;
  config_.robots[0].spec.motor_types[0].winding_time = 1;
  config_.robots[0].spec.motor_types[0].winding_c_per_w = 0.1;
  config_.robots[0].spec.battery.internal_ohm = 0;
  Start();
  Ask("fault", {{"component", "FR_joint"}, {"fault", "jammed"}});
  double warm = -1, hot = -1;
  bool tripped = false;
  for (int i = 0; i < 6000; ++i) {
    if (i % 50 == 0) {
      robot::RobotCommand command = Torque(0);
      command.motors[0].tau = 200;
      port_.Send(command);
    }
    Tick();
    if (warm < 0 && state().motors[0].warm) warm = world_->time();
    if (tripped) {
      EXPECT_EQ(state().motors[0].tau, 0);
    }
    tripped = state().motors[0].overheated;
    if (hot < 0 && state().motors[0].overheated) hot = world_->time();
  }
  EXPECT_GT(warm, 0.2);
  EXPECT_GT(hot, warm);
  EXPECT_LT(hot, 6);
  EXPECT_FALSE(state().motors[1].warm);
  const std::vector<Event> told = Events(EventKind::kMotorHeat);
  ASSERT_GE(told.size(), 2U);
  EXPECT_EQ(told[0].numbers[0], 1);
  EXPECT_EQ(told[1].numbers[0], 2);
  EXPECT_GE(told[1].numbers[1], 120);
  EXPECT_STREQ(told[1].text.data(), "FR_joint");
}

TEST_F(PowerTest, ABatteryThatRunsLowIsToldOnceAndOneThatIsEmptyTakesTheTorque) {
  config_.robots[0].spec.battery.start_soc = 0.2001;
  config_.robots[0].spec.battery.low_soc = 0.2;
  config_.robots[0].spec.battery.capacity_ah = 0.001;
  Start();
  port_.Send(Torque(5));
  Tick(3);
  EXPECT_NEAR(state().motors[0].tau, 5, 1e-9);
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOn);
  for (int i = 0; i < 1000; ++i) {
    if (i % 50 == 0) port_.Send(Torque(5));
    Tick();
  }
  EXPECT_LT(state().battery.soc, 1e-3);
  EXPECT_EQ(robot().torque()[0], 0);
  ASSERT_EQ(Events(EventKind::kLowBattery).size(), 1U);
  const std::vector<Event> cut_off = Events(EventKind::kCutOff);
  ASSERT_EQ(cut_off.size(), 1U);
  EXPECT_EQ(cut_off[0].numbers[0], static_cast<double>(robot::CutOff::kEmpty));
}

TEST_F(PowerTest, ABatteryThatHasCutOffIsOnAgainAfterAReset) {
  config_.robots[0].spec.battery.cutoff_a = 1.2;
  config_.robots[0].spec.battery.cutoff_time = 0.01;
  Start();
  port_.Send(Torque(20));
  Tick(100);
  const std::size_t before = port_.samples().size();
  Tick(10);
  EXPECT_EQ(port_.samples().size(), before) << "it is dark";
  Ask("reset", {});
  Tick(2);
  EXPECT_EQ(port_.samples().size(), before + 2);
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOn);
  const std::vector<Event> told = Events(EventKind::kCutOff);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].numbers[0], static_cast<double>(robot::CutOff::kOvercurrent));
  EXPECT_EQ(told[1].numbers[0], 0);
}

TEST_F(PowerTest, SwitchedOffItIsDarkAndLimpAndDeaf) {
  Start();
  port_.Send(Torque(5));
  Tick(3);
  EXPECT_NE(robot().torque()[0], 0);
  const std::size_t before = port_.samples().size();
  EXPECT_EQ(Answered("power", {{"on", false}}), "");
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOff);
  port_.Send(Torque(5));
  Tick(100);
  EXPECT_TRUE(port_.idle()) << "what waits now must not be followed later";
  EXPECT_EQ(robot().torque()[0], 0);
  EXPECT_EQ(port_.samples().size(), before);
  EXPECT_TRUE(services_.suffers().absent);
  EXPECT_EQ(world_->status(0).commands.accepted, 1U);
  EXPECT_EQ(Told(EventKind::kPower), std::vector<std::string>{"power: off"});
}

TEST_F(PowerTest, NothingThatWasUnderWayWhenItWasSwitchedOffIsFollowedLater) {
  config_.robots[0].spec.boot = {.states = 0.01, .services = 0.02, .motion = 0.03};
  Start();
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "delayed"}, {"by", 0.2}});
  Tick();
  port_.Send(Torque(5));
  Tick(5);
  Ask("power", {{"on", false}});
  Tick();
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "none"}});
  Tick();
  Ask("power", {{"on", true}});
  Tick(1000);
  ASSERT_EQ(world_->status(0).power, robot::PowerState::kOn);
  EXPECT_EQ(world_->status(0).commands.accepted, 0U);
  EXPECT_EQ(robot().torque()[0], 0);
}

TEST_F(PowerTest, SwitchedOnItFollowsNoCommandThatASlowBusStillCarried) {
  config_.robots[0].spec.boot = {.states = 0.01, .services = 0.02, .motion = 0.03};
  config_.robots[0].spec.buses = {
      {.name = "leg", .slots = {config_.robots[0].spec.motors[0].slot}}};
  Start();
  Ask("fault", {{"component", "bus.leg"}, {"fault", "slow"}, {"by", 0.05}});
  Tick();
  port_.Send(Torque(3));
  Tick(2);
  Ask("power", {{"on", false}});
  Tick(5);
  Ask("power", {{"on", true}});
  for (int i = 0; i < 100; ++i) {
    Tick();
    ASSERT_EQ(robot().command().motors[0].tau, 0) << i;
  }
}

TEST_F(PowerTest, SwitchedOffItTakesNothingFromItsPack) {
  config_.robots[0].spec.battery.idle_a = 2;
  Start();
  Tick(10);
  EXPECT_GT(robot().damage().energy, 0);
  Ask("power", {{"on", false}});
  Tick();
  const double before = robot().damage().energy;
  Tick(100);
  EXPECT_EQ(robot().damage().energy, before);
  Ask("power", {{"on", true}});
  Tick(10);
  EXPECT_GT(robot().damage().energy, before);
}

TEST_F(PowerTest, SwitchedOnItComesUpStepByStep) {
  config_.robots[0].spec.boot = {.states = 0.1, .services = 0.2, .motion = 0.3};
  Start();
  Tick(50);
  Ask("power", {{"on", false}});
  Tick(50);
  const std::size_t before = port_.samples().size();
  Ask("power", {{"on", true}});
  Tick(95);
  EXPECT_EQ(port_.samples().size(), before);
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kBooting);
  Tick(10);
  EXPECT_GT(port_.samples().size(), before);
  EXPECT_NEAR(static_cast<double>(state().tick_ms), 104, 2) << "counts from the switch";
  EXPECT_TRUE(services_.suffers().absent);
  Tick(100);
  EXPECT_FALSE(services_.suffers().absent);
  Tick(100);
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOn);
  EXPECT_EQ(Told(EventKind::kPower),
            (std::vector<std::string>{"power: off", "power: booting", "power: on"}));
  EXPECT_EQ(Answered("power", {{"on", true}}), "") << "it is on";
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOn);
}

TEST_F(PowerTest, TheMotionServiceStartsAtTheEndOfTheBootUnlessItWasToldNotTo) {
  config_.robots[0].spec.services = {{.name = "sport_mode", .alias = "normal"}};
  config_.robots[0].spec.boot = {.states = 0.01, .services = 0.02, .motion = 0.03};
  Start();
  const auto boot = [&] {
    Ask("power", {{"on", false}});
    const std::size_t told = Told(EventKind::kMotionService).size();
    Tick(5);
    EXPECT_EQ(robot().owner().active(), "");
    EXPECT_EQ(Told(EventKind::kMotionService).size(), told) << "while it is off, nothing follows";
    Ask("power", {{"on", true}});
    Tick(25);
    EXPECT_EQ(robot().owner().active(), "");
    Tick(25);
    return std::string(robot().owner().active());
  };
  Tick();
  EXPECT_EQ(boot(), "normal");
  EXPECT_EQ(Told(EventKind::kMotionService),
            (std::vector<std::string>{"motion service normal moves the motors",
                                      "no motion service is on: motors follow rt/lowcmd",
                                      "motion service normal moves the motors"}));
  services_.Call([](authority::MotorOwner* owner) { owner->onboard().silent = true; });
  Tick();
  EXPECT_EQ(boot(), "") << "motion_switcher's SetSilent";
}

TEST_F(PowerTest, AResetBringsBackTheMotionServiceOfARobotThatWasSwitchedOffWhileItBooted) {
  config_.robots[0].spec.services = {{.name = "sport_mode", .alias = "normal"}};
  config_.robots[0].spec.boot = {.states = 0.1, .services = 0.2, .motion = 0.3};
  Start();
  Tick();
  for (const bool on : {false, true, false}) {
    Ask("power", {{"on", on}});
    Tick(5);
  }
  ASSERT_EQ(robot().owner().active(), "");
  Ask("reset", {});
  Tick();
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOn);
  EXPECT_EQ(robot().owner().active(), "normal");
}

TEST_F(PowerTest, ARunMayBeginAtTheSwitch) {
  config_.robots[0].spec.boot = {.states = 0.1, .services = 0.2, .motion = 0.3};
  config_.robots[0].start.boot = true;
  Start();
  Tick(90);
  EXPECT_TRUE(port_.samples().empty());
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kBooting);
  Ask("reset", {});
  Tick(3);
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOn) << "a reset has it booted";
  EXPECT_FALSE(port_.samples().empty());
}

TEST_F(PowerTest, AnEmptyBatteryDoesNotSwitchOn) {
  config_.robots[0].spec.battery.start_soc = 1e-4;
  config_.robots[0].spec.battery.capacity_ah = 0.001;
  Start();
  Tick(200);
  ASSERT_EQ(world_->status(0).power, robot::PowerState::kOff);
  EXPECT_EQ(Answered("power", {{"on", true}}), "the battery is empty");
  EXPECT_EQ(world_->status(0).power, robot::PowerState::kOff);
}

TEST_F(PowerTest, AWeakBatteryWeakensTheMotors) {
  config_.robots[0].spec.battery.most_a = 0;
  config_.robots[0].spec.motor_types[0].rated_v = 35;
  Start();
  port_.Send(Torque(1000));
  Tick(100);
  const double strong = std::abs(state().motors[0].tau);
  Ask("fault", {{"component", "battery"}, {"fault", "weak"}, {"by", 50}});
  Tick(100);
  EXPECT_LT(std::abs(state().motors[0].tau), 0.8 * strong);
}

// What follows from the voltage of the bus, and from nothing else, while messages still come.
TEST_F(PowerTest, APackThatSagsTellsABusWithoutVoltageAndRecovers) {
  config_.robots[0].spec.battery.most_a = 0;
  config_.robots[0].spec.battery.cutoff_a = 0;
  config_.robots[0].spec.motor_types[0].rated_v = 35;
  Start();
  Ask("fault", {{"component", "battery"}, {"fault", "weak"}, {"by", 50}});
  port_.Send(Torque(1000));
  Tick(100);
  ASSERT_EQ(world_->status(0).power, robot::PowerState::kOn);
  EXPECT_LT(state().battery.voltage, robot::MotorBank::kLeastVoltage * 35);
  EXPECT_TRUE(state().motors[0].undervoltage);
  port_.Send(Torque(0));
  Tick(100);
  EXPECT_GT(state().battery.voltage, robot::MotorBank::kLeastVoltage * 35);
  EXPECT_FALSE(state().motors[0].undervoltage);
}

TEST_F(PowerTest, FrictionWarmsACasing) {
  config_.robots[0].spec.motor_types[0].casing_time = 0.5;
  config_.robots[0].spec.motor_types[0].casing_c_per_w = 50;
  Start();
  const double rest = 25;
  Ask("fault", {{"component", "FR_joint"}, {"fault", "dragging"}, {"by", 2}});
  for (int i = 0; i < 2000; ++i) {
    if (i % 50 == 0) port_.Send(Torque(i % 400 < 200 ? 5 : -5));
    Tick();
  }
  EXPECT_GT(state().motors[0].casing_c, rest + 3);
  EXPECT_LT(state().motors[1].casing_c, rest + 3);
}

}  // namespace
}  // namespace understudy::emulator
