// The robot as seen from outside: commands come in, states go out.
#ifndef UNDERSTUDY_WIRE_ROBOT_PORT_H_
#define UNDERSTUDY_WIRE_ROBOT_PORT_H_

#include <cstddef>
#include <cstdint>

#include "robot/port_counts.h"
#include "robot/refusal.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Which messages an instant is to be told in; the robot decides by step count.
struct Due {
  bool lowstate = false;  // rt/lowstate and rt/secondary_imu
  bool motion = false;    // rt/sportmodestate or rt/odommodestate
  bool hands = false;     // states of hands
  bool lf = false;        // the rt/lf/* twins and rt/lf/bmsstate

  bool any() const { return lowstate || motion || hands || lf; }
};

// Two real ports, one per wire family, and a fake one for tests. Polled by the tick; nothing here
// blocks, throws or, after the first few calls, allocates.
class RobotPort {
 public:
  virtual ~RobotPort() = default;

  // Takes one waiting command, oldest first. False when none waits. On true `command` holds it in
  // motor order (its vectors have the robot's size already) and `wire` what is wrong with its form;
  // kNone when nothing is. Fields whose form is wrong hold what could be read, so that a lenient
  // gate can go on with them.
  virtual bool TakeCommand(robot::RobotCommand* command, robot::Refusal* wire) = 0;

  // The same for rt/arm_sdk, with the weight it carries, and for rt/user_lowcmd; both without crc
  // and modes, which the vendor's clients leave 0: motors with them count as enabled. Always false
  // where the robot has no such topic.
  virtual bool TakeArmCommand(robot::RobotCommand* command, double* weight) = 0;
  virtual bool TakeUserCommand(robot::RobotCommand* command) = 0;

  // The same for the hand with that index in RobotSpec::hands. A command with other than one entry
  // per motor is kMotorCount and leaves `command` as it was.
  virtual bool TakeHandCommand(std::size_t hand, robot::HandCommand* command,
                               robot::Refusal* wire) = 0;

  // Sends what is due of `state`. `joint_space` of the state says in which space parallel joints
  // are reported.
  virtual void Publish(const robot::RobotState& state, const Due& due) = 0;

  // How many writers of commands are matched now.
  virtual int command_writers() = 0;

  virtual robot::PortCounts counts() const = 0;
};

}  // namespace understudy::wire

#endif  // UNDERSTUDY_WIRE_ROBOT_PORT_H_
