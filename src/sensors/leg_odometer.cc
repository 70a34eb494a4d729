#include "sensors/leg_odometer.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace understudy::sensors {

using Eigen::Vector3d;

void LegOdometer::Restart(const robot::BaseReading& truth) {
  start_ = truth.p_WB.head<2>();
  p_.setZero();
  off_ = 0;
  follows_ = false;
}

std::optional<robot::LegOdometry> LegOdometer::Read(const robot::RobotState& sample) {
  if (!sample.motion || !sample.motion->estimates) {
    follows_ = false;
    return std::nullopt;
  }
  if (errors_.legs == OdometrySource::kTruth) {
    robot::LegOdometry truth{.R_OB = sample.truth.imu.R_WI, .p_OB = sample.base.p_WB};
    truth.p_OB.head<2>() -= start_;
    truth.v_OB_B = truth.R_OB.conjugate() * sample.base.v_WB_W;
    return truth;
  }
  const robot::MotionState& motion = *sample.motion;
  const Eigen::Vector2d p = motion.p_WB.head<2>();
  const Vector3d ahead = sample.imu.R_WI * Vector3d::UnitX();
  const double yaw = std::atan2(ahead.y(), ahead.x());
  const double share = 1 - errors_.shortfall;
  if (follows_) {
    off_ += errors_.turn * std::remainder(yaw - last_yaw_, 2 * std::numbers::pi);
    p_ += share * (Eigen::Rotation2Dd(off_) * (p - last_p_));
  }
  last_p_ = p;
  last_yaw_ = yaw;
  follows_ = true;
  return robot::LegOdometry{.R_OB = Eigen::AngleAxisd(off_, Vector3d::UnitZ()) * sample.imu.R_WI,
                            .p_OB = {p_.x(), p_.y(), motion.body_height},
                            .v_OB_B = share * (sample.imu.R_WI.conjugate() * motion.v_WB_W)};
}

}  // namespace understudy::sensors
