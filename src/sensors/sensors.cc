#include "sensors/sensors.h"

#include <cmath>

namespace understudy::sensors {
namespace {

// Temperature rise of the casing over that of the winding. *assumed*
constexpr double kCasingShare = 0.8;

constexpr double kPieceMean = 65535.0 / 2;  // of a random integer 0..65535
// Deviation of the sum of four of them: sqrt(4 (65536² - 1) / 12) = 65536 / sqrt(3).
constexpr double kSumDeviation = 37837.22;

}  // namespace

Sensors::Sensors(const SensorConfig& config, const robot::RobotSpec& spec)
    : config_(config),
      spec_(spec),
      motors_(robot::AllMotors(spec)),
      body_(static_cast<std::uint64_t>(config.seed)),
      hands_(~static_cast<std::uint64_t>(config.seed)) {}  // no robot's body has that seed

void Sensors::Sample(const physics::RobotBody& robot, const robot::MotorBank& motors,
                     const robot::RobotCommand& command, const robot::Battery& battery,
                     std::int64_t tick_ms, robot::RobotState* state) {
  state->tick_ms = tick_ms;
  state->joint_space = command.joint_space;
  state->motors.resize(motors_.size());
  const robot::EncoderNoiseSpec& noise = spec_.encoder_noise;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const robot::MotorSpec& motor = *motors_[i];
    robot::MotorReading& reading = state->motors[i];
    const auto measure = [&](double truth, double steps, double step) {
      return Measure(truth, steps * step, step, i < spec_.motors.size() ? &body_ : &hands_);
    };
    reading.enabled = command.motors[i].enabled;
    reading.timed_out = command.motors[i].timed_out;
    reading.q = measure(robot.q()[i], noise.q_steps, motor.q_step);
    reading.dq = measure(robot.dq()[i], noise.dq_steps, motor.dq_step);
    reading.tau = measure(motors.torque()[i], noise.tau_steps, motor.tau_step);
    reading.winding_c = motors.winding_c()[i];
    reading.casing_c =
        spec_.thermal.ambient_c + kCasingShare * (reading.winding_c - spec_.thermal.ambient_c);
  }
  state->imu = Measure(robot.Imu());
  if (!spec_.imu.secondary_site.empty()) state->secondary_imu = Measure(robot.SecondaryImu());
  state->foot_force.resize(spec_.feet.size());
  robot.FootForces(state->foot_force);
  state->battery = battery.reading();
  state->base = robot.base();
}

double Sensors::Bell(std::mt19937_64* random) {
  const std::uint64_t bits = (*random)();
  const std::uint64_t sum =
      (bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48);
  return (static_cast<double>(sum) - 4 * kPieceMean) / kSumDeviation;
}

double Sensors::Measure(double truth, double sigma, double step, std::mt19937_64* random) const {
  if (config_.noise && sigma > 0) truth += sigma * Bell(random);
  if (config_.quantise && step > 0) truth = std::round(truth / step) * step;
  return truth;
}

robot::ImuReading Sensors::Measure(const robot::ImuReading& truth) {
  robot::ImuReading imu = truth;
  for (int i = 0; i < 3; ++i) {
    imu.w_WI_I[i] = Measure(truth.w_WI_I[i], spec_.imu.gyro_noise, spec_.imu.gyro_step, &body_);
    imu.f_WI_I[i] = Measure(truth.f_WI_I[i], spec_.imu.accel_noise, spec_.imu.accel_step, &body_);
  }
  imu.temperature_c = spec_.imu.temperature_c;
  return imu;
}

}  // namespace understudy::sensors
