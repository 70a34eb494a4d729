// The simulated clock of programs beside a robot.
#pragma once

#include <string>

#include "time/clock.h"

namespace understudy::time {

// For the thread of the loop.
class ProgramClock {
 public:
  virtual ~ProgramClock() = default;

  // Called before the first step. Returns one line for the log: how it finds that all programs
  // wait.
  virtual std::string Begin() = 0;

  // Lets the programs go on until their clock is `simulated` [ns since the first step] and all of
  // them wait. Returns false if that takes more than `most` of wall time; call it again then.
  virtual bool Reach(Clock::Time simulated, Clock::Time most) = 0;

  // What this thread sends to the programs waits while `hold`: all that a step says comes at once,
  // when the step is over.
  virtual void HoldMessages(bool hold) = 0;

  // The program has been started: time stands still until it has taken the clock.
  virtual void ProgramStarts() = 0;

  // Its end is known. From the end of its process until this is called, time stands still.
  virtual void ProgramEnded() = 0;

  // From now on, in another thread, the clock goes at the pace of the wall: no step follows. May be
  // called again.
  virtual void End() = 0;

  // Time is paused: threads that are about to ask the robot for something do so now.
  virtual void Stand() = 0;
};

}  // namespace understudy::time
