// Starts and stops the log of a run.
#pragma once

#include <string>

namespace understudy::commands {

struct LogOptions {
  std::string level = "info";  // debug | info | warn | error
  bool json = false;           // lines of {"time":..., "level":..., "message":...}
  bool status_line = false;    // a status line is redrawn on the same terminal
};

// Log lines go to standard error through a queue and a thread, so that neither logging nor StopLog
// waits for a reader that has stopped reading. Lines are then lost, the oldest of the queue first,
// and counted.
void StartLog(const LogOptions& options);

// Writes the queued lines and ends the thread.
void StopLog();

}  // namespace understudy::commands
