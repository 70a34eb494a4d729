// The computer of the fixture robot, without physics.
#include "emulator/computer.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/fake_port.h"
#include "tests/support/fixture_robot.h"

namespace understudy::emulator {
namespace {

class ComputerTest : public ::testing::Test {
 protected:
  static robot::RobotCommand Torque(double tau) {
    return {.motors = std::vector<robot::MotorCommand>(6, {.enabled = true, .tau = tau})};
  }
  const robot::RobotCommand& Tick() {
    const double t = static_cast<double>(++step_) * kDt;
    computer_.TakeCommands(t);
    return computer_.Command(step_, t);
  }
  // As the sensors write it.
  void Sample(double q) {
    robot::RobotState* const state = computer_.BeginSample(step_);
    state->motors.assign(6, {.q = q});
    state->foot_force.assign(4, q);
  }

  static constexpr double kDt = 0.001;
  const robot::RobotSpec spec_ = [] {
    robot::RobotSpec spec = test::FixtureRobot();
    spec.boot = {.states = 0.01, .services = 0.02, .motion = 0.03};
    return spec;
  }();
  test::FakePort port_;
  const robot::FaultBank faults_{
      spec_, std::vector<std::string>(robot::CommandTopicNames(spec_).size() + 1), {}, 1};
  EventRing ring_;
  RobotEvents events_{spec_, 0, &ring_};
  Computer computer_{spec_, RobotSettings{}, {.topics = &port_}, faults_, Torque(0), nullptr,
                     kDt,   &events_};
  std::int64_t step_ = 0;
};

TEST_F(ComputerTest, SendsTheMotorsTheCommandThatItTakes) {
  EXPECT_EQ(Tick().motors, Torque(0).motors);
  port_.Send(Torque(3));
  EXPECT_EQ(Tick().motors, Torque(3).motors);
}

TEST_F(ComputerTest, SendsNoCommandWhileItIsOffAndNoneOfThoseFromBeforeAfterIt) {
  port_.Send(Torque(3));
  Tick();
  port_.Send(Torque(4));
  computer_.SwitchOff();
  port_.Send(Torque(5));
  EXPECT_EQ(Tick().motors, std::vector<robot::MotorCommand>(6));
  computer_.SwitchOn(static_cast<double>(step_) * kDt);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(Tick().motors, std::vector<robot::MotorCommand>(6));
  EXPECT_EQ(computer_.power(), robot::PowerState::kOn);
}

TEST_F(ComputerTest, ForgetsWhatItsSensorsSaidWhenItIsSwitchedOff) {
  Tick();
  Sample(2);
  ASSERT_EQ(computer_.sampled().motors[0].q, 2);
  computer_.SwitchOff();
  EXPECT_EQ(computer_.sampled().motors[0].q, 0);
  EXPECT_EQ(computer_.sampled().foot_force[0], 0);
}

TEST_F(ComputerTest, PublishesASampleOnceAndNothingWhileItIsOff) {
  Tick();
  Sample(2);
  computer_.Publish(step_);
  EXPECT_EQ(port_.samples().size(), 1U);
  Tick();
  computer_.Publish(step_);
  EXPECT_EQ(port_.samples().size(), 1U);
  computer_.SwitchOff();
  EXPECT_FALSE(computer_.Due(0));
  computer_.Publish(step_);
  EXPECT_EQ(port_.samples().size(), 1U);
}

}  // namespace
}  // namespace understudy::emulator
