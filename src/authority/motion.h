// The interface of a motion service: it takes goals and computes commands.
#pragma once

#include <cstdint>
#include <span>

#include "authority/goals.h"
#include "robot/robot_values.h"
#include "robot/seen_obstacles.h"

namespace understudy::authority {

// The result of a goal, from good to bad. Services answer with the robot's code for it.
enum class MotionVerdict : std::uint8_t {
  kTaken,    // started; it may still fail
  kIgnored,  // answered as taken and without effect, as on the real robot
  kNotNow,   // not possible in the present state
  kUnknown,  // no such id
  kUnable,   // not simulated, though the real robot has it
};

// The input of a motion service: the sensor readings of one instant.
struct MotionInput {
  double time = 0;                                  // simulated s
  std::span<const robot::MotorReading> motors;      // motor order
  robot::ImuReading imu;                            // of LowState
  std::span<const double> foot_force;               // N, RobotSpec::feet order
  double soc = 1;                                   // of the battery, 0 to 1
  double arm_weight = 0;                            // of rt/arm_sdk, 0 to 1
  robot::RemoteReading remote{};                    // as last received
  const robot::SeenObstacles* obstacles = nullptr;  // null: the robot has no eyes for them
};

class Motion {
 public:
  virtual ~Motion() = default;

  // Starts as after boot: without a goal, in the first state of this kind of robot. Called before
  // the first Step and whenever the service takes over the motors.
  virtual void Start(const MotionInput& input) = 0;

  // Takes or refuses a goal; it takes effect in the next Step. Damp is taken in every state. The
  // protection (motion/protection.h) also asks for StandDown, StopMove, and Fall where the robot
  // has fallen over; of a service that is unable to Fall it asks Damp.
  virtual MotionVerdict Ask(const MotionGoal& goal) = 0;

  // Called every dt seconds: computes the command to the motors until the next call. `command` has
  // the size of the body. Allocates nothing.
  virtual void Step(const MotionInput& input, double dt, robot::RobotCommand* command) = 0;

  virtual robot::MotionState state() const = 0;
};

}  // namespace understudy::authority
