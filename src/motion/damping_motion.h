// The motion service of a robot that nothing here can make move.
#ifndef UNDERSTUDY_MOTION_DAMPING_MOTION_H_
#define UNDERSTUDY_MOTION_DAMPING_MOTION_H_

#include "authority/motion.h"

namespace understudy {

// Damps, or lets the joints hang, and can do nothing else.
class DampingMotion final : public Motion {
 public:
  // `damped` and `limp` are what state() says in either state; `kd` [N·m·s/rad] damps each joint.
  DampingMotion(const MotionState& damped, const MotionState& limp, double kd)
      : damped_(damped), limp_(limp), kd_(kd) {}

  void Start(const MotionInput&) override { is_limp_ = false; }
  MotionVerdict Ask(const MotionGoal& goal) override;
  void Step(const MotionInput& input, double dt, RobotCommand* command) override;
  MotionState state() const override { return is_limp_ ? limp_ : damped_; }

 private:
  MotionState damped_, limp_;
  double kd_;
  bool is_limp_ = false;
};

}  // namespace understudy

#endif  // UNDERSTUDY_MOTION_DAMPING_MOTION_H_
