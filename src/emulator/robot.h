// One robot of a world: its hardware, its computer and the crane.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "drive/hardware.h"
#include "emulator/computer.h"
#include "emulator/events.h"
#include "emulator/eyes.h"
#include "emulator/robot_events.h"
#include "emulator/settings.h"
#include "emulator/status.h"
#include "perception/ray_caster.h"
#include "physics/crane.h"
#include "physics/mujoco_world.h"
#include "robot/fault_bank.h"
#include "services/service_port.h"
#include "time/clock.h"
#include "wire/robot_port.h"

namespace understudy::emulator {

// The parts from which a robot is made.
struct RobotParts {
  robot::RobotSpec spec;  // validated, as the settings are
  RobotSettings settings;
  Ports ports;  // must outlive the robot
};

// Owns all parts of one robot except its ports and its bodies in the physics. Hardware and Computer
// do not know each other: commands and samples go from one to the other here. Times are simulated
// [s] and never go back; `step` counts the world's steps. After the first few ticks the parts of a
// tick do not allocate, unless a service is called.
class Robot {
 public:
  // Puts the robot in its start pose. `index` is its number in the world. `physics` was made for
  // the same spec, and `rays`, which a robot without a lidar need not have, for the same model;
  // `events` gets the robot's events. They must outlive it. Throws ConfigError for a fault in the
  // settings that the robot cannot have.
  Robot(const RobotParts& parts, std::uint8_t index, physics::MujocoWorld* physics,
        perception::RayCaster* rays, EventRing* events);
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  // As the computer's.
  void ServeCalls(double t, time::Clock::Time now) { computer_.ServeCalls(t, now); }
  std::optional<std::int32_t> Call(std::string_view service, std::int64_t api_id,
                                   std::string_view parameter, time::Clock::Time now) {
    return computer_.Call(service, api_id, parameter, now);
  }
  void KeepNewest() { computer_.KeepNewest(); }

  // Takes the waiting commands and selects what the motors follow in the step at t.
  void Hear(std::int64_t step, double t);
  // Applies the torques of the motors and the pull of the tether. Call it between BeginStep and
  // EndStep of the physics.
  void Act();
  // Publishes the messages that are due in the step. Call it after EndStep.
  void Tell(std::int64_t step);

  // Puts the robot back in a start pose and resets the gate. A robot that is off or boots is then
  // on and booted, unless its battery is empty or its mainboard dead. Services stay on or off.
  void Reset(robot::StartPose pose);
  robot::StartPose start_pose() const { return settings_.start; }

  // Attaches the crane straight above the robot.
  void AttachCrane() { crane_.Attach(hooks(), body_->weight()); }
  physics::Crane& crane() { return crane_; }
  const physics::Crane& crane() const { return crane_; }
  // Holds the base where it is, or releases it.
  void Clamp(bool on) { body_->Clamp(on); }
  // Returns the middle between the hooks.
  physics::PointReading hook() const { return physics_->Point(crane_body_, spec_.crane_point); }

  // Moves a joint to `angle` [rad] until t = `until`, unless a program commands the motors. The
  // base must be clamped; when it is no longer, or a program comes, all joints are released.
  // Allocates only to refuse.
  Result<> MoveJoint(std::string_view joint, double angle, double until);

  robot::Remote& remote() { return computer_.remote(); }

  // The values of settings that can change; FollowSettings applies them to the robot.
  RobotSettings& settings() { return settings_; }
  const RobotSettings& settings() const { return settings_; }
  void FollowSettings();

  // Begins a fault of a component at t, as FaultBank::Begin does, or with the kind "none" takes all
  // of its faults away. Resets keep them. Allocates only to refuse.
  Result<> SetFault(std::string_view component, std::string_view kind, const double* by,
                    const robot::FaultTimes& times, double t);

  // Turns the power switch at t: off, the motors have no torque and nothing is sent, read or
  // answered; on, the robot boots (robot::BootSpec). An empty battery does not switch on.
  Result<> SwitchPower(bool on, double t);

  // Stops or resumes publishing; the robot keeps moving.
  void Silence(bool on) { computer_.Silence(on); }

  // Counts and adds an event for a writer of one of this robot's topics from which nothing arrives,
  // since its type or quality of service is another. `writer` says which and why, for people.
  void NoteUnmatched(std::string_view topic, std::string_view writer) {
    computer_.NoteUnmatched(topic, writer);
  }
  // Adds an event for a topic that a program reads, or writes, and that nobody here serves.
  // `process` is its number, 0 if it is not known.
  void NoteUnserved(std::string_view topic, bool reads, int process) {
    computer_.NoteUnserved(topic, reads, process);
  }

  // Adds events for changes since the last call: who moves the motors, what the robot hangs from,
  // the remote controller's keys. Call it after anything that may change them.
  void NoteChanges(double t);

  const robot::RobotSpec& spec() const { return spec_; }
  const authority::MotorOwner& owner() const { return computer_.owner(); }
  // Returns the joint torques of the last step, in motor order [N·m].
  std::span<const double> torque() const { return hardware_.motors().torque(); }
  // Returns what the motors followed in the last step.
  const robot::RobotCommand& command() const { return hardware_.command(); }
  // Returns the last sample; empty before the first.
  const robot::RobotState& sampled() const { return computer_.sampled(); }
  // Returns the topics of commands, by number; "" where there is none.
  const std::vector<std::string>& topics() const { return computer_.topics(); }
  // Returns how many commands of a topic arrived so far, taken or not.
  std::uint64_t heard(std::size_t topic) const { return computer_.heard(topic); }
  const robot::FaultBank& faults() const { return faults_; }
  const robot::DamageTotals& damage() const { return hardware_.damage(); }

  // Fills in this robot's part of the status at time t. Allocates nothing.
  void Report(double t, Status* status) const;

 private:
  // The state of the robot in a start pose.
  struct Start {
    robot::RobotCommand command;  // to the body
    robot::PoseSpec pose;
    bool on_crane = false;
    bool clamped = false;
  };

  static std::vector<Start> StartsOf(const robot::RobotSpec& spec, double damping_kd);
  const Start& start(robot::StartPose pose) const {
    return starts_[static_cast<std::size_t>(pose)];
  }
  physics::Crane::Hooks hooks() const;
  std::string_view WhyNoJoints() const;
  void Sample(std::int64_t step) {
    hardware_.Sample(computer_.BeginSample(step), computer_.ReadsTouch(step));
  }
  void StepFaults(double t);
  void ApplyFaults(double t);
  void SwitchOff();
  bool SwitchOn(double t);  // false: the battery is empty

  // Each is made of those above it.
  robot::RobotSpec spec_;
  RobotSettings settings_;
  std::vector<Start> starts_;  // by StartPose
  physics::MujocoWorld* physics_;
  physics::RobotBody* body_;                   // of this robot, in physics_
  std::vector<std::array<double, 2>> ranges_;  // rad, of the joints in motor order
  robot::FaultBank faults_;
  RobotEvents events_;
  Computer computer_;
  drive::Hardware hardware_;
  perception::RayCaster* rays_;
  std::optional<Eyes> eyes_;  // where spec_ has a lidar
  physics::Crane crane_;
  int crane_body_;
  std::vector<std::string> hand_names_;  // robot::HandNames
  bool board_is_dead_ = false;
  bool boots_again_ = false;  // once its mainboard works
};

}  // namespace understudy::emulator
