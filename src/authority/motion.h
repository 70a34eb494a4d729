// The robot's own motion service, as the tick sees it: goals go in, a command comes out.
#pragma once

#include <cstdint>
#include <span>

#include "authority/goals.h"
#include "robot/robot_values.h"

namespace understudy::authority {

// What became of a goal. Services turn it into the code their robot would send.
enum class MotionVerdict : std::uint8_t {
  kTaken,    // under way; not a promise that it ends well
  kNotNow,   // not from the present state
  kUnknown,  // no such id
  kUnable,   // the real robot could, no controller here can
};

// What a robot's own controller knows: one instant of its sensors, as they read.
struct MotionInput {
  double time = 0;                              // simulated s
  std::span<const robot::MotorReading> motors;  // motor order
  robot::ImuReading imu;                        // LowState's unit
  std::span<const double> foot_force;           // N, RobotSpec::feet order
};

class Motion {
 public:
  virtual ~Motion() = default;

  // As after boot: no goal, the state a robot of this kind comes up in. Called before the first
  // Step and whenever the service takes the motors over.
  virtual void Start(const MotionInput& input) = 0;

  // Begins `goal` or says why not; never acts itself.
  virtual MotionVerdict Ask(const MotionGoal& goal) = 0;

  // Every dt seconds: what the motors are to do until the next call. `command` has the robot's
  // size. Allocates nothing.
  virtual void Step(const MotionInput& input, double dt, robot::RobotCommand* command) = 0;

  virtual robot::MotionState state() const = 0;
};

}  // namespace understudy::authority
