// Sets up the log of a run.
#pragma once

#include <string>

namespace understudy::commands {

struct LogOptions {
  std::string level = "info";  // debug | info | warn | error
  bool json = false;           // {"time":..., "level":..., "message":...} a line
  bool status_line = false;    // a line is being redrawn on the same terminal
};

// Log lines go to standard error through a queue and a thread of their own, so a stuck
// terminal blocks no caller: when the queue is full the oldest lines are lost.
void StartLog(const LogOptions& options);

// Writes what is queued and ends the thread.
void StopLog();

}  // namespace understudy::commands
