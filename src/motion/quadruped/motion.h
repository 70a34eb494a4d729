// The motion service of a quadruped, as far as it needs no walking.
#ifndef UNDERSTUDY_MOTION_QUADRUPED_MOTION_H_
#define UNDERSTUDY_MOTION_QUADRUPED_MOTION_H_

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "authority/motion.h"
#include "motion/joint_move.h"
#include "motion/quadruped/body.h"
#include "motion/quadruped/estimator.h"
#include "motion/quadruped/gestures.h"
#include "motion/quadruped/recovery.h"
#include "motion/quadruped/stance.h"
#include "physics/world.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Stands, lies, sits, gestures and gets up, on joint angles and the inertial unit alone.
//
// Which goal is legal in which state is assumed where it is not the vendor's word
// (docs/fidelity.md): the vendor's graph was not found.
class QuadrupedMotion : public authority::Motion {
 public:
  // `spec` must outlive it.
  QuadrupedMotion(const robot::RobotSpec& spec, const QuadrupedFigures& figures);

  // Damped; a robot that stands is kept standing, balanced. Assumed: whether a real one stands up
  // by itself after boot, and into which state, is not known.
  void Start(const authority::MotionInput& input) override;

  // kMove: kUnable; after StandUp taken and without effect, as on a real Go2
  // (docs/sources.md#go2-captures). Euler angles and body height beyond their range are cut to it.
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override;

  void Step(const authority::MotionInput& input, double dt, robot::RobotCommand* command) override;

  robot::MotionState state() const override;

 private:
  enum class State : std::uint8_t {
    kDamped,
    kFolding,    // joints move to the crouch, towards a stand
    kRising,     // feet move down under the body
    kLocked,     // stands, joints locked
    kLowering,   // feet move up to the crouch, towards lying
    kUnfolding,  // joints move to the lying pose
    kLying,      // joints locked
    kBalance,
    kGesture,  // hello, stretch
    kSittingDown,
    kSitting,
    kPosing,
    kRecovering,
  };

  // Ask, by kind of goal.
  authority::MotionVerdict StandUp();
  authority::MotionVerdict StandDown();
  authority::MotionVerdict BalanceStand();
  authority::MotionVerdict Recover();
  authority::MotionVerdict Sit();
  authority::MotionVerdict RiseSit();
  authority::MotionVerdict Gesture(std::span<const Keyframe> frames);
  authority::MotionVerdict Pose(bool on);
  authority::MotionVerdict Euler(const Eigen::Vector3d& rpy);
  authority::MotionVerdict BodyHeight(double height);
  authority::MotionVerdict StopMove();
  authority::MotionVerdict Move() const;

  // What a state needs at its beginning.
  void Fold();
  void Rise(const PerLeg& feet);
  void Lower();
  void Unfold();
  void Balance();
  void Play(std::size_t frame);  // past the last: back to a balanced stand
  void MoveJoints(State state, const PerLeg& goal);
  void MoveFeet(State state, const PerLeg& goal);

  // What it does in a step.
  void StepJoints(double dt, StanceCommand* legs);
  void StepFeet(double dt, StanceCommand* legs);
  void Advance();  // to the state that follows, where one does
  void Legs(robot::RobotCommand* command) const;
  void Wheels(const authority::MotionInput& input, robot::RobotCommand* command);
  static void Brake(double kd, robot::RobotCommand* command);

  // Feet as they stand under the hips, that far below them [m], in the base.
  PerLeg Under(double depth) const;
  PerLeg Stand() const;
  StancePose Default() const;  // of a balanced stand
  StancePose InMetres(const StancePose& pose) const;
  bool stands() const;    // is held by its joints, upright
  bool balances() const;  // is in one of the states that `stance_` leads
  bool upright() const;   // enough for the legs alone
  bool wheeled() const { return spec_.kind == robot::RobotKind::kWheeled; }

  const robot::RobotSpec& spec_;
  const robot::QuadrupedMotionSpec& figures_;
  QuadrupedBody body_;
  QuadrupedEstimator estimator_;
  Stance stance_;
  QuadrupedRecovery recovery_;
  JointMove joints_;
  State state_ = State::kDamped;
  bool balance_next_ = false;   // once it stands, from a recovery
  bool auto_recovery_ = false;  // outlives Start, as the services' settings do
  double fallen_for_ = 0;       // s in kDamped because of a fall; 0 when damped by a goal
  QuadrupedReading reading_;
  PerLeg feet_from_, feet_to_;  // of kRising, kLowering; in the base, m
  double elapsed_ = 0;          // s of them
  std::span<const Keyframe> frames_;
  std::size_t frame_ = 0;
  StancePose wanted_;                     // by Euler and body height
  StanceCommand legs_;                    // as of the last step
  std::array<double, 4> wheel_angles_{};  // rad against the world, while balancing
};

// The motion service of that robot. `spec` must outlive it. Throws ModelError when the model's legs
// are not those of a quadruped.
std::unique_ptr<authority::Motion> MakeQuadrupedMotion(const robot::RobotSpec& spec,
                                                       const physics::PhysicsWorld& world);

}  // namespace understudy::motion

#endif  // UNDERSTUDY_MOTION_QUADRUPED_MOTION_H_
