#include "motion/humanoid/policy_walk.h"

namespace understudy::motion {

void PolicyWalk::Begin(const HumanoidReading& sensed) {
  Sense(sensed);
  Ask({0, 0, 0}, 0);
  drive_->Begin();
}

void PolicyWalk::Ask(const Eigen::Vector3d& velocity, double hold) {
  drive_->Ask(velocity);
  counts_for_ = hold;
}

void PolicyWalk::Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) {
  Sense(sensed);
  counts_for_ -= dt;
  if (counts_for_ <= 0) drive_->Ask({0, 0, 0});
  drive_->Step(dt, command);
}

void PolicyWalk::Sense(const HumanoidReading& sensed) {
  for (std::size_t i = 0; i < sensed.q.size(); ++i) drive_->Sense(i, sensed.q[i], sensed.dq[i]);
  drive_->Sense(sensed.imu.R_WI, sensed.imu.w_WI_I);
}

}  // namespace understudy::motion
