// Where a walking humanoid's base is and how fast it goes, by its own sensors.
#pragma once

#include <array>

#include <Eigen/Core>

#include "motion/humanoid/walk_body.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// The accelerometer carries the velocity on; soles that rest on the ground correct it. A sole that
// turns is trusted less. What always has to be corrected is an error of the IMU's attitude, which
// leans while the robot walks. The position follows from the stance sole, which stays where it was
// planted. Allocates nothing.
class WalkEstimator {
 public:
  // Starts at rest on both soles, the foot `stance` in the origin of W.
  void Begin(const WalkBody& body, std::size_t stance);

  // Returns the reading with its attitude corrected; Step and WalkBody::Update take it so.
  robot::ImuReading Corrected(const robot::ImuReading& imu) const;

  // Makes one step of dt [s]. `resting` has for each foot how much its sole counts, 1 in sum;
  // `trust`, 0 to 1, weighs both against the accelerometer.
  void Step(const WalkBody& body, const robot::ImuReading& imu,
            const std::array<double, 2>& resting, double trust, double dt);

  // From now on the foot stays where it is, and its height is 0.
  void Plant(const WalkBody& body, std::size_t foot);

  const Eigen::Vector3d& base() const { return p_WB_; }                 // m
  const Eigen::Vector3d& velocity() const { return v_WB_; }             // m/s, of the base
  Eigen::Vector3d Foot(const WalkBody& body, std::size_t foot) const {  // m, its sole's centre
    return p_WB_ + body.feet()[foot].p;
  }

 private:
  std::size_t stance_ = 0;
  Eigen::Vector3d planted_{0, 0, 0};  // m, the stance sole's centre
  Eigen::Vector3d p_WB_{0, 0, 0}, v_WB_{0, 0, 0}, v_WI_{0, 0, 0};
  std::array<Eigen::Vector3d, 2> turning_{};  // rad/s, of the soles, smoothed
  Eigen::Vector3d lean_{0, 0, 0};             // rad, error of the attitude, in the base's heading
};

}  // namespace understudy::motion
