// Plays a scenario and judges it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "exec/child_process.h"
#include "exec/program_output.h"
#include "rehearse/judged.h"
#include "rehearse/scenario.h"
#include "run/run.h"
#include "time/program_clock.h"

namespace understudy::rehearse {

struct RehearsalOptions {
  std::vector<run::Access> access{};  // by number of the robot
  std::filesystem::path recording{};  // is replaced; of several robots as run::RecordingOf has it
  bool late_messages = false;         // as run::RecordingOptions has it
  std::optional<std::uint64_t> start{};  // of the recording, as record::RecordingHead has it
  bool private_network = false;          // nothing leads out of it
  bool to_the_end = false;               // also when an expectation has failed
  std::function<bool()> interrupted{};   // true ends it
  double limit = std::numeric_limits<double>::infinity();  // wall s after which it is ended
  time::ProgramClock* programs = nullptr;                  // null: the program is on real time
  exec::ProgramOutput* output = nullptr;  // of the program; null: nobody asks what it prints
  exec::ProgramOutput* errors = nullptr;  // its standard error, for its last line; may be null
};

struct Rehearsal {
  Judged judged{};
  ExitCode robot = ExitCode::kOk;  // of the run
  std::string stopped{};           // why it ended before its time; else ""
  double wall = 0;                 // s
};

// Plays the scenario, with `program`, which waits to be released, if it has one. It ends with its
// duration, 0.5 s after a program that has no duration has ended, when an expectation has failed,
// when a program has died (by itself, with another code than 0, which no expectation names: that
// fails), when nothing can change a verdict, or at its limit. What is judged is the recording; the
// same judged while it was written decides when to end. Throws SetupError, CommandError if the
// program cannot be run.
Rehearsal Rehearse(const Scenario& scenario, const RehearsalOptions& options,
                   exec::ChildProcess* program);

// Wall s in which a rehearsal has to end unless told otherwise, besides what its duration takes;
// *assumed*, many times what rehearsals take: it is for those whose simulated time stands still.
inline constexpr double kRunLimit = 3600;

// Returns "did not end within 8 s of wall time".
std::string OverlongText(double limit);

// Returns the words as a shell reads them.
std::string ShellText(const std::vector<std::string>& words);

}  // namespace understudy::rehearse
