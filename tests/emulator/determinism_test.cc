#include <cmath>

#include "tests/emulator/emulator_test.h"
#include "tests/emulator/state_bytes.h"

namespace understudy::emulator {
namespace {

// Noise, lattice, contacts, refused commands, pauses long enough to damp, and requests.
class DeterminismTest : public EmulatorTest {
 protected:
  DeterminismTest() {
    config_.robots[0].sensors = {.quantise = true,
                                 .noise = true,
                                 .seed = 3,
                                 .imu = {.gyro_bias = 0.01,
                                         .gyro_walk = 0.01,
                                         .accel_walk = 0.01,
                                         .bandwidth = 100,
                                         .latency = 0.002,
                                         .attitude = sensors::AttitudeSource::kFilter},
                                 .encoder = {.zero = 0.01},
                                 .foot = {.offset = 1, .walk = 1},
                                 .thermometer = {.time_constant = 1, .offset_c = 1},
                                 .odometer = {.scale = 0.1, .walk = 0.01}};
    config_.robots[0].spec.encoder_noise = {.q_steps = 2, .dq_steps = 3, .tau_steps = 4};
    config_.robots[0].spec.imu.gyro_noise = 0.01;
    config_.robots[0].spec.imu.accel_noise = 0.05;
    config_.robots[0].start.pose = "hanging";
    config_.robots[0].spec.services = {{.name = "ai_sport", .alias = "ai"}};
    config_.robots[0].spec.remote.chords = {{.keys = "L2+Y", .does = "zero_torque"}};
  }

  // One after the other, as different processes would.
  std::vector<std::string> Play() const {
    test::FakePort port;
    Inbox inbox;
    test::FakeServices services;
    const auto world = Make(&port, &inbox, &services);
    for (int step = 0; step < 2000; ++step) {
      if (step % 1000 < 600 && step % 3 == 0) {
        robot::RobotCommand command;
        for (int i = 0; i < 6; ++i) {
          command.motors.push_back(
              {.enabled = true, .q = 0.3 * std::sin(0.005 * step + i), .kp = 100, .kd = 2});
        }
        port.Send(command, step % 9 == 0 ? robot::Refusal::kCrc : robot::Refusal::kNone);
      }
      if (step == 100) inbox.Put(test::RequestOf("remote.press", "L2+Y"));
      if (step == 300) services.Call([](authority::MotorOwner* owner) { owner->Release(); });
      if (step == 700) inbox.Put(test::RequestOf("crane.release"));
      EXPECT_EQ(world->Tick({}), physics::StepHealth::kFine);
    }
    std::vector<std::string> states;
    for (const test::FakePort::Sample& sample : port.samples())
      states.push_back(Bytes(sample.state));
    return states;
  }
};

TEST_F(DeterminismTest, EqualRobotsSendEqualStatesBitForBit) {
  const auto first = Play();
  EXPECT_EQ(first.size(), 1000U);
  EXPECT_NE(first.front(), first.back());
  EXPECT_EQ(first, Play());
}

TEST_F(DeterminismTest, AnotherSeedSendsOtherStates) {
  const auto first = Play();
  config_.robots[0].sensors.seed = 4;
  EXPECT_NE(first, Play());
}

}  // namespace
}  // namespace understudy::emulator
