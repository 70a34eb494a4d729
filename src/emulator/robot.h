// One robot of a world: takes commands, moves its motors and publishes its state in each tick.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "authority/command_router.h"
#include "authority/command_transport.h"
#include "base/result.h"
#include "emulator/command_link.h"
#include "emulator/events.h"
#include "emulator/joint_rig.h"
#include "emulator/power.h"
#include "emulator/remote.h"
#include "emulator/robot_events.h"
#include "emulator/settings.h"
#include "emulator/status.h"
#include "physics/crane.h"
#include "physics/world.h"
#include "robot/battery.h"
#include "robot/board.h"
#include "robot/damage.h"
#include "robot/encoders.h"
#include "robot/fault_bank.h"
#include "robot/gears.h"
#include "robot/motor.h"
#include "robot/rate.h"
#include "sensors/sensors.h"
#include "services/service_port.h"
#include "time/clock.h"
#include "wire/robot_port.h"

namespace understudy::emulator {

// Returns the topics of commands to a robot, by number (robot/command_topics.h); "" where it has
// none.
std::vector<std::string> CommandTopics(const robot::RobotSpec& spec);

// The parts from which a robot is made.
struct RobotParts {
  robot::RobotSpec spec;  // validated, as the settings are
  RobotSettings settings;
  wire::RobotPort* port;                      // must outlive the robot
  services::ServicePort* services = nullptr;  // likewise; null: no services
};

// Owns all parts of one robot except its ports and its bodies in the physics. Times are simulated
// [s] and never go back; `step` counts the world's steps. After the first few ticks the parts of a
// tick do not allocate, unless a service is called.
class Robot {
 public:
  // Puts the robot in its start pose. `index` is its number in the world. `physics` was made for
  // the same spec; `events` gets the robot's events. Both must outlive it. Throws ConfigError for a
  // fault in the settings that the robot cannot have.
  Robot(const RobotParts& parts, std::uint8_t index, physics::World* physics, EventRing* events);
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  // Answers waiting service calls; `t` is simulated time, `now` wall time. It may also be called
  // between ticks.
  void ServeCalls(double t, time::Clock::Time now);

  // Carries out a service call of this program, as services::ServicePort::Answer does.
  std::optional<std::int32_t> Call(std::string_view service, std::int64_t api_id,
                                   std::string_view parameter, time::Clock::Time now);

  // Takes the waiting commands and selects what the motors follow in the step at t.
  void Hear(std::int64_t step, double t);
  // Keeps the newest commands; call it now and then while simulated time stands still.
  void Rest();
  // Applies the torques of the motors and the pull of the tether. Call it between BeginStep and
  // EndStep of the physics.
  void Act();
  // Publishes the messages that are due in the step. Call it after EndStep.
  void Tell(std::int64_t step);

  // Puts the robot back in a start pose and resets the gate. Services stay on or off.
  void Reset(robot::StartPose pose);
  robot::StartPose start_pose() const { return start_pose_; }

  // Attaches the crane straight above the robot.
  void AttachCrane();
  physics::Crane& crane() { return crane_; }
  const physics::Crane& crane() const { return crane_; }
  // Holds the base where it is, or releases it.
  void Clamp(bool on) { body_->Clamp(on); }
  // Returns the middle between the hooks.
  physics::PointReading hook() const { return physics_->Point(crane_body_, crane_point_); }

  // Moves a joint to `angle` [rad] until t = `until`, unless a program commands the motors. The
  // base must be clamped; when it is no longer, or a program comes, all joints are released.
  // Allocates only to refuse.
  Result<> MoveJoint(std::string_view joint, double angle, double until, double t);

  Remote& remote() { return remote_; }

  // The values of settings that can change; FollowSettings makes those of the robot hold.
  RobotSettings& settings() { return settings_; }
  const RobotSettings& settings() const { return settings_; }
  void FollowSettings();

  // Begins a fault of a component at t, as FaultBank::Begin does, or with the kind "none" takes all
  // of its faults away. Resets keep them. Allocates only to refuse.
  Result<> SetFault(std::string_view component, std::string_view kind, const double* by,
                    const robot::FaultTimes& times, double t);

  // Turns the power switch at t: off, the motors have no torque and nothing is sent, heard or
  // answered; on, the robot boots (robot::BootSpec). An empty battery does not switch on.
  Result<> SwitchPower(bool on, double t);

  // Stops or resumes publishing; the robot keeps moving.
  void Silence(bool on);

  // Counts and adds an event for a writer of one of this robot's topics from which nothing arrives,
  // since its type or quality of service is another. `writer` says which and why, for people.
  void NoteUnmatched(std::string_view topic, std::string_view writer);

