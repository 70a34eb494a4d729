#include "sensors/sensors.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace understudy::sensors {
namespace {

// m/s² of accelerations per rad/s of rates, of a noisy unit. *assumed*
constexpr double kAccelNoise = 10;

constexpr double kPieceMean = 65535.0 / 2;  // of a random integer 0..65535
// Deviation of the sum of four of them: sqrt(4 (65536² - 1) / 12) = 65536 / sqrt(3).
constexpr double kSumDeviation = 37837.22;

}  // namespace

Sensors::Sensors(const SensorConfig& config, const robot::RobotSpec& spec)
    : config_(config),
      spec_(spec),
      motors_(robot::AllMotors(spec)),
      foot_force_(spec.feet.size()),
      body_(static_cast<std::uint64_t>(config.seed)),
      hands_(~static_cast<std::uint64_t>(config.seed)) {}  // no robot's body has that seed

void Sensors::Sample(const Instant& instant, std::int64_t tick_ms, robot::RobotState* state) {
  state->tick_ms = tick_ms;
  state->joint_space = instant.command.joint_space;
  state->motors.resize(motors_.size());
  const robot::EncoderNoiseSpec& noise = spec_.encoder_noise;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const robot::MotorSpec& motor = *motors_[i];
    robot::MotorReading& reading = state->motors[i];
    reading.silent = instant.faults.motors[i].silent;
    if (reading.silent) {
      ++reading.lost;
      continue;
    }
    const auto measure = [&](double truth, double steps, double step) {
      return Measure(truth, steps * step, step, i < spec_.motors.size() ? &body_ : &hands_);
    };
    reading.enabled = instant.command.motors[i].enabled;
    reading.timed_out = instant.command.motors[i].timed_out;
    reading.q = measure(instant.encoders.q()[i], noise.q_steps, motor.q_step);
    reading.dq = measure(instant.encoders.dq()[i], noise.dq_steps, motor.dq_step);
    reading.tau = measure(instant.motors.torque()[i], noise.tau_steps, motor.tau_step);
    reading.winding_c = instant.motors.winding_c()[i];
    reading.casing_c = instant.motors.casing_c()[i];
    reading.warm = instant.motors.derated(i);
    reading.overheated = instant.motors.tripped(i);
    reading.undervoltage = instant.motors.undervoltage(i);
    reading.encoder_error = instant.faults.encoders[i].tells();
  }
  Measure(instant.robot.Imu(), instant.faults.imus[0], &state->imu);
  if (!spec_.imu.secondary_site.empty()) {
    Measure(instant.robot.SecondaryImu(), instant.faults.imus[1], &state->secondary_imu);
  }
  instant.robot.FootForces(foot_force_);
  state->foot_force.resize(foot_force_.size());
  for (std::size_t i = 0; i < foot_force_.size(); ++i) {
    const robot::FootEffects& fault = instant.faults.feet[i];
    if (fault.stuck) continue;
    state->foot_force[i] = std::max(0.0, fault.share * foot_force_[i] + fault.offset);
  }
  state->battery = instant.battery.reading();
  state->base = instant.robot.base();
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

void Sensors::Measure(const robot::ImuReading& truth, const robot::ImuEffects& fault,
                      robot::ImuReading* imu) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  if (fault.stuck) return;
  *imu = truth;
  imu->temperature_c = spec_.imu.temperature_c;
  if (fault.dead) {
    imu->R_WI.setIdentity();
    imu->w_WI_I.setZero();
    imu->f_WI_I.setZero();
    return;
  }
  if (!fault.fine()) {
    const Eigen::Quaterniond tilt(AngleAxisd(fault.tilt, Vector3d::UnitY()));
    imu->R_WI = AngleAxisd(fault.turn, Vector3d::UnitZ()) * truth.R_WI * tilt;
    imu->w_WI_I = tilt.conjugate() * truth.w_WI_I + Vector3d::Constant(fault.rate);
    imu->f_WI_I = tilt.conjugate() * truth.f_WI_I;
    for (int i = 0; i < 3 && fault.noise > 0; ++i) {
      imu->w_WI_I[i] += fault.noise * Bell(&body_);
      imu->f_WI_I[i] += kAccelNoise * fault.noise * Bell(&body_);
    }
  }
  for (int i = 0; i < 3; ++i) {
    imu->w_WI_I[i] = Measure(imu->w_WI_I[i], spec_.imu.gyro_noise, spec_.imu.gyro_step, &body_);
    imu->f_WI_I[i] = Measure(imu->f_WI_I[i], spec_.imu.accel_noise, spec_.imu.accel_step, &body_);
  }
}

}  // namespace understudy::sensors
