// Sets up the log of a run.
#pragma once

#include <string>

namespace understudy::commands {

struct LogOptions {
  std::string level = "info";  // debug | info | warn | error
  bool json = false;           // {"time":..., "level":..., "message":...} a line
  bool status_line = false;    // a line is being redrawn on the same terminal
};

// Log lines go to standard error through a queue and a thread of their own, so that a reader of it
// who has stopped reading holds up nobody, neither now nor when the log is stopped: lines are lost
// then, the oldest of the queue first, and counted.
void StartLog(const LogOptions& options);

// Writes what is queued and ends the thread.
void StopLog();

}  // namespace understudy::commands
