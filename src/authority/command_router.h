// Which commands the motors follow: those of the body the motion service's, rt/arm_sdk mixed over
// it, rt/user_lowcmd or rt/lowcmd; those of a hand its own topic's.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "authority/arm_overlay.h"
#include "authority/chord.h"
#include "authority/command_gate.h"
#include "authority/hand_gate.h"
#include "authority/intake.h"
#include "authority/motion_config.h"
#include "authority/motor_owner.h"
#include "robot/command_topics.h"

namespace understudy::authority {

// While a motion service is on it moves the motors, the gate is closed and rt/arm_sdk counts; while
// it has handed them over, rt/user_lowcmd. Once it lets go, motors brake until rt/lowcmd comes
// (*assumed*: what a robot does in between is not documented).
class CommandRouter {
 public:
  // `spec` and `config` have been validated. `start` is what the motors do when no service is on
  // and nobody has commanded.
  CommandRouter(const robot::RobotSpec& spec, const GateConfig& gate, const MotionConfig& config,
                const robot::RobotCommand& start, std::unique_ptr<Motion> motion);

  // The robot is back in a pose that it can start in, `start` is what its motors do there; whoever
  // moves them begins anew.
  void Restart(const robot::RobotCommand& start);

  // A command of a topic that the robot has, at time t [s]; `form` and the answer as for
  // Intake::Judge.
  robot::Refusal Offer(std::size_t topic, const robot::RobotCommand& command, robot::Refusal form,
                       double t);
  // The remote controller at time t [s].
  void Obey(const robot::RemoteReading& remote, double t);

  // What the motors, body and hands, follow at input.time. With `service_due` the motion service,
  // if one is on, makes a step of `dt` seconds first. Valid until the next call or Restart.
  const robot::RobotCommand& Current(const MotionInput& input, bool service_due, double dt);
  // The last Current; what they do at the start before the first.
  const robot::RobotCommand& command() const { return followed_; }

  MotorOwner& owner() { return owner_; }
  const MotorOwner& owner() const { return owner_; }
  bool service_on() const { return !owner_.active().empty(); }
  // What the motion service tells; none while none is on.
  std::optional<robot::MotionState> motion() const {
    return service_on() ? std::optional(owner_.state()) : std::nullopt;
  }
  const CommandGate& gate() const { return gate_; }
  // What became of the commands of a topic; nothing has where the robot has no such topic.
  GateCounts counts(std::size_t topic) const;
  // What the sticks ask for: forward, left m/s, turn rad/s.
  const std::array<double, 3>& stick_wish() const { return stick_wish_; }
  double arm_weight(double t) const { return arms_.weight(t); }

 private:
  robot::Refusal Put(std::size_t topic, const robot::RobotCommand& command, double t);
  const robot::RobotCommand& OfBody(const MotionInput& input, bool service_due, double dt);
  // Puts a command to the body and what hands follow at time t [s] into followed_.
  void Follow(const robot::RobotCommand& body, double t);
  void FollowOwner();  // opens or closes the gate when the owner has changed

  bool fight_;
  Eigen::Vector3d stick_speed_;
  CommandGate gate_;
  CommandGate user_gate_;
  MotorOwner owner_;
  ArmOverlay arms_;
  std::vector<HandGate> hands_;
  std::vector<Intake> intakes_;  // by topic
  ChordReader chords_;
  robot::RobotCommand own_;    // the motion service's last
  robot::RobotCommand mixed_;  // the same with the arms
  robot::RobotCommand followed_;
  bool was_on_ = false;
  bool was_user_ = false;
  bool fresh_lowcmd_ = false;  // one has been taken in this tick
  bool fought_ = false;        // rt/lowcmd spoke after the service
  bool sticks_moved_ = false;
  std::array<double, 3> stick_wish_{};
};

}  // namespace understudy::authority
