#include "rehearse/rehearse.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "base/printed.h"

namespace understudy::rehearse {
namespace {

using emulator::EventKind;
using std::chrono::steady_clock;

// All *assumed*.
constexpr std::chrono::milliseconds kGrace(500);  // from SIGTERM to SIGKILL
constexpr double kAftermath = 0.5;                // s that are still played after a failure
constexpr double kAfterProgram = 0.5;             // s that are still played after the program's end
constexpr double kPastLimit = 0.1;                // s, so that its end counts as too late

// Decides in the loop's thread when the program starts and ends, and the rehearsal with it.
class StageManager {
 public:
  StageManager(const Scenario& scenario, const RehearsalOptions& options, const Jury* jury,
               exec::ChildProcess* child, steady_clock::time_point begun)
      : scenario_(scenario),
        options_(options),
        jury_(jury),
        child_(child),
        begun_(begun),
        timestep_(scenario.config.physics.timestep) {}

  bool ShouldStop(std::int64_t step, emulator::EventRing* events) {
    const double t = static_cast<double>(step) * timestep_;
    if (child_ != nullptr) LeadProgram(t, events);
    if (options_.interrupted && options_.interrupted()) {
      interrupted_ = true;
      return Stop("interrupted");
    }
    if (std::chrono::duration<double>(steady_clock::now() - begun_).count() > options_.limit) {
      failure_ = {"the rehearsal", OverlongText(options_.limit)};
      return Stop("");
    }
    if (failure_ && !options_.to_the_end && t >= *ended_ + kAftermath) {
      return Stop("ended as the program had");
    }
    if (child_ != nullptr && scenario_.config.time.duration <= 0 && ended_ &&
        t >= *ended_ + kAfterProgram) {
      return true;
    }
    // As fast as possible it looks where the recorder has caught up: always at the same instants.
    if (scenario_.config.time.speed == 0 && step % run::kHeardEvery != 0) return false;
    if (jury_->failed() && !failed_) failed_ = t;
    if (failed_ && !options_.to_the_end && t >= *failed_ + kAftermath) {
      return Stop("ended as an expectation had failed");
    }
    const bool over = child_ == nullptr || ended_;
    if (!failed_ && over && jury_->decided()) return Stop("ended as all was decided");
    return false;
  }

  const std::string& stopped() const { return stopped_; }
  const std::optional<Failure>& failure() const { return failure_; }
  bool interrupted() const { return interrupted_; }

 private:
  bool Stop(std::string why) {
    stopped_ = std::move(why);
    return true;
  }

  void LeadProgram(double t, emulator::EventRing* events) {
    const Program& program = *scenario_.program;
    if (!started_ && t >= program.at) {
      child_->Release();
      if (options_.programs != nullptr) options_.programs->ProgramStarts();
      events->Add(EventKind::kProgramStart, 0, {}, ShellText(program.command));
      started_ = t;
      ends_at_ = program.until;
      if (!ends_at_ && program.limit) ends_at_ = t + *program.limit + kPastLimit;
    }
    if (!started_ || ended_) return;
    if (options_.output != nullptr) {
      options_.output->TakeFound([events](const std::string& text) {
        events->Add(EventKind::kProgramPrints, 0, {}, text);
      });
    }
    if (ends_at_ && t >= *ends_at_ && !asked_) {
      if (program.kill) {
        child_->Forward(SIGKILL);
      } else {
        child_->Terminate(kGrace);
      }
      asked_ = true;
    }
    if (const std::optional<int> code = child_->Poll()) {
      if (options_.programs != nullptr) options_.programs->ProgramEnded();
      events->Add(EventKind::kProgramEnd, 0, {static_cast<double>(*code)});
      ended_ = t;
      const bool interrupted = options_.interrupted && options_.interrupted();
      if (*code != 0 && !asked_ && !interrupted && !IsExpected()) {
        failure_ = {"the program",
                    Printed("ended with exit code %d after %.3g s", *code, t - *started_)};
      }
    }
  }

