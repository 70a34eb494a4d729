// The sensors of the fixture robot, in motion.
#pragma once

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "sensors/sensors.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::sensors {

class SensorsTest : public test::MujocoTest {
 protected:
  SensorsTest() {
    spec_.encoder_noise = {.q_steps = 2, .dq_steps = 3, .tau_steps = 4};
    spec_.imu.gyro_noise = 0.01;
    spec_.imu.accel_noise = 0.05;
    // In motion, so that no reading is 0.
    world_.robot().Reset({.q = spec_.standing.q, .height = 0.4});
    for (int i = 0; i < 200; ++i) {
      world_.BeginStep();
      motors_.Step({.command = command_, .q = world_.robot().q(), .dq = world_.robot().dq()});
      battery_.Step(motors_.power(), world_.timestep());
      world_.robot().Drive(motors_.torque());
      EXPECT_EQ(world_.EndStep(), physics::StepHealth::kFine);
    }
  }

  static robot::RobotCommand Moving() {
    robot::RobotCommand command;
    for (int i = 0; i < 6; ++i) {
      command.motors.push_back({.enabled = i != 2, .q = 0.1 * i, .kp = 20, .kd = 1});
    }
    return command;
  }

  void SampleInto(Sensors* sensors, robot::RobotState* state) {
    encoders_.Step(world_.robot().q(), world_.robot().dq(), faults_.encoders);
    sensors->Step(instant());
    sensors->Sample(instant(), state);
  }
  Instant instant() const {
    return {world_.robot(), encoders_, motors_, command_, battery_, board_, faults_};
  }
  Sensors Make(const SensorConfig& config, const robot::RobotSpec& spec) const {
    Sensors sensors(config, spec, 0.001);
    sensors.Restart(instant());
    return sensors;
  }
  Sensors Make(const SensorConfig& config) const { return Make(config, spec_); }
  robot::RobotState Sample(Sensors* sensors) {
    robot::RobotState state;
    SampleInto(sensors, &state);
    return state;
  }
  robot::RobotState Sample(const SensorConfig& config) {
    Sensors sensors = Make(config);
    return Sample(&sensors);
  }

  robot::RobotSpec spec_ = test::FixtureRobot();
  robot::RobotCommand command_ = Moving();
  physics::MujocoWorld world_ = test::FixtureWorld(spec_);
  robot::MotorBank motors_{spec_, 0.001};
  robot::Battery battery_{spec_.battery};
  robot::Board board_{spec_};
  Encoders encoders_{std::vector<double>(6), 1};
  robot::Effects faults_{.motors = std::vector<robot::MotorEffects>(6),
                         .encoders = std::vector<robot::EncoderEffects>(6),
                         .feet = std::vector<robot::FootEffects>(4)};
};

inline constexpr SensorConfig kTruth{.quantise = false, .noise = false};
inline constexpr SensorConfig kLattice{.quantise = true, .noise = false};
inline constexpr SensorConfig kNoise{.quantise = false, .noise = true};
inline constexpr SensorConfig kBoth{.quantise = true, .noise = true};

}  // namespace understudy::sensors
