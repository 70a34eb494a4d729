// The loop around the tick, and the interface of what is attached to it.
#pragma once

#include <optional>
#include <vector>

#include "base/exit_code.h"
#include "emulator/world.h"
#include "time/clock.h"
#include "time/pacer.h"
#include "time/program_clock.h"

namespace understudy::run {

// One round of the loop: a tick or, where no step is due, an answer to waiting requests and calls.
struct Cycle {
  emulator::World& world;
  const time::Pacer& pacer;
  bool ticked = false;  // a step was made
  physics::StepHealth health = physics::StepHealth::kFine;
  double took = 0;  // s of wall time, of the tick

  // Whether the physics diverged and the run has to end.
  bool diverged() const {
    return health == physics::StepHealth::kDiverged && !world.resets_on_divergence();
  }
};

// Looks after each cycle in the loop's thread: what observes, records or ends a run.
class Attachment {
 public:
  virtual ~Attachment() = default;

  // Whether the next step may be made. While one attachment says no, simulated time stands still
  // and requests and service calls are answered. Asked before each cycle.
  virtual bool AllowsStep() const { return true; }

  // Called after each cycle; must not wait, except after the first step. An exit code ends the run,
  // and later attachments do not see that cycle.
  virtual std::optional<ExitCode> After(const Cycle& cycle) = 0;
};

// Makes the steps of a world at the pace that requests have set.
class Loop {
 public:
  // All must outlive the loop. Attachments are called in their order. Deadlines count from
  // construction. Before each step `programs` goes on to its instant; null: programs are on real
  // time.
  Loop(time::Clock* clock, emulator::World* world, std::vector<Attachment*> attachments,
       time::ProgramClock* programs = nullptr);

  // Runs until an attachment ends the run and returns its exit code.
  ExitCode Run();

 private:
  Cycle Next();
  time::Wait Wait();

  time::Clock& clock_;
  emulator::World& world_;
  std::vector<Attachment*> attachments_;
  time::Clock::Time period_;  // of a step
  time::Pacer pacer_;
  time::ProgramClock* programs_;
};

}  // namespace understudy::run
