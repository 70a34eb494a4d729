// The hardware of a robot: what a command does to the physics, and what the sensors read of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "drive/command_transport.h"
#include "drive/gears.h"
#include "drive/joint_rig.h"
#include "drive/stiction.h"
#include "physics/robot_body.h"
#include "robot/battery.h"
#include "robot/board.h"
#include "robot/damage.h"
#include "robot/fault_bank.h"
#include "robot/motor.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"
#include "sensors/encoders.h"
#include "sensors/sensors.h"

namespace understudy::drive {

// Buses, encoders, motors, gears, battery, mainboard, brakes and sensors of one robot. Depends on
// no message, service or clock: commands go in, samples come out. In each step of the physics
//
//   Send(command)   before BeginStep: the motors follow what their buses have delivered
//   Act()           between BeginStep and EndStep: drives the joints
//   Sense()         after EndStep: sensors and damage; then Sample, where a sample is needed
//
// While it is off, motors have no torque and commands have no effect. What it remembers of commands
// and readings is dropped when it is switched off and again when it is switched on. Times are
// simulated [s] and never go back. Allocates only in the constructor and in the first Sample into a
// state.
class Hardware {
 public:
  // `start` is what the motors follow until the first command has arrived, `dt` [s] the step of the
  // physics. The others must outlive it; `body` was made for the same spec.
  Hardware(const robot::RobotSpec& spec, const sensors::SensorConfig& sensors,
           const robot::FaultBank& faults, const robot::RobotCommand& start,
           physics::RobotBody* body, double dt);

  // Goes on with other errors of sensors, as Sensors::Apply.
  void Apply(const sensors::SensorConfig& config) { sensors_.Apply(config); }

  // Puts the robot at rest in a pose, held by `start` until the next command has arrived.
  void Restart(const robot::RobotCommand& start, const robot::PoseSpec& pose);
  void SwitchOff();
  // Switches a pack on that has cut off. Returns false if it is empty: then all stays off.
  bool SwitchOn();

  void Send(const robot::RobotCommand& command, double t);
  void Act();
  void Sense();
  // Fills `state`, which has the sample before, but for tick_ms, remote and motion. The cells of
  // its hands' pads are filled if it `feels`.
  void Sample(robot::RobotState* state, bool feels) {
    sensors::Instant now = instant();
    now.feels = feels;
    sensors_.Sample(now, state);
  }

  // Moves the joint of a motor of the body to `angle` [rad] until t = `until`, against its
  // commands.
  void MoveJoint(std::size_t motor, double angle, double until) {
    rig_.Move(motor, angle, body_->q()[motor], until);
  }
  void ReleaseJoints() { rig_.Release(); }

  // Returns what the motors followed in the last step.
  const robot::RobotCommand& command() const { return transport_.followed(); }
  const robot::MotorBank& motors() const { return motors_; }
  const robot::Battery& battery() const { return battery_; }
  const robot::DamageTotals& damage() const { return damage_.damage(); }

 private:
  // The friction that a joint was given last.
  struct JointBrake {
    double drag = 0;  // N·m
    physics::RobotBody::Grip grip = physics::RobotBody::Grip::kYields;

    friend bool operator==(const JointBrake&, const JointBrake&) = default;
  };

  // Drops what it remembers of commands and readings.
  void Forget();
  void ReadEncoders();
  // Applies what has changed of the friction of the joints, by faults or as they come to rest.
  void BrakeJoints();
  void BrakeJoint(std::size_t motor, bool sticks);
  sensors::Instant instant() const {
    return {*body_, encoders_, motors_, transport_.followed(), battery_, board_, faults_.effects()};
  }

  const robot::FaultBank& faults_;
  physics::RobotBody* body_;
  double dt_;
  bool on_ = true;
  JointRig rig_;
  CommandTransport transport_;
  sensors::Encoders encoders_;
  robot::MotorBank motors_;
  Gears gears_;
  robot::Battery battery_;
  robot::Board board_;
  sensors::Sensors sensors_;
  robot::DamageSheet damage_;
  Stiction stiction_;
  std::vector<JointBrake> braked_;  // in motor order
  std::vector<double> friction_w_;  // W, of the joints
};

}  // namespace understudy::drive
