// The odometry that a robot's own programs publish: position and velocity of the base, from the
// legs and the inertial unit.
#pragma once

#include <Eigen/Geometry>

#include "robot/robot_values.h"
#include "sensors/chance.h"
#include "sensors/sensor_config.h"

namespace understudy::sensors {

// Adds up the way that the legs measure along the heading that the unit tells: so it is off by the
// scale of the legs and by the drift of that heading, and walks. The height is over the ground, as
// legs feel it, and right. Stands in for an estimator where no motion service estimates; that its
// errors are these is *assumed*. Allocates nothing after the constructor.
class Odometer {
 public:
  // `dt` [s] is the time between steps.
  Odometer(const SensorConfig& config, double dt);

  // Goes on with other errors; what it has added up stays.
  void Apply(const SensorConfig& config);
  // Begins anew at the truth.
  void Restart(const robot::BaseReading& truth);
  // Takes the truth dt after the one before, with the unit's true attitude and its reading.
  void Step(const robot::BaseReading& truth, const Eigen::Quaterniond& R_WI,
            const Eigen::Quaterniond& told_R_WI);
  const robot::BaseReading& reading() const { return told_; }

 private:
  double dt_;
  Eigen::Vector2d drawn_;        // with a deviation of 1
  Eigen::Vector2d scale_{0, 0};  // error of the way ahead and to the left, as a share
  double walk_ = 0;              // m, standard deviation of a step
  Noise noise_;
  Eigen::Vector2d off_{0, 0};  // m, the reading less the truth
  robot::BaseReading told_;
};

}  // namespace understudy::sensors
