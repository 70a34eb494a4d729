// Decides which rt/lowcmd command the motors follow.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "robot/refusal.h"
#include "robot/robot_values.h"

namespace understudy::authority {

struct GateConfig {
  bool lenient = false;   // mode of the Intake of every topic
  double timeout = 0.2;   // s without a taken command until damping; assumed
  double damping_kd = 2;  // N·m·s/rad of that damping; assumed
};

// What the motors follow.
enum class GateState : std::uint8_t {
  kStart,      // the start command: nobody has commanded yet
  kFollowing,  // the last taken command
  kDamping,    // damping: commands stopped, or none came since the motion service's release
  kLimp,       // no torque, requested by the remote controller
  kClosed,     // the motion service
};

// Returns the state's word in the status line and the control plane.
constexpr std::string_view Name(GateState state) {
  constexpr std::array<std::string_view, 5> kNames = {"start", "following", "damping", "limp",
                                                      "motion_service"};
  return kNames[static_cast<std::size_t>(state)];
}

// Takes commands or refuses them with a reason. There is always a current command: the start
// command until one is taken, then the last taken one, and damping after the timeout. A refused
// command changes nothing. Another number of motors (kMotorCount) and harmful values (kNotFinite,
// kGain) are refused.
//
// While closed it refuses every command; valid ones with kMotionService.
class CommandGate {
 public:
  // `start` is the command before the first taken one; its size is the number of motors.
  CommandGate(const GateConfig& config, robot::RobotCommand start);

  // Takes or refuses a command that arrived at time t [s]. Returns kNone or the reason.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);

  // Returns the command that the motors follow at time t [s], which must not go back.
  const robot::RobotCommand& Current(double t);

  // Opens with the start command, or with another one.
  void Restart();
  void Restart(const robot::RobotCommand& start);

  // The motion service takes the motors. Current is meaningless until OpenPassive or Restart.
  void Close() { state_ = GateState::kClosed; }
  // Opens; the motors damp, or with `limp` have no torque, until a command is taken.
  void OpenPassive(bool limp = false) { state_ = limp ? GateState::kLimp : GateState::kDamping; }

  // Has commands stop after `timeout` [s] from now on.
  void SetTimeout(double timeout) { config_.timeout = timeout; }

  GateState state() const { return state_; }
  // Returns how often commands have stopped since construction.
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

// Returns the first harmful value in a command: kNotFinite, kGain, or kNone.
robot::Refusal HarmIn(const robot::MotorCommand& command);
robot::Refusal HarmIn(const robot::RobotCommand& command);

// Returns a command that damps every motor with kd [N·m·s/rad].
robot::RobotCommand DampingCommand(std::size_t motors, double kd);

}  // namespace understudy::authority
