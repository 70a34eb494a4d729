// Decides which command the motors follow.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "robot/refusal.h"
#include "robot/robot_values.h"

namespace understudy::authority {

struct GateConfig {
  bool lenient = false;   // of every topic's Intake
  double timeout = 0.2;   // s without a taken command until damping; assumed
  double damping_kd = 2;  // N·m·s/rad of that damping; assumed
};

// Who moves the motors now.
enum class GateState : std::uint8_t {
  kStart,      // the start command: nobody has commanded yet
  kFollowing,  // the last taken command
  kDamping,    // commands stopped, or nobody has commanded since the motion service let go
  kLimp,       // the same without torque, on the remote controller's wish
  kClosed,     // the robot's own motion service
};

// The word that the status line and the control plane use.
constexpr std::string_view Name(GateState state) {
  constexpr std::array<std::string_view, 5> kNames = {"start", "following", "damping", "limp",
                                                      "motion_service"};
  return kNames[static_cast<std::size_t>(state)];
}

// Takes commands or refuses them with a reason. There is always a current command, never "none":
// the start command until one is taken, the last one taken while it is fresh, damping after that. A
// refused command changes nothing. Values that would harm (kNotFinite, kGain) are refused.
//
// Closed, it refuses every command, those without a fault as kMotionService.
class CommandGate {
 public:
  // `start` is what the motors do before the first command; its size is the number of motors.
  CommandGate(const GateConfig& config, robot::RobotCommand start);

  // Offers a command that arrived at time t [s]. Returns kNone when taken, else the reason.
  // `command` must hold as many motors as the start command.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);

  // What the motors follow at time t [s], not before the last call's t.
  const robot::RobotCommand& Current(double t);

  // Back to the start command, or to another one, and open.
  void Restart();
  void Restart(const robot::RobotCommand& start);

  // The motion service takes the motors; Current means nothing until it lets go.
  void Close() { state_ = GateState::kClosed; }
  // The motors brake, or with `limp` give no torque, until a command is taken.
  void Rest(bool limp = false) { state_ = limp ? GateState::kLimp : GateState::kDamping; }

  GateState state() const { return state_; }
  // Times that commands stopped, since it was made.
  std::uint64_t timeouts() const { return timeouts_; }

 private:
  GateConfig config_;
  robot::RobotCommand start_;
  robot::RobotCommand taken_;
  robot::RobotCommand damping_;
  robot::RobotCommand limp_;
  GateState state_ = GateState::kStart;
  std::uint64_t timeouts_ = 0;
  double taken_at_ = 0;
};

// The first thing in a command that would harm, whatever its form: kNotFinite, kGain, or kNone.
robot::Refusal HarmIn(const robot::MotorCommand& command);
robot::Refusal HarmIn(const robot::RobotCommand& command);

// A command under which every motor only brakes: kd [N·m·s/rad] on its rate.
robot::RobotCommand DampingCommand(std::size_t motors, double kd);

}  // namespace understudy::authority
