// The motion service of a humanoid: limp, damped, locked joints, balanced stand, arm actions. It
// does not walk.
#pragma once

#include <memory>
#include <span>

#include "authority/motion.h"
#include "motion/humanoid/balanced_stand.h"
#include "motion/humanoid/bearing.h"
#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/figures.h"
#include "motion/humanoid/fsm.h"
#include "motion/humanoid/postures.h"
#include "motion/humanoid/senses.h"
#include "physics/robot_body.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Motors are springs around a posture, with feed-forward torques that carry the weight and press
// the soles on the ground. These torques scale with the load on the feet: a robot on the crane
// hangs by its springs and takes over its weight while it is set down. Inputs are joints,
// LowState's IMU and foot loads. fsm.h has its state machine; in each state one behaviour controls
// the motors.
class HumanoidMotion final : public authority::Motion {
 public:
  // `spec` and the body's model must outlive it; nothing else of `body` is read. Throws ModelError
  // if the robot does not have two feet or one has no geoms in the model.
  HumanoidMotion(const robot::RobotSpec& spec, const physics::RobotBody& body);

  // Starts in zero torque, or in lock stand if the robot stands in its standing pose (*assumed*).
  void Start(const authority::MotionInput& input) override;
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override;
  void Step(const authority::MotionInput& input, double dt, robot::RobotCommand* command) override;
  robot::MotionState state() const override;

 private:
  bool balanced() const { return now_ == &stand_; }
  bool moving() const { return !now_->over(); }
  bool IsInStandingPose() const;
  bool unloaded() const;  // its feet carry nothing where they should

  authority::MotionVerdict SetFsm(int id);
  authority::MotionVerdict SetStandHeight(double height);
  authority::MotionVerdict BeginArmAction(int id);
  void Slacken(int id);
  void Lock(int id, std::span<const double> q, double duration);
  void Balance(int id);

  const robot::RobotSpec& spec_;
  const robot::HumanoidMotionSpec& ids_;
  HumanoidSenses senses_;
  JointGains gains_;
  Bearing bearing_;
  Slack slack_;
  LockedPosture posture_;
  BalancedStand stand_;

  int id_ = kZeroTorqueId;
  HumanoidBehaviour* now_ = &slack_;  // the active behaviour
  int stood_in_ = -1;                 // the last state of upright balance
  double down_for_ = 0;               // s since it began to squat, in the balanced squat
};

// Makes a HumanoidMotion.
std::unique_ptr<authority::Motion> MakeHumanoidMotion(const robot::RobotSpec& spec,
                                                      const physics::RobotBody& body);

}  // namespace understudy::motion
