// One robot of a world: what it hears, does and tells in a tick.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "authority/command_delay.h"
#include "authority/command_router.h"
#include "emulator/events.h"
#include "emulator/remote.h"
#include "emulator/settings.h"
#include "emulator/status.h"
#include "physics/crane.h"
#include "physics/world.h"
#include "robot/battery.h"
#include "robot/motor.h"
#include "robot/rate.h"
#include "sensors/sensors.h"
#include "services/service_port.h"
#include "time/clock.h"
#include "wire/robot_port.h"

namespace understudy::emulator {

// What one robot of a world is made from.
struct RobotParts {
  robot::RobotSpec spec;  // validated, as the settings are
  RobotSettings settings;
  wire::RobotPort* port;                      // must outlive the robot
  services::ServicePort* services = nullptr;  // likewise; null: nobody calls its services
};

// Owns every part of one robot but its ports and its bodies in the physics. Times are simulated [s]
// and never go back; `step` counts the world's steps. After the first few ticks none of the four
// parts of a tick allocates, unless a service is called.
class Robot {
 public:
  // Puts the robot in its start pose. `index` is its number in the world. `physics` was made for
  // the same spec and must outlive it, and so must `events`, which it tells what happens to it.
  Robot(const RobotParts& parts, std::uint8_t index, physics::World* physics, EventRing* events);
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  // Answers the calls of its services that wait; `now` is wall time. Between ticks too.
  void ServeCalls(time::Clock::Time now);

  // One call of a service from within; as services::ServicePort::Answer.
  std::optional<std::int32_t> Call(std::string_view service, std::int64_t api_id,
                                   std::string_view parameter, time::Clock::Time now);

  // Takes the commands that wait and decides what the motors follow in the step at t.
  void Hear(std::int64_t step, double t);
  // Motors and tether act in the step at t. Between BeginStep and EndStep of the physics.
  void Act();
  // Sends what is due of the step. After EndStep.
  void Tell(std::int64_t step);

  // Back to a pose that it can start in, the gate included; services stay on or off.
  void Reset(robot::StartPose pose);
  robot::StartPose start_pose() const { return start_pose_; }

  // Hangs it from straight above, where it is.
  void AttachCrane();
  physics::Crane& crane() { return crane_; }
  const physics::Crane& crane() const { return crane_; }
  // Between the hooks.
  physics::PointReading hook() const { return physics_->Point(crane_body_, crane_point_); }

  Remote& remote() { return remote_; }

  // Stops or resumes sending; the robot goes on moving.
  void Silence(bool on);

  // Tells of what has changed since it was last called: who moves the motors, what the robot hangs
  // from, the remote controller's keys. After whatever may change them.
  void NoteChanges(double t);

  const robot::RobotSpec& spec() const { return spec_; }
  const authority::MotorOwner& owner() const { return router_.owner(); }
  // At the joints in the last step, in motor order [N·m].
  std::span<const double> torque() const { return motors_.torque(); }
  const robot::RobotCommand& command() const { return *command_; }  // that the motors followed last
  const robot::RobotState& sampled() const { return state_; }       // last; empty before the first
  const std::vector<std::string>& topics() const { return topics_; }

  // Fills in what concerns this robot, at time t.
  void Report(double t, Status* status) const;

 private:
  // How it is in one of its start poses.
  struct Start {
    robot::RobotCommand command;  // to the body
    robot::PoseSpec pose;
    bool on_crane = false;
    bool clamped = false;
  };

  static constexpr std::int64_t kNever = -2;  // before any step's sample
  // What events have told of so far.
  struct Noted {
    authority::GateState gate = authority::GateState::kStart;
    std::string_view service;  // lives as long as the owner's services
    robot::MotionState motion;
    std::uint16_t keys = 0;
    bool on_crane = false;
    bool clamped = false;
    std::array<std::uint64_t, robot::kMostCommandTopics> timeouts{};
  };

  static std::vector<Start> StartsOf(const robot::RobotSpec& spec, double damping_kd);
  const Start& start(robot::StartPose pose) const {
    return starts_[static_cast<std::size_t>(pose)];
  }
  physics::Crane::Hooks hooks() const;
  void TakeCommands(double t);
  const robot::RobotCommand& Decide(std::int64_t step, double t);
  void Sample(std::int64_t step);  // of the instant that the physics shows
  void Note(EventKind kind, const std::array<double, 4>& numbers = {}, std::string_view text = {}) {
    events_->Add(kind, index_, numbers, text);
  }
  void NoteCommand(std::size_t topic, robot::Refusal wire, robot::Refusal refusal,
                   const authority::GateCounts& counts);
  void NoteCall(const services::Call& call);

  robot::RobotSpec spec_;
  std::uint8_t index_;
  std::vector<std::string> topics_;  // that commands come by, by number; "" where there is none
  robot::StartPose start_pose_;
  std::vector<Start> starts_;  // by StartPose
  physics::World* physics_;
  physics::RobotBody* body_;  // of this robot, in it
  EventRing* events_;
  wire::RobotPort* port_;
  services::ServicePort* services_;
  authority::CommandRouter router_;
  authority::CommandDelay delay_;
  robot::MotorBank motors_;
  robot::Battery battery_;
  sensors::Sensors sensors_;
  physics::Crane crane_;
  Remote remote_;
  int crane_body_;
  Eigen::Vector3d crane_point_;
  std::int64_t step_ns_;
  robot::Rate service_rate_;

  const robot::RobotCommand* command_;
  robot::RobotCommand offered_;
  authority::MotionInput input_;
  robot::RobotState state_;
  std::int64_t sampled_ = kNever;  // the step that state_ is of
  bool silenced_ = false;
  Noted noted_;
};

}  // namespace understudy::emulator
