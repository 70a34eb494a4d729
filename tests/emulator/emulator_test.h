// Whole ticks of the fixture robot between a fake port and an inbox.
#ifndef UNDERSTUDY_TESTS_EMULATOR_EMULATOR_TEST_H_
#define UNDERSTUDY_TESTS_EMULATOR_EMULATOR_TEST_H_

#include <memory>

#include "emulator/emulator.h"
#include "tests/support/fake_port.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::emulator {

class EmulatorTest : public test::MujocoTest {
 protected:
  // Makes the robot of config_. Tests change config_ before.
  void Start() {
    emulator_ = std::make_unique<Emulator>(
        config_, test::FixtureWorld(config_.robot, config_.physics.timestep), &port_, &inbox_);
  }
  void StartAs(const char* pose) {
    config_.start.pose = pose;
    Start();
  }

  // Ticks that must go well.
  void Tick(int times = 1) {
    for (int i = 0; i < times; ++i) ASSERT_EQ(emulator_->Tick(), physics::StepHealth::kFine);
  }

  // The next tick carries it out; nobody waits for the answer.
  void Order(const understudy::emulator::Order& order) {
    inbox_.Put(order, Inbox::WallTime::max());
  }

  double Height() const { return emulator_->world().base().p_WB.z(); }

  // The same torque for every motor.
  static robot::RobotCommand Torque(double tau) {
    return {.motors = std::vector<robot::MotorCommand>(6, {.enabled = true, .tau = tau})};
  }

  config::Config config_ = test::FixtureConfig();
  test::FakePort port_;
  Inbox inbox_;
  std::unique_ptr<Emulator> emulator_;
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_TESTS_EMULATOR_EMULATOR_TEST_H_
