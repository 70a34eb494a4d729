// Decides which command the motors of a hand follow.
#pragma once

#include <cstdint>
#include <vector>

#include "authority/command_gate.h"
#include "robot/hand_law.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// Takes commands to a hand or refuses them with a reason. Motors are locked (not enabled) before
// the first command. Then each follows its last taken command without limit, unless that command
// has it watched: then it locks after spec.timeout without a taken command, until the next one.
// That a timed-out motor locks rather than goes limp is *assumed*; that a command with the watch
// bit resumes it, too: programs that set the bit in every command calibrate one hand while the
// other waits for longer (NVIDIA's GR00T-WholeBodyControl does), and both work on robots.
//
// Of a hand that follows goals (robot/hand_law.h) q of a command is a goal, and tau, kp and kd are
// ignored: q of each motor goes there evenly, from 0 after a restart, and stays there however long
// no command comes. Where it has registers, goal, speed and force of each motor stay until a
// command has another; speed and force begin at their most (*assumed*).
//
// Motion services do not move hands, so commands are taken at any time.
class HandGate {
 public:
  explicit HandGate(const robot::HandSpec& spec);

  // Takes or refuses a command that arrived at time t [s]. Returns kNone or the reason: kMotorCount
  // for a wrong number of motors, or a harmful value. A refused command changes nothing.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);

  // Returns what the motors follow at time t [s], which must not go back. Valid until the next
  // call.
  const robot::RobotCommand& Current(double t);

  // Returns to the state before the first command.
  void Restart();

  // Whether the program that drives the hand runs at time t [s]; it does at first. While it does
  // not, no command comes. As it starts, motors that it watches lock, and a hand that it sends to
  // q 0 goes there at full speed; others do what they did: their own controllers go on. That a
  // hand outlives its program so is *assumed*.
  void SetRunning(bool runs, double t);

  // Returns how often commands have stopped since construction, counted once for all watched
  // motors.
  std::uint64_t timeouts() const { return timeouts_; }

 private:
  struct Lead {                 // of a motor that follows goals
    robot::MotorCommand start;  // before the first command
    double full_speed = 0;      // rad/s
    double from = 0, goal = 0;  // rad, at taken_at_ and in the end
    double speed = 0;           // rad/s
    double set_speed = 0;       // rad/s, the register
  };
  // Sets those registers of a motor that the command has.
  static void SetRegisters(const robot::MotorCommand& command, Lead* lead,
                           robot::MotorCommand* followed);
  // Sets `current_` to where the goals have led the motors at time t [s].
  void FollowGoals(double t);

  const robot::HandLaw* law_;
  double timeout_;
  std::vector<Lead> leads_;  // empty if it does not follow goals
  robot::RobotCommand current_;
  std::uint64_t timeouts_ = 0;
  double taken_at_ = 0;
  bool runs_ = true;
};

}  // namespace understudy::authority
