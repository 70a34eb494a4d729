// The motion service of a humanoid: lies limp, locks its joints, stands balanced, moves its arms.
// It does not walk.
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

// Motors follow springs around a posture; torques carry the weight of what hangs from each joint
// and press the soles on the ground. How much the feet bear decides how much of that applies: a
// robot on the crane hangs calmly by its springs and takes over its weight as it is set down.
// Senses joints, LowState's unit and foot loads. Its state machine is the table of fsm.h; in each
// state one behaviour leads the body.
class HumanoidMotion final : public authority::Motion {
 public:
  // `spec` and the body's model must outlive it; the body, of the same robot, is not read
  // otherwise. Throws ModelError when the robot has other than two feet or one has no geoms in the
  // model.
  HumanoidMotion(const robot::RobotSpec& spec, const physics::RobotBody& body);

  // Zero torque; lock stand where the robot stands in its standing pose (*assumed*).
  void Start(const authority::MotionInput& input) override;
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override;
  void Step(const authority::MotionInput& input, double dt, robot::RobotCommand* command) override;
  robot::MotionState state() const override;

 private:
  bool balanced() const { return now_ == &stand_; }
  bool moving() const { return !now_->over(); }
  bool IsInStandingPose() const;

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
  HumanoidBehaviour* now_ = &slack_;  // what leads the body
  int stood_in_ = -1;                 // the last state that stood balanced upright
};

// The service as HumanoidMotion's constructor makes it.
std::unique_ptr<authority::Motion> MakeHumanoidMotion(const robot::RobotSpec& spec,
                                                      const physics::RobotBody& body);

}  // namespace understudy::motion
