// The balanced stand of a humanoid, at heights from standing to the squat.
#pragma once

#include <vector>

#include "motion/humanoid/arm_action.h"
#include "motion/humanoid/bearing.h"
#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/figures.h"
#include "motion/joint_move.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Combines soft springs around a posture, the ground reactions of StandBalance, and the angles of
// arm actions.
class BalancedStand final : public HumanoidBehaviour {
 public:
  // The pointers and references must outlive it; `body` is read only in the constructor.
  BalancedStand(const robot::RobotSpec& spec, const JointGains& gains, BodyModel* body,
                Bearing* bearing);

  // Starts from locked joints, or out of a walk, and moves the centre of mass to the middle of the
  // soles.
  void Begin(const HumanoidReading& sensed, bool walked = false);
  // Squats or rises again. The arms go to rest.
  void Squat(bool down);
  // Goes to a height from 0, the lowest, to 1, the highest at which it stands with arm actions.
  void StandAt(double height);

  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;
  bool over() const override { return depth_.over(); }  // it has reached the height
  bool upright() const { return depth_.over() && depth_.q(0) == 0; }
  bool squats() const { return squats_; }  // was last told to go down

  ArmActionPlayer& arms() { return arms_; }
  const ArmActionPlayer& arms() const { return arms_; }

 private:
  void GoTo(double depth, double duration);
  StandGoal Goal() const;
  double Crouched(std::size_t motor) const;  // rad, angle of the posture at the present depth

  const robot::RobotSpec& spec_;
  const JointGains& gains_;
  Bearing* bearing_;
  ArmActionPlayer arms_;
  std::vector<bool> soft_;  // by motor: whether its spring becomes soft
  StandFigures standing_, half_down_, squatting_;
  JointMove depth_{1};       // from standing, 0, to squatting, 1
  JointMove com_offset_{2};  // m
  bool squats_ = false;
  double elapsed_ = 0;  // s since Begin
};

}  // namespace understudy::motion
