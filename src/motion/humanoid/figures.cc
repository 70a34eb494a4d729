#include "motion/humanoid/figures.h"

#include <algorithm>
#include <cmath>

namespace understudy::motion {
namespace {

// Assumed, tried on every robot here.
constexpr double kLockStiffness = 1.75;  // of a locked joint, in m g h of the whole robot: a G1
                                         // stands with 400 N·m/rad at the ankle, which is that
constexpr double kLockDamping = 0.7;     // damping ratio of a locked joint in the air
constexpr double kBearingMass = 0.25;    // share of the robot's mass from which a joint bears

}  // namespace

StandFigures StandOf(std::span<const double> q, BodyModel* body) {
  const std::vector<double> still(q.size());
  // Finds the IMU reading for an upright base, then for flat soles, from that of the present soles.
  robot::ImuReading imu;
  body->Update(q, still, imu);
  const Eigen::Matrix3d R_IB = body->attitude();  // the IMU was taken to be upright
  imu.R_WI = Eigen::Quaterniond(Eigen::Matrix3d(R_IB.transpose()));
  body->Update(q, still, imu);
  const Eigen::Vector3d up = body->soles()[0].up + body->soles()[1].up;
  const double pitch = -std::atan2(up.x(), up.z());
  const Eigen::Matrix3d R_WB =
      Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).toRotationMatrix();
  imu.R_WI = Eigen::Quaterniond(Eigen::Matrix3d(R_WB * R_IB.transpose()));
  body->Update(q, still, imu);
  return {.com_height = body->com().z(), .base_height = body->base().z(), .pitch = pitch};
}

JointGains FindGains(const robot::RobotSpec& spec, BodyModel* body) {
  const double height = StandOf(spec.standing.q, body).com_height;
  const double stiff = kLockStiffness * body->mass() * body->gravity() * height;
  const double period = body->motor_period();
  JointGains gains;
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const bool bears = body->IsOfLeg(i) || body->CarriedMass(i) > kBearingMass * body->mass();
    double kp = spec.motors[i].hold_kp, kd = spec.motors[i].hold_kd;
    if (bears) {
      // Limits the stiffness: a torque that is held for one period makes a stiffer spring
      // oscillate.
      const double inertia = body->FeltInertia(i);
      kp = std::min(stiff, 0.1 * inertia / (period * period));
      kd = 2 * kLockDamping * std::sqrt(kp * inertia);
    }
    gains.bears.push_back(bears);
    gains.kp.push_back(kp);
    gains.kd.push_back(kd);
  }
  return gains;
}

}  // namespace understudy::motion
