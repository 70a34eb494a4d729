// The walk of a humanoid.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "motion/humanoid/arm_action.h"
#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/figures.h"
#include "motion/humanoid/foot_swing.h"
#include "motion/humanoid/step_planner.h"
#include "motion/humanoid/walk_body.h"
#include "motion/humanoid/walk_estimator.h"
#include "motion/humanoid/walk_solver.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// From a stand on both feet it sways over to one of them, steps as the commanded velocity needs it,
// and stands up again once none is commanded. It also steps when it would topple. Legs follow
// torques alone; waist and arms are springs, and arms swing against the legs where no action moves
// them. Allocates only in the constructor.
class HumanoidWalk final : public HumanoidBehaviour {
 public:
  // The references must outlive it; `body` is read only in the constructor.
  HumanoidWalk(const mjModel& model, const robot::RobotSpec& spec, const JointGains& gains,
               BodyModel* body, ArmActionPlayer* arms);

  bool possible() const { return body_.can_walk(); }

  // Commands forward, left m/s and turn rad/s for `hold` s, as far as the robot walks so fast.
  void Ask(const Eigen::Vector3d& velocity, double hold);
  // Whether it steps on the spot where it would stand.
  void KeepStepping(bool on) { keeps_stepping_ = on; }
  // Nothing is commanded any more.
  void Forget();
  bool wanted() const { return keeps_stepping_ || !wish_.isZero(0); }

  // Starts from a stand on both feet.
  void Begin(const HumanoidReading& sensed);
  // Whether a robot that stands on both feet can only keep up by a step.
  bool Topples(const HumanoidReading& sensed) const;

  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;
  // It stands on both feet as high as at the start, and nothing is commanded.
  bool over() const override;
  const Eigen::Vector3d& velocity() const { return estimator_.velocity(); }  // m/s, of the base

 private:
  enum class Phase : std::uint8_t { kStand, kSway, kStep };
  struct Arm {  // a shoulder that swings
    std::size_t motor = 0;
    double side = 1;                // 1 left, -1 right
    double q = 0, dq = 0, ddq = 0;  // off the arm's rest
  };

  struct Mark {                         // at a touchdown
    Eigen::Vector3d com{0, 0, 0};       // m
    Eigen::Vector3d velocity{0, 0, 0};  // wanted
    double time = 0;                    // s of walking; 0: none
  };

  std::size_t other() const { return 1 - stance_; }
  double side() const { return body_.feet()[stance_].side; }
  Eigen::Vector3d Place(std::size_t foot) const { return estimator_.Foot(body_, foot); }
  Eigen::Matrix3d Heading() const;
  Eigen::Vector2d InHeading(const Eigen::Vector3d& way) const;  // x ahead, y left
  Eigen::Vector2d CaptureFrom(const Eigen::Vector3d& place) const;
  bool Topples() const;

  void Sense(const HumanoidReading& sensed, double dt);
  void ReadPendulum();
  void Slew(double dt);
  void ChangePhase();
  void BeginSway(bool topples);
  bool MayLiftOff() const;
  void LiftOff(double elapsed);
  void TouchDown();
  void Trim();
  bool MayStand() const;
  void StandOn(std::size_t foot);
  void Plan();
  void ShareLoad();
  void MoveFoot(double dt);
  void MoveBody(double dt);
  void SwingArms(double dt);
  void Write(const HumanoidReading& sensed, robot::RobotCommand* command) const;

  const robot::RobotSpec& spec_;
  const JointGains& gains_;
  ArmActionPlayer* arms_;
  WalkBody body_;
  WalkEstimator estimator_;
  WalkSolver solver_;
  double standing_ = 0;  // m, height of the centre of mass over the soles, standing
  double walking_ = 0;   // m, of the same, walking
  double distance_ = 0;  // m, between the soles, standing
  StepPlanner planner_;
  FootSwing swing_;
  std::vector<bool> of_leg_;  // by motor
  std::vector<Arm> swinging_;
  std::vector<double> tau_;  // N·m, by motor

  Eigen::Vector3d wish_{0, 0, 0}, velocity_{0, 0, 0};  // m/s ahead and left, rad/s
  double counts_for_ = 0;                              // s until the wish expires
  bool keeps_stepping_ = false;
  Eigen::Vector3d trim_{0, 0, 0};  // m/s, more than the wanted velocity, that brings it about
  std::array<Mark, 2> marks_;      // of the last touchdown and the one before
  double walked_ = 0;              // s since Begin

  Phase phase_ = Phase::kStand;
  double elapsed_ = 0;    // s in this phase, of a step since it began
  bool topples_ = false;  // sways because it toppled, not to walk
  std::size_t stance_ = 0;
  double heading_ = 0;                                    // rad
  double height_ = 0;                                     // m, wanted of the centre of mass
  Eigen::Vector3d com_{0, 0, 0}, com_velocity_{0, 0, 0};  // m, m/s
  Eigen::Vector2d capture_{0, 0};                         // m
  StepPlan plan_;
  double shared_ = 0;  // of the weight, that the other foot bears
  WalkTask task_;
};

}  // namespace understudy::motion
