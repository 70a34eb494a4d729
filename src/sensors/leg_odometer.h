// The odometry of a quadruped's lidar programs: position and attitude of the base by the legs.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "robot/robot_values.h"
#include "sensors/sensor_config.h"

namespace understudy::sensors {

// Adds up the way of the motion service's estimate in the frame `odom`, which begins under the base
// at Restart. As on a real Go2 the way is too short and each turn is off by a little. The height is
// the estimate's, over the feet. With OdometrySource::kTruth it is the base itself. Allocates
// nothing.
class LegOdometer {
 public:
  explicit LegOdometer(const SensorConfig& config) { Apply(config); }

  // Goes on with other errors; what it has added up stays.
  void Apply(const SensorConfig& config) { errors_ = config.odometer; }
  // Begins anew at the base's place.
  void Restart(const robot::BaseReading& truth);
  // Takes a sample. Returns nullopt while no motion service estimates; that time adds no way.
  std::optional<robot::LegOdometry> Read(const robot::RobotState& sample);

 private:
  OdometerErrors errors_;
  Eigen::Vector2d start_{0, 0};             // m, in the world
  Eigen::Vector2d p_{0, 0}, last_p_{0, 0};  // m, in odom; of the last estimate
  double off_ = 0, last_yaw_ = 0;           // rad, by which odom's heading is off; of the unit
  bool follows_ = false;                    // last_* are of the previous sample
};

}  // namespace understudy::sensors