  // Adds events for changes since the last call: who moves the motors, what the robot hangs from,
  // the remote controller's keys. Call it after anything that may change them.
  void NoteChanges(double t);

  const robot::RobotSpec& spec() const { return spec_; }
  const authority::MotorOwner& owner() const { return router_.owner(); }
  // Returns the joint torques of the last step, in motor order [N·m].
  std::span<const double> torque() const { return motors_.torque(); }
  const robot::RobotCommand& command() const {
    return *command_;
  }  // the last that the motors followed
  const robot::RobotState& sampled() const {
    return state_;
  }  // the last sample; empty before the first
  const std::vector<std::string>& topics() const { return topics_; }
  // Returns how many commands of a topic came so far, taken or not.
  std::uint64_t heard(std::size_t topic) const { return links_[topic].heard(); }
  const robot::FaultBank& faults() const { return faults_; }
  const robot::Damage& damage() const { return damage_.damage(); }

  // Fills in this robot's part of the status at time t.
  void Report(double t, Status* status) const;

 private:
  // The state of the robot in a start pose.
  struct Start {
    robot::RobotCommand command;  // to the body
    robot::PoseSpec pose;
    bool on_crane = false;
    bool clamped = false;
  };

  // What follows from a command that has come.
  struct Arrival {
    Robot* to;
    std::size_t topic;
    double t;

    void Offer(const robot::RobotCommand& command, robot::Refusal form) const;
    void Done() const { to->NoteChanges(t); }
  };

  static constexpr std::int64_t kNever = -2;  // before any step's sample
  static std::vector<Start> StartsOf(const robot::RobotSpec& spec, double damping_kd);
  const Start& start(robot::StartPose pose) const {
    return starts_[static_cast<std::size_t>(pose)];
  }
  physics::Crane::Hooks hooks() const;
  void ReadEncoders();
  std::string_view WhyNoJoints() const;
  void StepFaults(double t);
  void FollowBoard(double t);
  void StepPower(double t);
  void SwitchPowerOff();
  void Suffer();
  int TakeLate(int most, double t);
  robot::RemoteReading ReadRemote(double t);
  RobotEvents::Present present(double t) {
    return {.router = router_,
            .power = power_.state(),
            .hears = power_.computes(),
            .keys = ReadRemote(t).keys,
            .on_crane = crane_.attached(),
            .clamped = body_->clamped()};
  }
  void TakeCommands(double t);
  void Ignore();
  bool TakeCommand(std::size_t topic, double t);
  const robot::RobotCommand& Decide(std::int64_t step, double t);
  sensors::Instant instant() const {
    return {*body_, encoders_, motors_, *command_, battery_, board_, faults_.effects()};
  }
  void Sample(std::int64_t step);  // samples the current instant of the physics

  robot::RobotSpec spec_;
  RobotSettings settings_;
  std::vector<std::string> topics_;  // of commands, by number; "" if there is none
  std::string first_service_;        // the alias of the motion service after boot; "" for none
  robot::StartPose start_pose_;
  std::vector<Start> starts_;  // by StartPose
  physics::World* physics_;
  physics::RobotBody* body_;  // of this robot, in physics_
  RobotEvents events_;
  wire::RobotPort* port_;
  services::ServicePort* services_;
  authority::CommandRouter router_;
  std::vector<std::array<double, 2>> ranges_;  // rad, of the joints in motor order
  JointRig rig_;
  authority::CommandTransport transport_;
  robot::FaultBank faults_;
  robot::Encoders encoders_;
  robot::MotorBank motors_;
  robot::Gears gears_;
  robot::Battery battery_;
  robot::Board board_;
  bool board_is_dead_ = false;
  bool boots_again_ = false;  // once its mainboard works
  Power power_;
  std::string_view before_off_;  // the motion service when it was switched off; lives as its owner
  std::vector<robot::ServiceEffects> service_effects_;  // of faults, and of those not up yet
  robot::DamageSheet damage_;
  sensors::Sensors sensors_;
  physics::Crane crane_;
  Remote remote_;
  int crane_body_;
  Eigen::Vector3d crane_point_;
  std::int64_t step_ns_;
  robot::Rate service_rate_;

  const robot::RobotCommand* command_;
  robot::RobotCommand offered_;
  std::vector<CommandLink> links_;  // by topic
  bool any_late_ = false;
  authority::MotionInput input_;
  robot::RobotState state_;
  std::vector<robot::MotorEffects> braked_;  // as the joints are braked now
  std::vector<double> friction_w_;           // W, of the joints
  std::int64_t sampled_ = kNever;            // the step of state_
  bool silenced_ = false;
};

}  // namespace understudy::emulator
