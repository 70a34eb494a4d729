#include "sensors/sensors.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sensors/lattice.h"

namespace understudy::sensors {
namespace {

std::vector<std::string> JointsOf(const robot::RobotSpec& spec) {
  std::vector<std::string> names;
  for (const robot::MotorSpec* motor : robot::AllMotors(spec)) names.push_back(motor->joint);
  return names;
}

}  // namespace

std::vector<double> EncoderZeros(const SensorConfig& config, const robot::RobotSpec& spec) {
  std::vector<double> zeros;
  for (const robot::MotorSpec* motor : robot::AllMotors(spec)) {
    zeros.push_back(motor->zero_error +
                    Drawn(config.seed, "encoder.zero", motor->joint, config.encoder.zero));
  }
  return zeros;
}

Sensors::Sensors(const SensorConfig& config, const robot::RobotSpec& spec, double dt)
    : spec_(spec),
      motors_(robot::AllMotors(spec)),
      resolutions_(motors_.size()),
      foot_force_(spec.feet.size()),
      imu_(config, spec.imu, "imu", kImuStream, dt),
      secondary_imu_(config, spec.imu, "secondary_imu", kSecondaryImuStream, dt),
      odometer_(config, dt),
      legs_(config),
      feet_(config, spec.feet, dt),
      touch_(config, spec.hands),
      touch_force_(touch_.cells()),
      windings_(config, JointsOf(spec), dt),
      casings_(config, JointsOf(spec), dt),
      body_(config.seed, kBodyStream),
      hands_(config.seed, kHandsStream) {
  ApplyNoise(config);
}

void Sensors::Restart(const Instant& instant) {
  imu_.Restart(instant.robot.Imu(), instant.robot.gravity());
  secondary_imu_.Restart(instant.robot.SecondaryImu(), instant.robot.gravity());
  odometer_.Restart(instant.robot.base());
  legs_.Restart(instant.robot.base());
  feet_.Restart();
  windings_.Restart(instant.motors.winding_c());
  casings_.Restart(instant.motors.casing_c());
  Step(instant);
}

void Sensors::Apply(const SensorConfig& config) {
  ApplyNoise(config);
  imu_.Apply(config);
  secondary_imu_.Apply(config);
  odometer_.Apply(config);
  legs_.Apply(config);
  feet_.Apply(config);
  touch_.Apply(config);
  windings_.Apply(config);
  casings_.Apply(config);
}

void Sensors::ApplyNoise(const SensorConfig& config) {
  const robot::EncoderNoiseSpec& noise = spec_.encoder_noise;
  const auto resolution = [&config](double steps, double step, double besides = 0) {
    const double sigma = std::hypot(steps * step, besides);
    return Resolution{.noisy = config.noise && sigma > 0,
                      .sigma = config.noise_gain * sigma,
                      .step = config.quantise ? step : 0};
  };
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const robot::MotorSpec& motor = *motors_[i];
    resolutions_[i] = {.q = resolution(noise.q_steps, motor.q_step),
                       .dq = resolution(noise.dq_steps, motor.dq_step),
                       .tau = resolution(noise.tau_steps, motor.tau_step, noise.tau)};
  }
}

void Sensors::Step(const Instant& instant) {
  const robot::ImuReading truth = instant.robot.Imu();
  imu_.Step(truth, instant.faults.imus[0], spec_.thermal.ambient_c);
  imu_.Read(instant.faults.imus[0], &told_imu_);
  odometer_.Step(instant.robot.base(), truth.R_WI, told_imu_.R_WI);
  if (!spec_.imu.secondary_site.empty()) {
    secondary_imu_.Step(instant.robot.SecondaryImu(), instant.faults.imus[1],
                        spec_.thermal.ambient_c);
  }
  feet_.Step();
  windings_.Step(instant.motors.winding_c());
  casings_.Step(instant.motors.casing_c());
}

void Sensors::Sample(const Instant& instant, robot::RobotState* state) {
  state->joint_space = robot::JointSpace::kPitchRoll;
  state->motors.resize(motors_.size());
  const std::span<const double> q = instant.encoders.q(), dq = instant.encoders.dq();
  const std::span<const double> torque = instant.motors.torque();
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const MotorResolution& resolution = resolutions_[i];
    Noise* const noise = i < spec_.motors.size() ? &body_ : &hands_;
    const robot::MotorCommand& command = instant.command.motors[i];
    if (command.space == robot::JointSpace::kMotors) state->joint_space = command.space;
    robot::MotorReading& reading = state->motors[i];
    reading.silent = instant.faults.motors[i].silent;
    if (reading.silent || instant.faults.motors[i].unheard) {
      ++reading.lost;
      continue;
    }
    reading.enabled = command.enabled;
    reading.timed_out = command.timed_out;
    reading.led_dq = command.dq;
    reading.most = command.most;
    reading.q = Sampled(q[i], resolution.q, noise);
    reading.dq = Sampled(dq[i], resolution.dq, noise);
    reading.tau = Sampled(torque[i], resolution.tau, noise);
    reading.winding_c = windings_.reading_c(i);
    reading.casing_c = casings_.reading_c(i);
    reading.warm = instant.motors.derated(i);
    reading.overheated = instant.motors.tripped(i);
    reading.undervoltage = instant.motors.undervoltage(i);
    reading.encoder_error = instant.faults.encoders[i].tells();
  }
  robot::TrueValues& truth = state->truth;
  truth.q.assign(instant.robot.q().begin(), instant.robot.q().end());
  truth.dq.assign(instant.robot.dq().begin(), instant.robot.dq().end());
  truth.tau.assign(instant.motors.torque().begin(), instant.motors.torque().end());
  truth.imu = instant.robot.Imu();
  imu_.Read(instant.faults.imus[0], &state->imu);
  if (!spec_.imu.secondary_site.empty()) {
    truth.secondary_imu = instant.robot.SecondaryImu();
    secondary_imu_.Read(instant.faults.imus[1], &state->secondary_imu);
  }
  instant.robot.FootForces(foot_force_);
  truth.foot_force = foot_force_;
  state->foot_force.resize(foot_force_.size());
  for (std::size_t i = 0; i < foot_force_.size(); ++i) {
    const robot::FootEffects& fault = instant.faults.feet[i];
    if (fault.stuck) continue;
    state->foot_force[i] = fault.share * feet_.Read(i, foot_force_) + fault.offset;
  }
  Feel(instant, state);
  state->battery = instant.battery.reading();
  state->board = instant.board.reading();
  state->base = instant.robot.base();
  state->odometry = odometer_.reading();
  state->leg_odometry = legs_.Read(*state);
}

void Sensors::Feel(const Instant& instant, robot::RobotState* state) {
  state->touch.resize(touch_.cells());
  if (!instant.feels || touch_.cells() == 0) return;
  instant.robot.ReadTouch(touch_force_);
  touch_.Read(touch_force_, state->tick_ms, state->touch);
}

double Sensors::Sampled(double truth, const Resolution& resolution, Noise* noise) {
  if (resolution.noisy) truth += resolution.sigma * (*noise)();
  return resolution.step > 0 ? OnLattice(truth, resolution.step) : truth;
}

}  // namespace understudy::sensors
