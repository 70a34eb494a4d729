// The motion service of a robot without a controller: it only damps.
#pragma once

#include "authority/motion.h"

namespace understudy::motion {

// Damps the joints or lets them go limp; refuses all other goals.
class DampingMotion final : public authority::Motion {
 public:
  // state() returns `damped` or `limp`; `kd` [N·m·s/rad] damps each joint.
  DampingMotion(const robot::MotionState& damped, const robot::MotionState& limp, double kd)
      : damped_(damped), limp_(limp), kd_(kd) {}

  void Start(const authority::MotionInput&) override { is_limp_ = false; }
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override;
  void Step(const authority::MotionInput& input, double dt, robot::RobotCommand* command) override;
  robot::MotionState state() const override { return is_limp_ ? limp_ : damped_; }

 private:
  robot::MotionState damped_, limp_;
  double kd_;
  bool is_limp_ = false;
};

}  // namespace understudy::motion
