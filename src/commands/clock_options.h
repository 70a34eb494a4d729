// The clock of a robot and its program: options and taking it, of `exec` and `rehearse`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/network_options.h"
#include "exec/child_process.h"
#include "simclock/coordinator.h"
#include "simclock/own_page.h"

namespace understudy::commands {

struct ClockArguments {
  std::string clock = "real";  // or "simulated"
  double think = 0;            // ms

  bool simulated() const { return clock == "simulated"; }
};

// Adds --clock and --think. `arguments` must outlive parsing.
void AddClockOptions(CLI::App* app, ClockArguments* arguments);

// Throws CLI::ParseError if they contradict each other or the network. For the callback of the
// command.
void RequireConsistent(const ClockArguments& arguments, const NetworkArguments& network);

// Returns the options as words of a command line, without those that have their default.
std::vector<std::string> WordsOf(const ClockArguments& arguments);

// The simulated clock of a run with a program. Make it before anything else is done: it starts this
// process anew.
class SimulatedClock {
 public:
  // Throws CommandError (125) if `command` cannot take the clock, SetupError.
  SimulatedClock(const std::vector<std::string>& command, double think_ms);

  // Adds to the environment of the program.
  void AddTo(exec::ChildProcess::Environment* environment) const;

  // Call it before any participant exists. `realtime`: as the configuration has it.
  void Start(bool realtime) { coordinator_.emplace(page_.get(), realtime); }
  // Throws CommandError (125) if the program did not take the clock. The run has ended.
  void RequireProgram(const std::vector<std::string>& command) const;

  simclock::Coordinator* coordinator() { return &*coordinator_; }

 private:
  simclock::OwnPage page_;
  std::optional<simclock::Coordinator> coordinator_;
};

}  // namespace understudy::commands
