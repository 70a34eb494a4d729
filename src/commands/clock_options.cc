#include "commands/clock_options.h"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/printed.h"
#include "base/unique_fd.h"
#include "exec/command.h"
#include "simclock/program_check.h"

namespace understudy::commands {
namespace {

constexpr double kMostThink = 1000;  // ms, *assumed*

// Has the number of the descriptor to which the run of MeasureCommand() writes its ns.
constexpr char kMeasureVariable[] = "UNDERSTUDY_MEASURES_THINK";

// "auto", or a number of ms.
std::string CheckThink(const std::string& text) {
  double ms = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, ms);
  if (text == "auto" || (error == std::errc{} && rest == end && ms >= 0 && ms <= kMostThink)) {
    return "";
  }
  return Printed("expected auto, or ms from 0 to %g", kMostThink);
}

}  // namespace

void RequireTakesClock(const std::vector<std::string>& command) {
  const char* const path = std::getenv("PATH");
  const std::string search = path == nullptr ? "/bin:/usr/bin" : path;
  const std::string program = exec::FindProgram(command.at(0), search);
  if (const std::string why = simclock::WhyNoClock(program, search); !why.empty()) {
    throw exec::CommandError("--clock simulated: " + why, exec::kExitOwnFailure);
  }
}

void AddClockOptions(CLI::App* app, ClockArguments* arguments) {
  app->add_option("--clock", arguments->clock,
                  "real: the computer's clock; simulated: robot and program share a clock that "
                  "waits for the program, as fast as possible without --speed [real]")
      ->check(CLI::IsMember({"real", "simulated"}))
      ->type_name("CLOCK");
  app->add_option_function<std::string>(
         "--think",
         [arguments](const std::string& text) {
           arguments->measures = text == "auto";
           arguments->think = arguments->measures ? 0 : std::stod(text);
         },
         "Simulated ms that the program takes from the end of a sleep to its next message, "
         "with --clock simulated; auto runs it once before and takes what it computes on this "
         "computer [0]")
      ->check(CLI::Validator(&CheckThink, "", "think"))
      ->type_name("MS");
  app->add_flag("--clock-trace", arguments->trace,
                "Print every second on standard error which thread waits for what until when, with "
                "--clock simulated");
}

void RequireConsistent(const ClockArguments& arguments, const NetworkArguments& network) {
  if (!arguments.simulated()) {
    if (arguments.think > 0 || arguments.measures) {
      throw CLI::ValidationError("--think", "needs --clock simulated");
    }
    if (arguments.trace) {
      throw CLI::ValidationError("--clock-trace", "needs --clock simulated");
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

double ThinkOf(std::optional<std::chrono::nanoseconds> computed) {
  if (!computed) {
    std::fputs("think: 0 ms: the program never slept and then sent a message\n", stderr);
    return 0;
  }
  const double ms = std::stod(Printed("%.3g", 1e-6 * static_cast<double>(computed->count())));
  std::fprintf(stderr, "think: %g ms, measured on this computer\n", ms);
  return ms;
}

namespace {

// Runs this command once, without its output, and returns what ThinkOf() says of it.
double MeasureCommand() {
  const UniqueFd answer(::memfd_create("understudy-think", 0));
  const UniqueFd nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  std::vector<std::string> words = simclock::OwnWords();
  words[0] = "/proc/self/exe";
  exec::ChildProcess run(words, {{kMeasureVariable, std::to_string(answer.get())}}, nowhere.get(),
                         nowhere.get());
  run.Release();
  run.Wait();
  std::int64_t ns = 0;
  const bool told = ::pread(answer.get(), &ns, sizeof(ns), 0) == sizeof(ns);
  return ThinkOf(told ? std::optional(std::chrono::nanoseconds(ns)) : std::nullopt);
}

}  // namespace

bool Measures() { return std::getenv(kMeasureVariable) != nullptr; }

double ThinkFor(const ClockArguments& arguments) {
  if (!arguments.measures) return arguments.think;
  if (const auto found = simclock::ThinkOfStart())
    return 1e-6 * static_cast<double>(found->count());
  return Measures() ? 0 : MeasureCommand();
}

SimulatedClock::SimulatedClock(double think_ms)
    : page_(std::chrono::nanoseconds(std::llround(think_ms * 1e6))) {}

void SimulatedClock::TellComputed() const {
  const char* const file = std::getenv(kMeasureVariable);
  const auto time = computed();
  if (file == nullptr || !time) return;
  const int pipe = static_cast<int>(std::strtol(file, nullptr, 10));
  const std::int64_t ns = time->count();
  if (::write(pipe, &ns, sizeof(ns)) != sizeof(ns)) std::perror("think");
}

void SimulatedClock::AddTo(exec::ChildProcess::Environment* environment) const {
  environment->insert(environment->end(), page_.environment().begin(), page_.environment().end());
}

void SimulatedClock::Trace() {
  trace_.emplace(page_.get(), [](const std::string& lines) { std::fputs(lines.c_str(), stderr); });
}

void SimulatedClock::RequireProgram(const std::vector<std::string>& command) const {
  if (!coordinator_->program_is_missing()) return;
  throw exec::CommandError(command[0] + " did not take the simulated clock", exec::kExitOwnFailure);
}

}  // namespace understudy::commands