  // Whether an expectation says something of the exit code.
  bool IsExpected() const {
    return std::ranges::any_of(scenario_.expect.signals, [](const Signal& signal) {
      return signal.topic == "program_end" && signal.field == "code";
    });
  }

  const Scenario& scenario_;
  const RehearsalOptions& options_;
  const Jury* jury_;
  exec::ChildProcess* child_;
  steady_clock::time_point begun_;
  double timestep_;
  bool asked_ = false;
  std::optional<double> started_;  // s: the program
  std::optional<double> ends_at_;  // s: the program is ended
  std::optional<double> ended_;    // s: the program
  std::optional<double> failed_;   // s: an expectation
  std::string stopped_;
  std::optional<Failure> failure_;  // of the run itself
  bool interrupted_ = false;
};

bool AreSame(const judge::Verdict& a, const judge::Verdict& b) {
  return a.outcome == b.outcome && a.reason == b.reason && a.worth.at == b.worth.at &&
         a.worth.leaf == b.worth.leaf &&
         std::bit_cast<std::uint64_t>(a.worth.margin) ==
             std::bit_cast<std::uint64_t>(b.worth.margin);
}

}  // namespace

Rehearsal Rehearse(const Scenario& scenario, const RehearsalOptions& options,
                   exec::ChildProcess* program) {
  const auto begun = steady_clock::now();
  Jury jury(scenario.expect);
  StageManager manager(scenario, options, &jury, program, begun);
  run::RunOptions run;
  run.access = options.access;
  run.private_network = options.private_network;
  run.programs = options.programs;
  run.script = scenario.script;
  run.recording = {.file = options.recording,
                   .overwrite = true,
                   .start = options.start,
                   .late_messages = options.late_messages};
  for (std::size_t i = 0; i < scenario.config.robots.size(); ++i) {
    run.audiences.push_back(jury.Hearing(i));
    run.obstacles.push_back(signals::AsksForObstacles(scenario.expect.signals, i));
  }
  run.should_stop = [&manager](std::int64_t step, emulator::EventRing* events) {
    return manager.ShouldStop(step, events);
  };
  Rehearsal rehearsal;
  rehearsal.robot = run::RunWorld(scenario.config, run);
  if (program != nullptr && !program->Poll()) {
    program->Terminate(kGrace);
    program->Wait();
  }
  jury.Finish(manager.interrupted());

  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < scenario.config.robots.size(); ++i) {
    files.push_back(run::RecordingOf(options.recording, scenario.config, i));
  }
  rehearsal.judged = JudgeRecordings(OpenRecordings(files), scenario.expect, manager.interrupted());
  if (!rehearsal.judged.cut_short.empty()) {
    throw RecordError(options.recording.string() +
                      ": is no evidence: " + rehearsal.judged.cut_short);
  }
  const std::vector<judge::Verdict> heard = jury.verdicts();
  for (std::size_t i = 0; i < heard.size(); ++i) {
    if (AreSame(heard[i], rehearsal.judged.rulings[i].verdict)) continue;
    throw SetupError("a bug: '" + scenario.expect.list[i].name +
                     "' is judged otherwise from the recording than it was in the run");
  }
  if (std::optional<Failure> failure = manager.failure()) {
    if (options.errors != nullptr && failure->name == "the program") {
      options.errors->Finish();
      const std::string last = Printable(options.errors->last_line());
      if (!last.empty()) failure->why += ": " + last;
    }
    rehearsal.judged.failures.insert(rehearsal.judged.failures.begin(), *failure);
  }
  rehearsal.stopped = manager.stopped();
  rehearsal.wall = std::chrono::duration<double>(steady_clock::now() - begun).count();
  return rehearsal;
}

std::string OverlongText(double limit) {
  return Printed("did not end within %g s of wall time", limit);
}

std::string ShellText(const std::vector<std::string>& words) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

}  // namespace understudy::rehearse
