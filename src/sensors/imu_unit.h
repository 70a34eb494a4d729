// One inertial unit with its errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "robot/fault.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"
#include "sensors/attitude_filter.h"
#include "sensors/chance.h"
#include "sensors/sensor_config.h"

namespace understudy::sensors {

// What happens to rate and specific force, in this order: scale and misalignment, bias and its
// walk, the unit's low pass, its latency, white noise, saturation, and in messages the lattice. The
// attitude is that of a filter over the result before the lattice, or the truth, late as the rest.
// Allocates only in the constructor; equal seeds and inputs give equal readings.
class ImuUnit {
 public:
  // `name` tells the units of a robot apart in what is drawn, `stream` in their noise; `dt` [s] is
  // the time between steps.
  ImuUnit(const SensorConfig& config, const robot::ImuSpec& spec, const std::string& name,
          std::uint64_t stream, double dt);

  // Begins anew as if it had been at rest for long in the attitude of `truth`: filters, latency and
  // walks, but neither what was drawn nor its temperature. `gravity_W` [m/s²] points down.
  void Restart(const robot::ImuReading& truth, const Eigen::Vector3d& gravity_W);
  // Goes on with other errors: what was drawn is scaled, walks and filters stay where they are.
  // Seed, latency and where the attitude comes from must be the same. Allocates nothing.
  void Apply(const SensorConfig& config);
  // Reads the truth of an instant, dt after the one before, in air of `ambient_c` [°C].
  void Step(const robot::ImuReading& truth, const robot::ImuEffects& fault, double ambient_c);
  // Writes what the unit says now; leaves `imu` while it is stuck.
  void Read(const robot::ImuEffects& fault, robot::ImuReading* imu) const;

 private:
  // One of the two sensors, of three axes.
  struct Sensor {
    // As drawn with deviations of 1: of scales on the diagonal, of misalignments beside it.
    Eigen::Matrix3d drawn_gain;
    Eigen::Vector3d drawn_bias;
    Eigen::Matrix3d gain{};  // of the reading on the truth
    Eigen::Vector3d bias{0, 0, 0}, walked{0, 0, 0}, passed{0, 0, 0};
    double walk = 0;              // standard deviation of a step
    double noise = 0, range = 0;  // standard deviation; 0: any
    double step = 0;              // lattice
  };

  static Sensor Draw(int seed, const std::string& element, const char* name);
  void Scale(double bias, double walk, double scale, double misalignment, Sensor* sensor) const;
  // Returns the reading of a truth before latency; walk and low pass go on by a step.
  Eigen::Vector3d Measure(const Eigen::Vector3d& truth, double fault, Sensor* sensor);
  Eigen::Vector3d Finish(const Eigen::Vector3d& value, double fault_noise, const Sensor& sensor);
  void Warm(double ambient_c);

  SensorConfig config_;
  const robot::ImuSpec& spec_;
  double dt_;
  double pass_ = 1;  // share of a change that the low pass follows in a step
  Sensor gyro_, accel_;
  Noise walks_, noise_;
  AttitudeFilter filter_;
  std::vector<robot::ImuReading> late_;  // a ring of what is under way
  std::size_t next_ = 0;
  double warm_share_ = 1;  // of the way to its temperature, in a step; 1: it is there at once
  robot::ImuReading reading_;
  bool on_ = false;  // whether its temperature has begun
};

}  // namespace understudy::sensors
