// The motion service of a quadruped.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "authority/motion.h"
#include "motion/quadruped/asked_way.h"
#include "motion/quadruped/body.h"
#include "motion/quadruped/drive.h"
#include "motion/quadruped/estimator.h"
#include "motion/quadruped/gaits.h"
#include "motion/quadruped/gestures.h"
#include "motion/quadruped/motor_commands.h"
#include "motion/quadruped/moves.h"
#include "motion/quadruped/policy_gait.h"
#include "motion/quadruped/recovery.h"
#include "motion/quadruped/stance.h"
#include "motion/quadruped/states.h"
#include "motion/quadruped/trot.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Stands, lies, sits, gestures, gets up, walks and drives. Its state machine is the table of
// states.h; a state has one behaviour that leads the legs.
class QuadrupedMotion : public authority::Motion {
 public:
  // `spec` must outlive it. With `policy` that one walks in place of the trot.
  QuadrupedMotion(const robot::RobotSpec& spec, const QuadrupedFigures& figures,
                  std::unique_ptr<PolicyDrive> policy = nullptr);

  // Damped; a robot that stands is kept standing, in its default gait (assumed), and one that lies
  // stands up where `stands_up` says so.
  void Start(const authority::MotionInput& input) override;

  // Euler angles and body height beyond their range are cut to it.
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override;

  void Step(const authority::MotionInput& input, double dt, robot::RobotCommand* command) override;

  robot::MotionState state() const override;

 private:
  using State = QuadrupedState;
  using enum QuadrupedState;

  bool Holds(QuadrupedWhen when) const;
  void Enter(State state);  // begins what the legs do in it
  void Stand(State from);
  void Keep(const authority::MotionGoal& goal);  // what a goal sets beside the state
  void SetPose(const StancePose& pose);
  void Use(const GaitRow& gait, int level);

  // Of a robot that stands or drives: how fast its feet roll, m/s, world; whether it was pushed so
  // hard that it has to step.
  Eigen::Vector3d Rolling() const;
  bool Topples() const;
  // Begins to walk or drive, and ends what was not renewed.
  void Move(const authority::MotionInput& input, double dt);
  // Of a step: falls and their effects; commands to the motors.
  void Wheels(const authority::MotionInput& input, robot::RobotCommand* command);

  PerLeg Under(double depth) const;  // feet that far below the hips [m], in the base
  StancePose Default() const;        // of a balanced stand
  Eigen::Vector3d Here() const;      // by the estimate: x, y [m], yaw [rad]
  bool upright() const;              // enough for the legs alone
  bool wheeled() const { return spec_.kind == robot::RobotKind::kWheeled; }

  static constexpr double kLongAgo = 1e9;  // s

  const robot::RobotSpec& spec_;
  robot::QuadrupedMotionSpec figures_;  // `walk` is that of the gait in force
  QuadrupedBody body_;
  QuadrupedEstimator estimator_;
  JointsMove joints_;
  FeetMove feet_;
  Stance stance_;
  KeyframePlayer gesture_;
  QuadrupedRecovery recovery_;
  Trot trot_;
  std::optional<PolicyGait> policy_;  // walks in place of the trot
  Drive drive_;
  WheelCommands wheels_;

  State state_ = State::kDamped;
  State stand_ = State::kStanding;  // the one that gestures and poses end in
  double since_ = 0;                // s in this state
  Behaviour* now_ = nullptr;        // what leads the legs; none: they stay as they are, or brake
  bool auto_recovery_ = false;      // outlives Start, as the services' settings do
  const GaitRow* gait_ = nullptr;
  int level_ = 0;          // of speed
  double foot_raise_ = 0;  // m over the gait's
  bool stepping_ = false;  // on the spot where it would stand
  authority::goal::GestureName gesture_name_{};
  AskedWay asked_;
  double led_ = kLongAgo;  // s ago that a goal led the body of a stand elsewhere
  double rolls_for_ = 0;   // s since when wheels could do what is asked for, or it began to step
  std::optional<authority::MotionGoal> then_;  // what it stops walking for
  bool fallen_ = false;                        // damped because of a fall, not of a goal
  QuadrupedReading reading_;
  StancePose wanted_;  // by Euler and body height
  LegCommand legs_;    // as of the last step
};
}  // namespace understudy::motion
