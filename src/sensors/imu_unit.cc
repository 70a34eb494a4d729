#include "sensors/imu_unit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensors/lattice.h"

namespace understudy::sensors {
namespace {

// m/s² of accelerations per rad/s of rates, of a noisy unit. *assumed*
constexpr double kAccelNoise = 10;

// The greatest number of steps of a lattice that 16 bits hold.
constexpr double kMostCount = 32767;

// Standard deviation of what a random walk of 1 per square root of a second goes in a step.
double WalkOf(double walk, double dt) { return walk * std::sqrt(dt); }

}  // namespace

ImuUnit::ImuUnit(const SensorConfig& config, const robot::ImuSpec& spec, const std::string& name,
                 std::uint64_t stream, double dt)
    : config_(config),
      spec_(spec),
      dt_(dt),
      gyro_(Draw(config.seed, name, "gyro")),
      accel_(Draw(config.seed, name, "accel")),
      walks_(config.seed, stream),
      noise_(config.seed, stream + 1),
      filter_(config.imu.attitude_gain, config.imu.attitude_trim, dt),
      late_(static_cast<std::size_t>(std::llround(config.imu.latency / dt)) + 1) {
  Apply(config);
}

void ImuUnit::Apply(const SensorConfig& config) {
  config_ = config;
  const ImuErrors& errors = config.imu;
  pass_ = errors.bandwidth > 0 ? -std::expm1(-2 * std::numbers::pi * errors.bandwidth * dt_) : 1;
  Scale(errors.gyro_bias, errors.gyro_walk, errors.gyro_scale, errors.gyro_misalignment, &gyro_);
  Scale(errors.accel_bias, errors.accel_walk, errors.accel_scale, errors.accel_misalignment,
        &accel_);
  const double share = config.noise ? config.noise_gain : 0;
  gyro_.noise = share * spec_.gyro_noise;
  accel_.noise = share * spec_.accel_noise;
  gyro_.step = config.quantise ? spec_.gyro_step : 0;
  accel_.step = config.quantise ? spec_.accel_step : 0;
  gyro_.range = errors.saturate ? kMostCount * spec_.gyro_step : 0;
  accel_.range = errors.saturate ? kMostCount * spec_.accel_step : 0;
  warm_share_ = errors.warm_up > 0 ? -std::expm1(-dt_ / errors.warm_up) : 1;
  filter_.SetGains(errors.attitude_gain, errors.attitude_trim);
}

ImuUnit::Sensor ImuUnit::Draw(int seed, const std::string& element, const char* name) {
  const std::string sensor = std::string("imu.") + name;
  const auto drawn = [&](const char* what, const std::string& axis) {
    return Drawn(seed, sensor + what, element + axis, 1);
  };
  Sensor one{.drawn_gain = Eigen::Matrix3d::Zero(), .drawn_bias = Eigen::Vector3d::Zero()};
  const std::string axes[] = {".x", ".y", ".z"};
  for (int i = 0; i < 3; ++i) {
    one.drawn_bias[i] = drawn("_bias", axes[i]);
    for (int j = 0; j < 3; ++j) {
      one.drawn_gain(i, j) =
          i == j ? drawn("_scale", axes[i]) : drawn("_misalignment", axes[i] + axes[j]);
    }
  }
  return one;
}

void ImuUnit::Scale(double bias, double walk, double scale, double misalignment,
                    Sensor* sensor) const {
  sensor->bias = bias * sensor->drawn_bias;
  sensor->walk = WalkOf(walk, dt_);
  sensor->gain = misalignment * sensor->drawn_gain;
  sensor->gain.diagonal() = Eigen::Vector3d::Ones() + scale * sensor->drawn_gain.diagonal();
}

void ImuUnit::Restart(const robot::ImuReading& truth, const Eigen::Vector3d& gravity_W) {
  const Eigen::Vector3d rest = truth.R_WI.conjugate() * -gravity_W;
  gyro_.walked.setZero();
  accel_.walked.setZero();
  gyro_.passed = gyro_.bias;
  accel_.passed = accel_.gain * rest + accel_.bias;
  filter_.Restart(truth.R_WI, accel_.passed);
  for (robot::ImuReading& one : late_) {
    one.R_WI = truth.R_WI;
    one.w_WI_I = gyro_.passed;
    one.f_WI_I = accel_.passed;
  }
}

void ImuUnit::Step(const robot::ImuReading& truth, const robot::ImuEffects& fault,
                   double ambient_c) {
  robot::ImuReading& newest = late_[next_];
  newest.R_WI = truth.R_WI;
  newest.w_WI_I = Measure(truth.w_WI_I, fault.rate, &gyro_);
  newest.f_WI_I = Measure(truth.f_WI_I, 0, &accel_);
  if (++next_ == late_.size()) next_ = 0;
  const robot::ImuReading& oldest = late_[next_];
  reading_.w_WI_I = Finish(oldest.w_WI_I, fault.noise, gyro_);
  reading_.f_WI_I = Finish(oldest.f_WI_I, kAccelNoise * fault.noise, accel_);
  if (config_.imu.attitude == AttitudeSource::kFilter) {
    filter_.Step(reading_.w_WI_I, reading_.f_WI_I);
    reading_.R_WI = filter_.R_WI();
  } else {
    reading_.R_WI = oldest.R_WI;
  }
  Warm(ambient_c);
}

Eigen::Vector3d ImuUnit::Measure(const Eigen::Vector3d& truth, double fault, Sensor* sensor) {
  for (int i = 0; i < 3 && sensor->walk > 0; ++i) sensor->walked[i] += sensor->walk * walks_();
  const Eigen::Vector3d now =
      sensor->gain * truth + sensor->bias + sensor->walked + Eigen::Vector3d::Constant(fault);
  sensor->passed = pass_ < 1 ? sensor->passed + pass_ * (now - sensor->passed) : now;
  return sensor->passed;
}

Eigen::Vector3d ImuUnit::Finish(const Eigen::Vector3d& value, double fault_noise,
                                const Sensor& sensor) {
  Eigen::Vector3d finished = value;
  for (double& one : finished) {
    if (sensor.noise > 0) one += sensor.noise * noise_();
    if (fault_noise > 0) one += fault_noise * noise_();
    if (sensor.range > 0) one = std::clamp(one, -sensor.range, sensor.range);
  }
  return finished;
}

void ImuUnit::Warm(double ambient_c) {
  if (warm_share_ == 1) {
    reading_.temperature_c = spec_.temperature_c;
    return;
  }
  if (!on_) reading_.temperature_c = ambient_c;
  on_ = true;
  reading_.temperature_c += (spec_.temperature_c - reading_.temperature_c) * warm_share_;
}

void ImuUnit::Read(const robot::ImuEffects& fault, robot::ImuReading* imu) const {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  if (fault.stuck) return;
  *imu = reading_;
  if (fault.dead) {
    imu->R_WI.setIdentity();
    imu->w_WI_I.setZero();
    imu->f_WI_I.setZero();
    return;
  }
  // The unit is turned at its place, which its own filter follows at once, as its gyroscope would
  // show it.
  if (fault.tilt != 0 || fault.turn != 0) {
    const Eigen::Quaterniond tilt(AngleAxisd(fault.tilt, Vector3d::UnitY()));
    imu->R_WI = AngleAxisd(fault.turn, Vector3d::UnitZ()) * reading_.R_WI * tilt;
    imu->w_WI_I = tilt.conjugate() * reading_.w_WI_I;
    imu->f_WI_I = tilt.conjugate() * reading_.f_WI_I;
  }
  const auto round = [](double step, Vector3d* value) {
    for (double& one : *value) {
      if (step > 0) one = OnLattice(one, step);
    }
  };
  round(gyro_.step, &imu->w_WI_I);
  round(accel_.step, &imu->f_WI_I);
}

}  // namespace understudy::sensors
