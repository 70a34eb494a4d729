// The computer of a robot: its power sequence, the commands that it reads, its services and
// publications, and who moves the motors.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "authority/command_router.h"
#include "emulator/robot_events.h"
#include "emulator/settings.h"
#include "emulator/status.h"
#include "robot/fault_bank.h"
#include "robot/power.h"
#include "robot/rate.h"
#include "robot/remote.h"
#include "services/service_port.h"
#include "time/clock.h"
#include "wire/robot_port.h"

namespace understudy::emulator {

// The ends of a robot's computer on the network.
struct Ports {
  wire::RobotPort* topics;
  services::ServicePort* services = nullptr;  // null: no services
};

// Depends on no physics: commands to the motors come out, samples of the sensors go in. In a tick
//
//   TakeCommands   power sequence, waiting commands, remote controller
//   Command        what the motors must do; before it a sample, where NeedsSample
//   Publish        messages; before it a sample, where Due
//
// While it is off, nothing is sent, read or answered. What it remembers of commands and samples is
// dropped when it is switched off. Times are simulated [s] and never go back; `step` counts the
// steps of the world. After the first few ticks nothing allocates, unless a service is called.
class Computer {
 public:
  // `start` is the command to the body while no motion service is on and no command was taken;
  // `make` as for MotorOwner; `dt` [s] is the step of the physics. All references must outlive
  // the computer.
  Computer(const robot::RobotSpec& spec, const RobotSettings& settings, const Ports& ports,
           const robot::FaultBank& faults, const robot::RobotCommand& start,
           const authority::MotionMaker& make, double dt, RobotEvents* events);

  // Follows settings that can change.
  void Apply(const RobotSettings& settings) { router_.Apply(settings.gate, settings.motion); }

  // Restarts the motion service or the gate after the robot was put in a start pose, which `start`
  // holds.
  void Restart(const robot::RobotCommand& start);
  // Each does nothing where it is so already. SkipBoot also starts the motion service that was on.
  void SwitchOff();
  void SwitchOn(double t) { power_.SwitchOn(t); }
  void SkipBoot();

  void TakeCommands(double t);
  // Whether the motion service, which gets the sample of the previous step, needs one.
  bool NeedsSample(std::int64_t step) const;
  // Returns the command to all motors in the step at t, valid until the next call or Restart.
  const robot::RobotCommand& Command(std::int64_t step, double t);
  // Whether a message is due in the step.
  bool Due(std::int64_t step) const { return power_.computes() && ports_.topics->Due(step); }
  void Publish(std::int64_t step);
  // Whether a message that is due in the step has what the pads of hands show, and is read.
  bool ReadsTouch(std::int64_t step) const { return !silenced_ && ports_.topics->ReadsTouch(step); }
  // Whether the lidar's programs run, and whether one of them makes a content that is read.
  bool RunsLidar() const;
  bool WantsLidar(wire::Content content) const;
  // Whether the program of obstacle avoidance looks: what the robot is asked to do avoids
  // obstacles, or its firmware publishes their distances while the switch is on.
  bool LooksForObstacles() const;
  // Takes what that program sees.
  void See(const robot::SeenObstacles& seen);
  // Sends a content of the lidar, whose stamps are simulated time.
  void Publish(wire::Content content, robot::LidarReading* reading);
  // Begins the sample of a step: returns the previous one, for the sensors to overwrite.
  robot::RobotState* BeginSample(std::int64_t step);

  // Answers waiting service calls; `now` is wall time. It may also be called between ticks.
  void ServeCalls(double t, time::Clock::Time now);
  // Carries out a service call of this program, as services::ServicePort::Answer.
  std::optional<std::int32_t> Call(std::string_view service, std::int64_t api_id,
                                   std::string_view parameter, time::Clock::Time now);
  // Keeps the newest commands; call it now and then while simulated time stands still.
  void KeepNewest() { ports_.topics->KeepNewest(); }

  // Applies faults and the power sequence to the services. Call it when faults have changed.
  void ApplyFaults();
  // As Robot::Silence, NoteUnmatched and NoteUnserved.
  void Silence(bool on);
  void NoteUnmatched(std::string_view topic, std::string_view writer);
  void NoteUnserved(std::string_view topic, bool reads, int process) {
    events_->Add(EventKind::kUnserved, {reads ? 1.0 : 0.0, static_cast<double>(process)}, topic);
  }

  // Adds the events of the start, and those for changes since the last call.
  void NoteStart() { events_->Begin(present(0)); }
  void NoteChanges(double t) { events_->Compare(present(t)); }

  robot::PowerState power() const { return power_.state(); }
  robot::Remote& remote() { return remote_; }
  const authority::MotorOwner& owner() const { return router_.owner(); }
  const robot::RobotCommand& command() const { return router_.command(); }
  // Whether a program outside of the computer commands the motors.
  bool is_commanded() const;
  const robot::RobotState& sampled() const { return state_; }
  const std::vector<std::string>& topics() const { return topics_; }
  std::uint64_t heard(std::size_t topic) const { return ports_.topics->heard(topic); }

  // Fills in its part of the status at time t.
  void Report(double t, Status* status) const;

 private:
  static constexpr std::int64_t kNever = -2;  // before any step's sample

  double Time(std::int64_t step) const { return static_cast<double>(step * step_ns_) * 1e-9; }
  bool ServiceDue(std::int64_t step) const { return step == 0 || service_rate_.Due(step - 1); }
  RobotEvents::Present present(double t) {
    return {.router = router_,
            .power = power_.state(),
            .hears = power_.computes(),
            .keys = ReadRemote(t).keys};
  }
  robot::RemoteReading ReadRemote(double t);
  std::int64_t since_ns() const { return std::llround(power_.since() * 1e9); }
  void StepPower(double t);
  bool TakeCommand(std::size_t topic, double t);
  void CountLost(std::size_t topic);
  // Brings the effects of faults on links and hands up to this tick. Returns whether there is any.
  bool FollowHandPrograms();
  void Forget();

  const robot::RobotSpec& spec_;
  Ports ports_;
  const robot::FaultBank& faults_;
  RobotEvents* events_;
  std::int64_t step_ns_;
  robot::Rate service_rate_;
  std::vector<std::string> topics_;  // of commands, by number; "" if there is none
  std::string first_service_;        // the alias of the motion service after boot; "" for none
  std::string before_off_;           // the alias of the one that was on when it was switched off
  robot::Power power_;
  robot::Remote remote_;
  authority::CommandRouter router_;
  std::vector<robot::ServiceEffects> service_effects_;  // of faults, and of those not up yet
  std::vector<std::vector<std::size_t>> hand_links_;    // by hand, of its topics
  std::vector<robot::LinkEffects> link_effects_;  // of faults, and of hands' programs that are off
  std::vector<robot::HandEffects> hand_effects_;  // the same
  robot::RobotCommand arrived_;                   // the last command that was taken
  authority::MotionInput input_;
  robot::SeenObstacles seen_;
  bool tells_ranges_;
  robot::RobotState state_;
  std::int64_t sampled_ = kNever;  // the step of state_
  bool silenced_ = false;
};

}  // namespace understudy::emulator
