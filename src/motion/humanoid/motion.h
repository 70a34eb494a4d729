// The motion service of a humanoid: lies limp, locks its joints, stands balanced, moves its arms.
// It does not walk.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "authority/motion.h"
#include "motion/humanoid/arm_action.h"
#include "motion/humanoid/body_model.h"
#include "motion/humanoid/fsm.h"
#include "motion/humanoid/stand_balance.h"
#include "motion/joint_move.h"
#include "physics/robot_body.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Motors follow springs around a posture; torques carry the weight of what hangs from each joint
// and press the soles on the ground. While joints are locked the springs are stiff and the weight
// is carried where it is; while balancing they are soft and the ground reactions are
// StandBalance's. How much the feet bear decides how much of that applies: a robot on the crane
// hangs calmly by its springs and takes over its weight as it is set down. Senses joints,
// LowState's unit and foot loads.
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
  // What standing in one posture comes to, on flat soles.
  struct Stand {
    double com_height = 0;   // m over the soles
    double base_height = 0;  // m
    double pitch = 0;        // rad, of the base
  };

  Stand StandOf(std::span<const double> q);
  void FindGains();
  StandGoal BalanceGoal() const;
  double Crouched(std::size_t motor) const;  // rad, the posture at the present depth
  bool locked() const;
  bool balanced() const;
  bool moving() const;

  authority::MotionVerdict SetFsm(int id);
  authority::MotionVerdict SetStandHeight(double height);
  authority::MotionVerdict BeginArmAction(int id);
  void Lock(std::span<const double> q);
  void Balance(int id);

  void Sense(const authority::MotionInput& input, double dt);
  void Feel(const authority::MotionInput& input, double dt);
  void Brake(robot::RobotCommand* command) const;
  void HoldPosture(robot::RobotCommand* command) const;

  const robot::RobotSpec& spec_;
  const robot::HumanoidMotionSpec& ids_;
  BodyModel body_;
  StandBalance balance_;
  ArmActionPlayer arms_;
  std::vector<bool> bears_;      // whether the motor is of legs or waist
  std::vector<double> kp_, kd_;  // of locked joints
  Stand standing_, half_down_, squatting_;

  int id_ = kZeroTorqueId;
  int stood_in_ = -1;           // the last state that stood balanced upright
  std::vector<double> q_, dq_;  // rad, rad/s, measured last
  JointMove posture_;           // of all motors, while locked
  JointMove depth_{1};          // from standing, 0, to squatting, 1, while balanced
  JointMove com_offset_{2};     // m, while balanced
  double balanced_for_ = 0;     // s
  double load_ = 0;             // share of the weight that the feet bear, 0 to 1
  double since_sensed_ = 0;     // s
  bool fresh_ = true;           // has not sensed since Start
  std::vector<double> tau_;     // N·m, of the last Sense
};

// The service as HumanoidMotion's constructor makes it.
std::unique_ptr<authority::Motion> MakeHumanoidMotion(const robot::RobotSpec& spec,
                                                      const physics::RobotBody& body);

}  // namespace understudy::motion
