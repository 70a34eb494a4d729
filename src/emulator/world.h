// The simulated world of a run. World::Tick() makes one step: requests, commands, physics,
// publications.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "emulator/events.h"
#include "emulator/inbox.h"
#include "emulator/recording_desk.h"
#include "emulator/robot.h"
#include "emulator/script.h"
#include "emulator/settings.h"
#include "emulator/snapshot.h"
#include "emulator/status.h"
#include "physics/forces.h"
#include "physics/mujoco_world.h"
#include "time/clock.h"
#include "time/pace.h"

namespace understudy::emulator {

// Owns the physics, the robots, the forces on them and what they share: time, pace, script. It has
// no wall clock: the caller of Tick keeps the pace. The integer step count defines the time. Two
// worlds with equal settings that get equal commands at equal steps publish bit-identical states.
class World {
 public:
  // `physics` was made for the robots' specs; `inbox`, which may have requests to all robots, and
  // the robots' ports must outlive the world.
  World(physics::MujocoWorld physics, const WorldSettings& settings,
        const std::vector<RobotParts>& robots, Inbox* inbox);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Gives its physics away. After that it can only be destroyed.
  physics::MujocoWorld TakePhysics() && { return std::move(physics_); }

  // Plays a script: each event is carried out in the tick of its time, or in the first one from
  // then on in which its condition holds, like a request from the inbox. One that has waited too
  // long is refused. Events that do not come after another are sorted by time. `conditions` has
  // those for which events wait. Call it before the first Tick. Throws ConfigError for a robot or a
  // body that is not in the world.
  void Play(std::vector<ScriptEvent> script,
            std::unique_ptr<ScriptConditions> conditions = nullptr);

  // Takes the requests of a further inbox too, which must outlive the world.
  void Attach(Inbox* inbox) { inboxes_.push_back(inbox); }

  // Makes one physics step; `now` is wall time. After the first few it allocates only for requests
  // and service calls. On kDiverged nothing was published for this step and, with
  // reset_on_divergence, the robots are back in their start poses; time continues.
  physics::StepHealth Tick(time::Clock::Time now);

  // Answers waiting requests and, with `calls`, service calls without making a step or playing the
  // script. Tick does this too; call it between ticks while the next one is far away.
  void Attend(time::Clock::Time now, bool calls = true);

  // The values of settings that can change.
  const WorldSettings& settings() const { return settings_; }

  // Whether the robots are put back after a divergence; else the run is to end.
  bool resets_on_divergence() const { return settings_.reset_on_divergence; }

  // Returns the pace that requests have set. The caller of Tick has to follow it.
  const time::Pace& pace() const { return pace_; }

  // Returns what requests have asked about the recording of a robot. The caller of Tick has to open
  // it, if it can record, and to follow it.
  RecordingDesk& recording(std::size_t robot) { return recordings_[robot]; }

  std::int64_t step() const { return step_; }
  double time() const { return static_cast<double>(step_ * step_ns_) * 1e-9; }  // s
  // As one of the robots has it.
  Status status(std::size_t robot, const LoopReading& loop = {}) const;

  // Returns the events so far, for readers in any thread. The caller of Tick may add its own, such
  // as late ticks.
  EventRing& events() { return events_; }
  const EventRing& events() const { return events_; }

  std::size_t robot_count() const { return robots_.size(); }
  Robot& robot(std::size_t index) { return robots_[index]; }
  const Robot& robot(std::size_t index) const { return robots_[index]; }
  const physics::MujocoWorld& physics() const {
    return physics_;
  }  // changed by the functions above
  // Of the last step, on a robot.
  std::span<const physics::AppliedForce> pushes(std::size_t robot) const {
    return forces_[robot].pushes.forces();
  }
  std::span<const physics::AppliedForce> drags(std::size_t robot) const {
    return forces_[robot].drags.forces();
  }

  // A snapshot as one of the robots has it, with room for all that Show fills in.
  Snapshot MakeSnapshot(std::size_t robot) const;
  // Fills in those parts that snapshot->parts names, of the last tick, but for the bytes of
  // wireless_remote. Between ticks; allocates nothing.
  void Show(Snapshot* snapshot) const;

 private:
  friend struct RequestActs;  // implements the requests

  // A reply to give when a step is done.
  struct Stepper {
    std::int64_t step;
    Reply reply;
  };

  // The next event of a sequence, of which the others are over.
  struct ScriptTurn {
    std::size_t event;
    double since;  // s: when it is due, or begins to wait
  };

  void FollowScript(double t);
  bool FinishEvent(const ScriptTurn& turn, double t);
  void RefuseEvent(const ScriptEvent& event, const std::string& why);
  double Latest(double t) const;
  void TakeRequests();
  std::optional<Answer> TakeRequest(Request* request, Reply* reply);
  std::size_t drag_count() const;
  Answer CheckNames(const Request& request) const;  // robot, body, setting
  Result<double> SettingOf(const Request& request) const;
  double Setting(std::size_t setting, const Robot& robot) const;
  Answer Set(Robot* robot, const Request& request);
  void AnswerSteppers();
  void Reset(std::size_t robot, robot::StartPose pose);
  Answer CarryOut(Request* request, double t);

  // Pushes and drags of the bodies of one robot.
  struct Forces {
    physics::Pushes pushes;
    physics::Drags drags;
  };

  // The values that the last events reported.
  struct Noted {
    bool paused = false;
    double speed = 1;
  };

  WorldSettings settings_;
  EventRing events_;
  physics::MujocoWorld physics_;
  std::optional<perception::RayCaster> rays_;  // where a robot sees
  std::deque<Robot> robots_;
  std::vector<Inbox*> inboxes_;
  std::int64_t step_ns_;

  time::Clock::Time now_{};  // wall time of the last call
  std::int64_t step_ = 0;
  std::vector<ScriptEvent> script_;
  std::unique_ptr<ScriptConditions> conditions_;
  std::vector<ScriptTurn> script_turns_;  // of the sequences that have begun, in their order
  std::size_t script_next_ = 0;           // the sequence that begins next
  std::size_t script_done_ = 0;
  std::size_t script_refused_ = 0;
  time::Pace pace_;
  std::deque<RecordingDesk> recordings_;  // by robot
  std::vector<Forces> forces_;            // by robot
  std::vector<Stepper> steppers_;
  std::uint64_t divergences_ = 0;
  Noted noted_;
};

}  // namespace understudy::emulator
