#include "run/loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace understudy::run {
namespace {

using emulator::EventKind;

// The longest that requests and service calls wait while no step is made.
constexpr std::chrono::milliseconds kGlance(2);

}  // namespace

Loop::Loop(time::Clock* clock, emulator::World* world, std::vector<Attachment*> attachments,
           time::ProgramClock* programs)
    : clock_(*clock),
      world_(*world),
      attachments_(std::move(attachments)),
      period_(std::llround(world->physics().timestep() * 1e9)),
      pacer_(clock, period_, world->pace().speed),
      programs_(programs) {}

ExitCode Loop::Run() {
  while (true) {
    const Cycle cycle = Next();
    for (Attachment* attachment : attachments_) {
      if (const auto code = attachment->After(cycle)) return *code;
    }
    // What attachments do at the start makes no step late.
    if (cycle.ticked && world_.step() == 1) pacer_.Resume(1, world_.pace().speed);
  }
}

time::Wait Loop::Wait() {
  if (!std::ranges::all_of(attachments_, &Attachment::AllowsStep)) {
    return pacer_.Hold(world_.step(), kGlance);
  }
  if (programs_ != nullptr && world_.pace().stands_still()) {
    programs_->Stand();
  } else if (programs_ != nullptr && !programs_->Reach(world_.step() * period_, kGlance)) {
    return {};
  }
  return pacer_.WaitFor(world_.pace(), world_.step(), kGlance);
}

Cycle Loop::Next() {
  const time::Wait wait = Wait();
  if (wait.overrun > 0) world_.events().Add(EventKind::kOverrun, 0, {wait.overrun});
  if (wait.shift > 0) world_.events().Add(EventKind::kStall, 0, {wait.shift});
  // Clients of services wait by the programs' clock, and so do the services for them.
  const time::Clock::Time instant = world_.step() * period_;
  Cycle cycle{.world = world_, .pacer = pacer_, .ticked = wait.due};
  if (wait.due) {
    if (programs_ != nullptr) programs_->HoldMessages(true);
    cycle.health = world_.Tick(programs_ != nullptr ? instant : pacer_.reached());
    if (programs_ != nullptr) programs_->HoldMessages(false);
    cycle.took = std::chrono::duration<double>(clock_.Now() - pacer_.reached()).count();
  } else {
    // On a clock of their own the calls of programs wait for the step.
    world_.Attend(programs_ != nullptr ? instant : clock_.Now(), programs_ == nullptr);
  }
  return cycle;
}

}  // namespace understudy::run
