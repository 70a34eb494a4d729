// The world of a run: everything that happens in a tick happens in World::Tick(), in one direction,
// as plain values.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "emulator/events.h"
#include "emulator/frame.h"
#include "emulator/inbox.h"
#include "emulator/robot.h"
#include "emulator/settings.h"
#include "emulator/status.h"
#include "physics/forces.h"
#include "physics/world.h"
#include "time/clock.h"
#include "time/pace.h"

namespace understudy::emulator {

// Owns the physics, the robots in it and what they share: time, pace, script, pushes and drags.
// Knows no wall clock: who calls Tick decides the pace. The integer step count is the master of
// time. Two worlds with equal settings that get equal commands at equal steps send equal states,
// bit for bit.
class World {
 public:
  // `physics` was made for the robots' specs; `inbox` and the robots' ports must outlive the world.
  World(physics::World physics, const WorldSettings& settings,
        const std::vector<RobotParts>& robots, Inbox* inbox);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Events in order of time, each given to the tick of its time as if it had come by the inbox.
  // Before the first Tick. Throws ConfigError for a body that the model does not have.
  void Play(std::vector<ScriptEvent> script);

  // One physics step; `now` is wall time. After the first few it allocates nothing, unless there is
  // a request or a call. On kDiverged nothing was sent for this step and, with reset_on_divergence,
  // the robots are back in their start poses while time goes on.
  physics::StepHealth Tick(time::Clock::Time now);

  // Answers the people and the calls that wait, but follows no script: between ticks, however far
  // away the next one is. A part of Tick.
  void Attend(time::Clock::Time now);

  // How requests have it that Tick be called. Keeping to it is up to who calls it.
  const time::Pace& pace() const { return pace_; }

  std::int64_t step() const { return step_; }
  double time() const { return static_cast<double>(step_ * step_ns_) * 1e-9; }  // s
  Status status(const LoopReading& loop = {}) const;

  // What happened so far, for readers in any thread. Whoever calls Tick may add what only it knows,
  // such as late ticks.
  EventRing& events() { return events_; }
  const EventRing& events() const { return events_; }

  Robot& robot(std::size_t index = 0) { return robots_[index]; }
  const Robot& robot(std::size_t index = 0) const { return robots_[index]; }
  const physics::World& physics() const { return physics_; }  // changed by the calls above
  // Of the last step.
  std::span<const physics::AppliedForce> pushes() const { return pushes_.forces(); }
  std::span<const physics::AppliedForce> drags() const { return drags_.forces(); }

  // A frame with room for all that Show fills in.
  Frame MakeFrame() const;
  // Fills in those parts that frame->parts names, of the last tick, but for the bytes of
  // wireless_remote. Between ticks; allocates nothing.
  void Show(Frame* frame) const;

 private:
  friend struct RequestActs;  // what each request does

  // Somebody who waits until a step is made.
  struct Stepper {
    std::int64_t step;
    Reply reply;
  };

  void FollowScript(double t);
  void TakeRequests();
  Answer CheckBody(const Request& request) const;
  void AnswerSteppers();
  void Reset(Robot* robot, robot::StartPose pose);
  Answer CarryOut(Request* request, double t);

  // What events have told of so far.
  struct Noted {
    bool paused = false;
    double speed = 1;
  };

  WorldSettings settings_;
  EventRing events_;
  physics::World physics_;
  std::deque<Robot> robots_;
  Inbox* inbox_;
  std::int64_t step_ns_;

  time::Clock::Time now_{};  // wall time of the last call
  std::int64_t step_ = 0;
  std::vector<ScriptEvent> script_;
  std::size_t script_next_ = 0;
  std::size_t script_refused_ = 0;
  time::Pace pace_;
  physics::Pushes pushes_;
  physics::Drags drags_;
  std::vector<Stepper> steppers_;
  std::uint64_t divergences_ = 0;
  Noted noted_;
};

}  // namespace understudy::emulator
