// The motion service of a robot that nothing here can make move.
#pragma once

#include "authority/motion.h"

namespace understudy::motion {

// Damps, or lets the joints hang, and can do nothing else.
class DampingMotion final : public authority::Motion {
 public:
  // `damped` and `limp` are what state() says in either state; `kd` [N·m·s/rad] damps each joint.
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
