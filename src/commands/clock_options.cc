#include "commands/clock_options.h"

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "base/printed.h"
#include "exec/command.h"
#include "simclock/program_check.h"

namespace understudy::commands {
namespace {

constexpr double kMostThink = 1000;  // ms, *assumed*

std::chrono::nanoseconds Checked(const std::vector<std::string>& command, double think_ms) {
  const char* const path = std::getenv("PATH");
  const std::string search = path == nullptr ? "/bin:/usr/bin" : path;
  const std::string program = exec::FindProgram(command.at(0), search);
  if (const std::string why = simclock::WhyNoClock(program, search); !why.empty()) {
    throw exec::CommandError("--clock simulated: " + why, exec::kExitOwnFailure);
  }
  return std::chrono::nanoseconds(std::llround(think_ms * 1e6));
}

}  // namespace

void AddClockOptions(CLI::App* app, ClockArguments* arguments) {
  app->add_option("--clock", arguments->clock,
                  "real: the computer's clock; simulated: robot and program share a clock that "
                  "waits for the program, as fast as possible without --speed [real]")
      ->check(CLI::IsMember({"real", "simulated"}))
      ->type_name("CLOCK");
  app->add_option(
         "--think", arguments->think,
         "Simulated ms that the program takes from the end of a sleep to its next message, "
         "with --clock simulated [0]")
      ->check(CLI::Range(0.0, kMostThink))
      ->type_name("MS");
}

void RequireConsistent(const ClockArguments& arguments, const NetworkArguments& network) {
  if (!arguments.simulated()) {
    if (arguments.think > 0) {
      throw CLI::ValidationError("--think", "needs --clock simulated");
    }
    return;
  }
  if (network.network == "private") return;
  throw CLI::ValidationError("--clock",
                             "simulated needs --network private: others on the network would be on "
                             "real time");
}

std::vector<std::string> WordsOf(const ClockArguments& arguments) {
  std::vector<std::string> words;
  if (arguments.simulated()) words = {"--clock", arguments.clock};
  if (arguments.think > 0) words.insert(words.end(), {"--think", Printed("%.6g", arguments.think)});
  return words;
}

SimulatedClock::SimulatedClock(const std::vector<std::string>& command, double think_ms)
    : page_(Checked(command, think_ms)) {}

void SimulatedClock::AddTo(exec::ChildProcess::Environment* environment) const {
  environment->insert(environment->end(), page_.environment().begin(), page_.environment().end());
}

void SimulatedClock::RequireProgram(const std::vector<std::string>& command) const {
  if (!coordinator_->program_is_missing()) return;
  throw exec::CommandError(command[0] + " did not take the simulated clock", exec::kExitOwnFailure);
}

}  // namespace understudy::commands
