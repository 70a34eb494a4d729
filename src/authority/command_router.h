// Selects the commands that the motors follow. The body's motors follow the motion service, blended
// with rt/arm_sdk, or rt/user_lowcmd or rt/lowcmd; a hand's motors follow the hand's topic, blended
// with rt/hand_sdk.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "authority/chord.h"
#include "authority/command_gate.h"
#include "authority/hand_gate.h"
#include "authority/intake.h"
#include "authority/motion_config.h"
#include "authority/motor_owner.h"
#include "authority/overlay.h"
#include "authority/unheeded.h"
#include "robot/command_topics.h"
#include "robot/fault.h"

namespace understudy::authority {

// While a motion service is on, the gate is closed, the service moves the motors and rt/arm_sdk is
// blended in; while the service has handed the motors over, they follow rt/user_lowcmd. After its
// release the motors damp until rt/lowcmd comes (*assumed*, as the robot's behaviour is not
// documented).
class CommandRouter {
 public:
  // `spec` and `config` are validated. `start` is the command while no service is on and none has
  // been taken. `make` as for MotorOwner.
  CommandRouter(const robot::RobotSpec& spec, const GateConfig& gate, const MotionConfig& config,
                const robot::RobotCommand& start, const MotionMaker& make);

  // Call it after the robot was put back in a start pose, with the command that holds it there. The
  // motion service or the gate restarts.
  void Restart(const robot::RobotCommand& start);

  // The robot was switched off: no motion service is on and the motors have no torque, until a
  // service is switched on or a command is taken.
  void GoLimp();

  // Goes by these from now on; the damping stays as it was made.
  void Apply(const GateConfig& gate, const MotionConfig& config);

  // Takes or refuses a command of a topic of the robot at time t [s]; `form` and result as for
  // Intake::Judge.
  robot::Refusal Offer(std::size_t topic, const robot::RobotCommand& command, robot::Refusal form,
                       double t);
  // Counts commands of a topic that were refused before they came to be offered.
  void Count(std::size_t topic, robot::Refusal refusal, std::uint64_t times) {
    intakes_[topic].Count(refusal, times);
  }
  // Whether the programs of the hands run at time t [s].
  void RunHands(std::span<const robot::HandEffects> faults, double t);
  // Follows the keys and sticks of the remote controller at time t [s].
  void Obey(const robot::RemoteReading& remote, double t);
  // Returns what the last Obey was asked for and the robot does not do: of chords each, of sticks
  // once until they are at rest again.
  const std::optional<Unheeded>& unheeded() const { return unheeded_; }

  // Returns the command to all motors at input.time. With `service_due` the motion service, if one
  // is on, first makes a step of `dt` seconds. Valid until the next call or Restart.
  const robot::RobotCommand& Current(const MotionInput& input, bool service_due, double dt);
  // Returns the last result of Current; before, the start command.
  const robot::RobotCommand& command() const { return followed_; }

  MotorOwner& owner() { return owner_; }
  const MotorOwner& owner() const { return owner_; }
  bool service_on() const { return !owner_.active().empty(); }
  // Returns the state of the motion service; nullopt while none is on.
  std::optional<robot::MotionState> motion() const {
    return service_on() ? std::optional(owner_.state()) : std::nullopt;
  }
  const CommandGate& gate() const { return gate_; }
  // Returns the counts of a topic; zeros if the robot does not have it.
  GateCounts counts(std::size_t topic) const;
  // Returns the velocity that the sticks command: forward, left m/s, turn rad/s.
  const std::array<double, 3>& stick_wish() const { return stick_wish_; }
  double arm_weight(double t) const { return arms_.weight(t); }
  double hand_weight(double t) const { return over_hands_.weight(t); }

 private:
  const robot::RobotCommand& OfBody(const MotionInput& input, bool service_due, double dt);
  // Assembles followed_ of a command to the body and those of the hands at time t [s].
  void Assemble(const robot::RobotCommand& body, double t);
  // Whether the motion service that is on damps: it passes no commands of rt/hand_sdk on.
  bool Damps() const { return service_on() && owner_.state().id == robot::kDampingId; }
  void FollowOwner();  // opens or closes the gate after a change of owner
  void ObeyKeys(const robot::RemoteReading& remote, double t);
  void ObeySticks(const robot::RemoteReading& remote);

  bool fight_;
  Eigen::Vector3d stick_speed_;
  CommandGate gate_;
  CommandGate user_gate_;
  MotorOwner owner_;
  Overlay arms_;
  Overlay over_hands_;  // rt/hand_sdk
  std::vector<HandGate> hands_;
  std::vector<Intake> intakes_;  // by topic
  ChordReader chords_;
  robot::RobotCommand own_;    // the last one of the motion service
  robot::RobotCommand mixed_;  // the same, blended with rt/arm_sdk
  robot::RobotCommand followed_;
  bool was_on_ = false;
  bool was_user_ = false;
  bool fresh_lowcmd_ = false;  // one was taken in this tick
  bool fought_ = false;        // rt/lowcmd is newer than the service's command
  bool sticks_moved_ = false;
  bool sticks_unheeded_ = false;  // since they moved, and told
  std::optional<Unheeded> unheeded_;
  std::array<double, 3> stick_wish_{};
};

}  // namespace understudy::authority
