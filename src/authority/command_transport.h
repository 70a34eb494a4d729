// Carries commands from the robot's computer to its motors.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "base/late_queue.h"
#include "robot/buses.h"
#include "robot/fault.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::authority {

// The way of each command over the motors' buses. On each it takes robot.dynamics.delay, what is
// drawn for it from the bus's own delay, and what a fault of the bus adds; it never overtakes the
// one before. What is drawn depends on the seed alone. Where nothing takes time a command passes as
// it is. Allocates only in the constructor, and while delays of faults grow beyond what they were.
class CommandTransport {
 public:
  // `dt` [s] is the time between commands. `start` is what motors follow until the first command
  // has come to them.
  CommandTransport(const robot::RobotSpec& spec, double dt, int seed,
                   const robot::RobotCommand& start);

  // Takes the command of the instant t [s] and returns what the motors follow in it, valid until
  // the next call. `faults` are those of the buses, in the order of robot::BusesOf; none: all are
  // fine.
  const robot::RobotCommand& Pass(const robot::RobotCommand& command, double t,
                                  std::span<const robot::BusEffects> faults = {});

  // Forgets what is under way: motors follow `start` until the next command has come.
  void Restart(const robot::RobotCommand& start);

 private:
  struct Way {
    robot::MotorBus bus;
    LateQueue<robot::RobotCommand> under_way;  // the commands of its motors
    std::mt19937_64 random;
  };

  void Carry(Way* way, const robot::RobotCommand& command, double t,
             const robot::BusEffects& fault);

  double delay_;  // s, of every bus
  bool takes_time_;
  bool busy_ = false;  // the last command did not pass as it is
  std::vector<Way> ways_;
  robot::RobotCommand out_;
};

}  // namespace understudy::authority
