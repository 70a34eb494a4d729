// What a motion service knows of the robot, in whole ticks of a Go2.
#include <filesystem>

#include "config/load.h"
#include "physics/world_model.h"
#include "tests/emulator/emulator_test.h"
#include "tests/emulator/state_bytes.h"

namespace understudy::emulator {
namespace {

class SensedTest : public EmulatorTest {
 protected:
  SensedTest() {
    config_ = config::LoadConfig({.robot = "go2"}, kRoot);
    config_.start.pose = "standing";
  }

  void Run(int ticks) {
    physics::World world(
        physics::LoadWorldModel({{config_.robot, kRoot / "models" / config_.robot.model}},
                                kRoot / "models/scene/flat.xml", config_.physics.timestep),
        {{config_.robot}});
    test::FakePort port;
    const auto go2 = MakeIn(std::move(world), &port, &inbox_);
    for (int i = 0; i < ticks; ++i) ASSERT_EQ(go2->Tick({}), physics::StepHealth::kFine);
    command_ = go2->robot().command().motors;
    state_ = Bytes(port.last().state);
  }

  const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;
  std::vector<robot::MotorCommand> command_;  // of the last tick
  std::string state_;                         // the last that was sent
};

TEST_F(SensedTest, AMotionServiceActsOnTheNoiseOfItsSensors) {
  Run(21);
  const auto first = command_;
  config_.sensors.seed = 2;
  Run(21);
  EXPECT_NE(command_, first);
}

TEST_F(SensedTest, IdealSensorsTellAMotionServiceTheTruth) {
  config_.sensors = {.quantise = false, .noise = false};
  Run(21);
  const auto first = command_;
  config_.sensors.seed = 2;
  Run(21);
  EXPECT_EQ(command_, first);
}

TEST_F(SensedTest, NothingIsSampledForAServiceThatIsOff) {
  config_.motion.service = authority::kNoService;
  Run(21);
  const std::string first = state_;
  config_.robot.rates.service_hz = 250;
  Run(21);
  EXPECT_EQ(state_, first);
}

}  // namespace
}  // namespace understudy::emulator
