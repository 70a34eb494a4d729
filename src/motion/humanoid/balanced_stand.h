// Standing balanced, higher or lower, down to a squat.
#pragma once

#include <vector>

#include "motion/humanoid/arm_action.h"
#include "motion/humanoid/bearing.h"
#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/figures.h"
#include "motion/joint_move.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Soft springs around a posture, the ground reactions of StandBalance, and the arms where an action
// has them.
class BalancedStand final : public HumanoidBehaviour {
 public:
  // What is handed over must outlive it; `body` is read in the constructor only.
  BalancedStand(const robot::RobotSpec& spec, const JointGains& gains, BodyModel* body,
                Bearing* bearing);

  // From locked joints: the centre of mass goes from where it is to the middle of the soles.
  void Begin(const HumanoidReading& sensed);
  // Goes down to the squat, or up again. The arms come to rest.
  void Squat(bool down);
  // Goes to a height between the lowest, 0, and the highest, 1, that it stands at with arm actions.
  void StandAt(double height);

  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;
  bool over() const override { return depth_.over(); }  // it is as high as is wanted
  bool upright() const { return depth_.over() && depth_.q(0) == 0; }

  ArmActionPlayer& arms() { return arms_; }
  const ArmActionPlayer& arms() const { return arms_; }

 private:
  void GoTo(double depth, double duration);
  StandGoal Goal() const;
  double Crouched(std::size_t motor) const;  // rad, the posture at the present depth

  const robot::RobotSpec& spec_;
  const JointGains& gains_;
  Bearing* bearing_;
  ArmActionPlayer arms_;
  std::vector<bool> soft_;  // by motor: whether its spring becomes soft
  StandFigures standing_, half_down_, squatting_;
  JointMove depth_{1};       // from standing, 0, to squatting, 1
  JointMove com_offset_{2};  // m
  double elapsed_ = 0;       // s since Begin
};

}  // namespace understudy::motion
