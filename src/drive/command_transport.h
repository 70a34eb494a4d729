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

namespace understudy::drive {

// The way of each command over the motors' buses. On each bus it takes robot.dynamics.delay, what
// is drawn for it from the bus's own delay, and what a fault of the bus adds; it never overtakes
// the one before. Motors follow the last command that their bus has delivered. What is drawn
// depends on the seed alone. Allocates only in the constructor, and while delays of faults grow
// beyond the longest so far.
class CommandTransport {
 public:
  // `dt` [s] is the time between commands. `start` is what motors follow until the first command
  // has arrived.
  CommandTransport(const robot::RobotSpec& spec, double dt, int seed,
                   const robot::RobotCommand& start);

  // Takes the command of the instant t [s] and returns what the motors follow in it, as followed().
  // `faults` are those of the buses, in the order of robot::BusesOf; none: all are fine.
  const robot::RobotCommand& Pass(const robot::RobotCommand& command, double t,
                                  std::span<const robot::BusEffects> faults = {});

  // Returns what the motors follow; changed by the next call of another function.
  const robot::RobotCommand& followed() const { return followed_; }

  // Drops what is under way: motors follow `start` until the next command has arrived.
  void Restart(const robot::RobotCommand& start);
  // The same, with motors that are not commanded.
  void Clear();

 private:
  struct Way {
    robot::MotorBus bus;
    LateQueue<std::vector<robot::MotorCommand>> under_way;  // to its motors
    std::mt19937_64 random;
  };

  void Carry(Way* way, const robot::RobotCommand& command, double t,
             const robot::BusEffects& fault);

  double delay_;  // s, of every bus
  bool takes_time_;
  bool busy_ = false;  // the last command did not arrive at once on every bus
  std::vector<Way> ways_;
  robot::RobotCommand followed_;
};

}  // namespace understudy::drive
