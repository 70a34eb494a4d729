// What is attached to the loop of every run, besides recording and guard.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/spsc_ring.h"
#include "emulator/events.h"
#include "emulator/snapshot_mailbox.h"
#include "emulator/status.h"
#include "run/loop.h"
#include "time/histogram.h"

namespace understudy::run {

class Recording;

// Takes MuJoCo's warning after each tick; another thread logs it, with the notices of Cyclone DDS.
class Notices final : public Attachment {
 public:
  std::optional<ExitCode> After(const Cycle& cycle) override;

  // For one thread; `now` is wall time. Cyclone's first notices are logged at once, then those of
  // 10 s together.
  void Log(time::Clock::Time now);

 private:
  SpscRing<std::string> warnings_{4, std::string(511, ' ')};  // with room for any warning
  std::optional<time::Clock::Time> cyclone_logged_;
};

// Fills in and posts a snapshot of a robot when one is requested.
class Snapshots final : public Attachment {
 public:
  Snapshots(const emulator::World& world, std::size_t robot)
      : mailbox_(world.MakeSnapshot(robot)) {}

  std::optional<ExitCode> After(const Cycle& cycle) override;

  emulator::SnapshotMailbox* mailbox() { return &mailbox_; }

 private:
  emulator::SnapshotMailbox mailbox_;
};

// Posts the status of a robot: after the first step, then every 10 steps, and in each cycle in
// which a client may wait for it: its recording has begun or ended, or no step was made.
class StatusPoster final : public Attachment {
 public:
  // `robot` is its number in the world; `recording` has its turn before, null: none. `board` and
  // `recording` must outlive this.
  StatusPoster(std::size_t robot, emulator::StatusBoard* board, const Recording* recording);

  std::optional<ExitCode> After(const Cycle& cycle) override;

 private:
  std::size_t robot_;
  emulator::StatusBoard* board_;
  const Recording* recording_;
  time::Histogram ticks_;
};

// Calls a function once, after the first step.
class FirstStep final : public Attachment {
 public:
  explicit FirstStep(std::function<void()> call) : call_(std::move(call)) {}

  std::optional<ExitCode> After(const Cycle& cycle) override;

 private:
  std::function<void()> call_;
};

// Ends the run, with a line in the log, when the physics has diverged and robots are not put back.
class DivergenceStop final : public Attachment {
 public:
  std::optional<ExitCode> After(const Cycle& cycle) override;
};

// Ends the run after its duration, or earlier.
class StopRule final : public Attachment {
 public:
  using ShouldStop = std::function<bool(std::int64_t step, emulator::EventRing* events)>;

  // `duration` [simulated s] ends at the first step that is not before it; 0: never. `should_stop`
  // is called after each cycle; it may be empty.
  StopRule(double duration, double timestep, ShouldStop should_stop);

  std::optional<ExitCode> After(const Cycle& cycle) override;

 private:
  std::int64_t last_step_;
  ShouldStop should_stop_;
};

}  // namespace understudy::run
