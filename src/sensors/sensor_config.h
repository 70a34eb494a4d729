// The parameters of what sensors make of the truth. Each field is a YAML key below `sensors`;
// config/sensor_keys.cc has its meaning, unit and range, config/profiles its values. "Drawn" values
// are drawn once per robot from SensorConfig::seed, with mean 0 and the standard deviation given.
#pragma once

#include <cstdint>

namespace understudy::sensors {

// Where the attitude of an inertial unit comes from.
enum class AttitudeSource : std::uint8_t { kTruth, kFilter };

struct ImuErrors {
  double gyro_bias = 0;          // rad/s, drawn per axis
  double gyro_walk = 0;          // rad/s/sqrt(s), random walk of that bias
  double gyro_scale = 0;         // drawn per axis, share of the rate
  double gyro_misalignment = 0;  // rad, drawn per pair of axes
  double accel_bias = 0;         // m/s², as the gyroscope's
  double accel_walk = 0;         // m/s²/sqrt(s)
  double accel_scale = 0;
  double accel_misalignment = 0;  // rad
  bool saturate = false;          // at 32767 steps of the lattices of robot.imu
  double bandwidth = 0;           // Hz of the unit's own low pass, of first order; 0 = none
  double latency = 0;             // s, to whole physics steps
  AttitudeSource attitude = AttitudeSource::kTruth;
  double attitude_gain = 0.2;   // 1/s with which the filter leans on the accelerometer
  double attitude_trim = 0.01;  // 1/s² with which it learns the gyroscope's bias
  double warm_up = 0;           // s, time constant from the air to its temperature; 0 = is warm
};

struct EncoderErrors {
  double zero = 0;  // rad, drawn per motor
};

struct FootErrors {
  double offset = 0;      // N, drawn per foot
  double walk = 0;        // N/sqrt(s), random walk of that offset
  double scale = 0;       // drawn per foot, share of the force
  double cross_talk = 0;  // drawn per pair of feet, share of the other's force
};

struct ThermometerErrors {
  double time_constant = 0;  // s; 0 = none
  double offset_c = 0;       // °C, drawn per motor
};

// Where the odometry of a quadruped's lidar programs comes from.
enum class OdometrySource : std::uint8_t { kTruth, kEstimate };

struct OdometerErrors {
  double scale = 0;  // drawn ahead and to the left, share of the way
  double walk = 0;   // m/sqrt(s), random walk of the position
  OdometrySource legs = OdometrySource::kTruth;
  double shortfall = 0;  // of an estimate by legs: share of the way that it misses
  double turn = 0;       // of the same: share of each turn that its heading is off by
};

struct SensorConfig {
  bool quantise = true;   // round to the lattices of encoders and IMU
  bool noise = true;      // add the white noise of robot.imu and robot.encoder_noise
  double noise_gain = 1;  // times that noise
  int seed = 1;           // of noise, walks and what is drawn
  ImuErrors imu{};
  EncoderErrors encoder{};
  FootErrors foot{};
  ThermometerErrors thermometer{};
  OdometerErrors odometer{};
};

}  // namespace understudy::sensors
