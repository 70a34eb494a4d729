// Tests in whole ticks of a Go2 which readings the motion service gets.
#include <filesystem>

#include "config/load.h"
#include "tests/emulator/emulator_test.h"
#include "tests/emulator/state_bytes.h"

namespace understudy::emulator {
namespace {

class SensedTest : public EmulatorTest {
 protected:
  SensedTest() {
    config_ = config::LoadConfig({.robot = "go2"}, kRoot);
    config_.robots[0].start.pose = "standing";
  }

  void StartGo2() {
    world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_, &services_);
  }
  void Run(int ticks) {
    StartGo2();
    Tick(ticks);
    command_ = robot().command().motors;
    state_ = Bytes(port_.last().state);
  }

  const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;
  std::vector<robot::MotorCommand> command_;  // of the last tick
  std::string state_;                         // the last that was sent
};

TEST_F(SensedTest, AMotionServiceActsOnTheNoiseOfItsSensors) {
  Run(21);
  const auto first = command_;
  config_.robots[0].sensors.seed = 2;
  Run(21);
  EXPECT_NE(command_, first);
}

TEST_F(SensedTest, IdealSensorsTellAMotionServiceTheTruth) {
  config_.robots[0].sensors = {.quantise = false, .noise = false};
  Run(21);
  const auto first = command_;
  config_.robots[0].sensors.seed = 2;
  Run(21);
  EXPECT_EQ(command_, first);
}

TEST_F(SensedTest, AMotionServiceKnowsItsJointsAndHowFastTheyTurn) {
  config_.robots[0].start.pose = "lying";
  config_.robots[0].spec.motion.quadruped.stands_up = false;
  StartGo2();
  Tick(500);
  services_.Call([](authority::MotorOwner* owner) { owner->Ask(authority::goal::StandUp{}); });
  Tick(2);
  for (std::size_t i = 0; i < 12; ++i) {  // it rises from where its joints are
    EXPECT_NEAR(robot().command().motors[i].q, world_->physics().robot().q()[i], 0.02) << i;
  }
  robot::RobotState rising;
  for (int i = 0; i < 3000; ++i) {
    Tick();
    const robot::RobotState& state = robot().sampled();
    if (state.base.v_WB_W.z() > rising.base.v_WB_W.z()) rising = state;
  }
  ASSERT_GT(rising.base.v_WB_W.z(), 0.1);
  EXPECT_NEAR(rising.motion->v_WB_W.z(), rising.base.v_WB_W.z(), 0.03);
}

TEST_F(SensedTest, NothingIsSampledForAServiceThatIsOff) {
  config_.robots[0].motion.service = authority::kNoService;
  Run(21);
  const std::string first = state_;
  config_.robots[0].spec.rates.service_hz = 250;
  Run(21);
  EXPECT_EQ(state_, first);
}

// Of the fixture robot, clamped, without a motion service.
class ErringSensorsTest : public EmulatorTest {
 protected:
  void Hold() {
    robot::RobotCommand hold;
    for (int i = 0; i < 6; ++i) hold.motors.push_back({.enabled = true, .kp = 200, .kd = 5});
    port_.SendEveryTick(hold);
    StartAs("clamped");
    Tick(1000);
  }
  double q(std::size_t motor) const { return world_->physics().robot().q()[motor]; }
  double Yaw() const {
    const Eigen::Vector3d x = robot().sampled().imu.R_WI * Eigen::Vector3d::UnitX();
    return std::atan2(x.y(), x.x());
  }
};

TEST_F(ErringSensorsTest, ADriveAndTheMessagesShareTheWrongZeroOfAnEncoder) {
  Hold();
  const double right = q(0), told = robot().sampled().motors[0].q;
  config_.robots[0].spec.motors[0].zero_error = 0.1;
  Hold();
  EXPECT_NEAR(q(0) - right, -0.1, 0.02);
  EXPECT_NEAR(robot().sampled().motors[0].q, told, 0.02);
}

TEST_F(ErringSensorsTest, AHeadingDriftsWithTheBiasAndIsRightAgainAfterAReset) {
  config_.robots[0].sensors.imu = {.gyro_bias = 0.05, .attitude = sensors::AttitudeSource::kFilter};
  StartAs("clamped");
  Tick();
  EXPECT_NEAR(Yaw(), 0, 1e-3);
  Tick(4000);
  const double bias = robot().sampled().imu.w_WI_I.z();
  ASSERT_GT(std::abs(bias), 0.01);
  EXPECT_NEAR(Yaw(), 4 * bias, 0.1 * std::abs(4 * bias));
  Ask("reset", {{"pose", "clamped"}});
  Tick(2);
  EXPECT_NEAR(Yaw(), 0, 1e-3);
  EXPECT_NEAR(robot().sampled().imu.w_WI_I.z(), bias, 1e-6) << "it is the same unit";
}

TEST_F(ErringSensorsTest, AUnitThatWakesUpAfterAFallKnowsHowItLies) {
  config_.robots[0].sensors.imu = {.attitude = sensors::AttitudeSource::kFilter};
  config_.robots[0].spec.boot = {.states = 0.01, .services = 0.02, .motion = 0.03};
  StartAs("standing");
  Tick(10);
  Ask("power", {{"on", false}});
  Ask("drag", {{"body", "base"}, {"at", {0, 0.1, 0}}, {"to", {0, 0, 1}}, {"for", 5}});
  Tick(4000);
  const physics::RobotBody& body = world_->physics().robot();
  ASSERT_GT(body.tilt(), 0.25) << "it hangs on its side";
  Ask("power", {{"on", true}});
  Tick(20);
  const Eigen::Vector3d up = robot().sampled().imu.R_WI * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d true_up = body.Imu().R_WI * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::acos(std::min(1.0, up.dot(true_up))), 0, 0.02);
}

}  // namespace
}  // namespace understudy::emulator
