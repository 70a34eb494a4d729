// The motion service of a humanoid: limp, damped, locked joints, balanced stand, walk, arm actions.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "authority/motion.h"
#include "motion/humanoid/balanced_stand.h"
#include "motion/humanoid/bearing.h"
#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/figures.h"
#include "motion/humanoid/fsm.h"
#include "motion/humanoid/policy_walk.h"
#include "motion/humanoid/postures.h"
#include "motion/humanoid/senses.h"
#include "motion/humanoid/walk.h"
#include "physics/robot_body.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Standing, motors are springs around a posture, with feed-forward torques that carry the weight
// and press the soles on the ground. These torques scale with the load on the feet: a robot on the
// crane hangs by its springs and takes over its weight while it is set down. Inputs are joints,
// LowState's IMU and foot loads. fsm.h has its state machine; in each state one behaviour controls
// the motors.
class HumanoidMotion final : public authority::Motion {
 public:
  // `spec` and the body's model must outlive it; nothing else of `body` is read. Throws ModelError
  // if the robot does not have two feet or one has no geoms in the model. `policy` plays the states
  // of robot.motion.humanoid.walk; without it they are balanced or unplayed.
  HumanoidMotion(const robot::RobotSpec& spec, const physics::RobotBody& body,
                 std::unique_ptr<PolicyDrive> policy = nullptr);

  // Starts in zero torque, or in lock stand if the robot stands in its standing pose (*assumed*).
  void Start(const authority::MotionInput& input) override;
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override;
  void Step(const authority::MotionInput& input, double dt, robot::RobotCommand* command) override;
  robot::MotionState state() const override;

 private:
  bool walking() const { return now_ == &walk_; }
  bool balanced() const { return now_ == &stand_ || walking(); }
  bool driven() const { return policy_ && now_ == &*policy_; }
  bool moving() const { return !now_->over(); }
  bool IsInStandingPose() const;
  bool unloaded() const;  // its feet carry nothing where they should
  bool may_step() const;

  authority::MotionVerdict SetFsm(int id);
  authority::MotionVerdict Move(const authority::goal::Move& move);
  authority::MotionVerdict SetBalanceMode(int mode);
  authority::MotionVerdict SetStandHeight(double height);
  authority::MotionVerdict BeginArmAction(int id);
  void Slacken(int id);
  void Lock(int id, std::span<const double> q, double duration);
  void Balance(int id);
  void Drive(int id);
  void StepOrStand(double dt);
  void FollowArms(double weight);

  const robot::RobotSpec& spec_;
  const robot::HumanoidMotionSpec ids_;
  HumanoidSenses senses_;
  JointGains gains_;
  Bearing bearing_;
  Slack slack_;
  LockedPosture posture_;
  BalancedStand stand_;
  HumanoidWalk walk_;
  std::optional<PolicyWalk> policy_;

  int id_ = robot::kZeroTorqueId;
  HumanoidBehaviour* now_ = &slack_;  // the active behaviour
  int stood_in_ = -1;                 // the last state of upright balance
  double down_for_ = 0;               // s since it began to squat, in the balanced squat
  double aloft_ = 0;                  // s that it has walked without load on its feet
};
}  // namespace understudy::motion
