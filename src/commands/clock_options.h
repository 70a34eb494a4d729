// The clock of a robot and its program: options and taking it, of `exec` and `rehearse`.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/network_options.h"
#include "exec/child_process.h"
#include "simclock/coordinator.h"
#include "simclock/own_page.h"
#include "simclock/trace.h"

namespace understudy::commands {

struct ClockArguments {
  std::string clock = "real";  // or "simulated"
  double think = 0;            // ms
  bool measures = false;       // what the program thinks is measured first: --think auto
  bool trace = false;

  bool simulated() const { return clock == "simulated"; }
};

// Adds --clock, --think and --clock-trace. `arguments` must outlive parsing.
void AddClockOptions(CLI::App* app, ClockArguments* arguments);

// Throws CLI::ParseError if they contradict each other or the network. For the callback of the
// command.
void RequireConsistent(const ClockArguments& arguments, const NetworkArguments& network);

// Returns the options as words of a command line, without those that have their default.
std::vector<std::string> WordsOf(const ClockArguments& arguments);

// Returns `think` [ms] as --think auto measured it: the median of the times that the program
// computed from a sleep to its next message, nullopt if it never did that. Says so on standard
// error.
double ThinkOf(std::optional<std::chrono::nanoseconds> computed);

// The `think` of these arguments [ms]. With --think auto it plays this command once before and
// returns what ThinkOf() says of that run, which prints and records nothing.
double ThinkFor(const ClockArguments& arguments);

// Whether this process is that run.
bool Measures();

// Throws CommandError (125) if the program cannot take the clock.
void RequireTakesClock(const std::vector<std::string>& command);

// The simulated clock of a run with a program. Make it before anything else is done: it starts this
// process anew.
class SimulatedClock {
 public:
  // Throws SetupError.
  explicit SimulatedClock(double think_ms);

  // Adds to the environment of the program.
  void AddTo(exec::ChildProcess::Environment* environment) const;

  // Call it before any participant exists. `realtime`: as the configuration has it.
  void Start(bool realtime) { coordinator_.emplace(page_.get(), realtime); }
  // What the program computed, as simclock::MedianComputed has it.
  std::optional<std::chrono::nanoseconds> computed() const {
    return simclock::MedianComputed(*page_.get());
  }
  // Tells it to the process that waits for it, if this one Measures().
  void TellComputed() const;

  // Prints on standard error who waits for what until when. Call it when the program was made.
  void Trace();

  // Throws CommandError (125) if the program did not take the clock. The run has ended.
  void RequireProgram(const std::vector<std::string>& command) const;

  simclock::Coordinator* coordinator() { return &*coordinator_; }

 private:
  simclock::OwnPage page_;
  std::optional<simclock::Coordinator> coordinator_;
  std::optional<simclock::WaitTrace> trace_;
};

}  // namespace understudy::commands
