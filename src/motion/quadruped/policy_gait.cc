#include "motion/quadruped/policy_gait.h"

#include <algorithm>

namespace understudy::motion {
namespace {

// All assumed.
constexpr double kShortestStop = 0.5;  // s from the last command to the stand
constexpr double kLongestStop = 3;     // s, of a policy that always steps
constexpr double kStandingRate = 0.5;  // rad/s, at most, of the joints of a robot that stands
constexpr double kStandingForce = 10;  // N on each foot of a robot that stands

}  // namespace

void PolicyGait::Sense(const authority::MotionInput& input) {
  for (std::size_t i = 0; i < command_.motors.size(); ++i) {
    drive_->Sense(i, input.motors[i].q, input.motors[i].dq);
  }
  drive_->Sense(input.imu.R_WI, input.imu.w_WI_I);
}

void PolicyGait::Begin() {
  idle_ = 0;
  over_ = false;
  drive_->Begin();
}

void PolicyGait::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  drive_->Step(dt, &command_);
  for (std::size_t i = 0; i < 12; ++i) {
    legs->q[i / 3][static_cast<Eigen::Index>(i % 3)] = command_.motors[i].q;
  }
  for (std::size_t leg = 0; leg < legs->q.size(); ++leg) {
    legs->dq[leg].setZero();
    legs->tau[leg].setZero();
  }
  idle_ = drive_->asked() || keeps_stepping_ ? 0 : idle_ + dt;
  const bool on_feet =
      std::ranges::all_of(sensed.foot_force, [](double force) { return force > kStandingForce; });
  const bool still = std::ranges::all_of(sensed.dq, [](const Eigen::Vector3d& dq) {
    return dq.cwiseAbs().maxCoeff() < kStandingRate;
  });
  over_ = idle_ > kLongestStop || (idle_ > kShortestStop && on_feet && still);
}

}  // namespace understudy::motion
