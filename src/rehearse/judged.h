// The judgement of a recording.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "judge/judge.h"
#include "record/audience.h"
#include "record/plot.h"
#include "record/recording_reader.h"
#include "record/truth.h"
#include "rehearse/expectations.h"
#include "rehearse/world_evidence.h"

namespace understudy::rehearse {

// Judges messages as they come. It hears the robots of a run, and reads their recordings, too.
class Jury {
 public:
  // `expectations` must outlive the jury.
  explicit Jury(const Expectations& expectations);

  // What hears a robot, by its number.
  record::Audience* Hearing(std::size_t robot) { return &hearings_[robot]; }
  // Nothing comes any more; `cut`: though something was to come.
  void Finish(bool cut = false);

  // Whether an expectation has failed; whether nothing that may come changes an outcome. Any
  // thread.
  bool failed() const { return failed_; }
  bool decided() const { return decided_; }

  // After Finish: the verdicts, those that cannot be known replaced by kNotJudged.
  std::vector<judge::Verdict> verdicts() const;
  // Why an expectation cannot be judged from these messages, "" if it can.
  std::string WhyNot(std::size_t expectation) const;
  std::vector<Evidence::Told> events() const { return evidence_.events(); }
  // The last instant.
  judge::Time end() const { return judge_.now().value_or(0); }

 private:
  class OfRobot final : public record::Audience {
   public:
    OfRobot(std::size_t robot, Jury* jury) : robot_(robot), jury_(*jury) {}
    void Begin(std::uint64_t start) override { jury_.evidence_.Begin(robot_, start); }
    void Hear(const record::McapChannel& channel, std::string_view ros_type,
              const record::McapMessage& message) override {
      jury_.evidence_.Take(robot_, channel, ros_type, message);
    }

   private:
    std::size_t robot_;
    Jury& jury_;
  };

  const Expectations& expectations_;
  judge::Judge judge_;
  WorldEvidence evidence_;
  std::deque<OfRobot> hearings_;  // by number of the robot
  std::atomic<bool> failed_{false}, decided_{false};
};

// One expectation and what became of it.
struct Ruling {
  judge::Verdict verdict{};
  std::string why{};  // it is not judged, in words; else ""
};

// A signal of an expectation around the instant that decided.
struct Closeup {
  double from = 0, to = 0;  // s
  record::TracePoints points{};
};

// What failed besides the expectations: "the program", "ended with exit code 2".
struct Failure {
  std::string name{}, why{};
};

struct Judged {
  std::vector<Ruling> rulings{};    // by expectation
  std::vector<Failure> failures{};  // of the run itself
  std::vector<Evidence::Told> events{};
  std::vector<record::TracePoints> whole{};      // by signal: s and value, thinned
  std::vector<std::vector<Closeup>> closeups{};  // by expectation, in the order of its signals
  std::vector<std::optional<record::Damage>> damage{};  // the last damage sheet, by robot
  double end = 0;                                       // s
  record::StringMap about{};  // of the first robot's recording, "" for another's
  std::string cut_short{};    // as McapContents has it

  // Of expectations.
  std::size_t Count(judge::Outcome outcome) const;
  // Of expectations and the run itself.
  std::size_t failed() const { return Count(judge::Outcome::kFailed) + failures.size(); }
};

// Of a world, by number of the robot.
using Recordings = std::vector<std::unique_ptr<record::RecordingReader>>;

// Throw RecordError. `cut`: the run was interrupted, so that what holds to its end is not judged.
Recordings OpenRecordings(const std::vector<std::filesystem::path>& files);
Judged JudgeRecordings(const Recordings& recordings, const Expectations& expectations,
                       bool cut = false);

// Returns the worst outcome of the expectations that name one of several robots, by its number;
// nullopt if none does.
std::optional<judge::Outcome> OutcomeOf(std::size_t robot, const Expectations& expectations,
                                        const Judged& judged);

// Returns what is beyond its limit: "shock 43.5 m/s² (39.2 m/s²), falls 1 (0)"; "" if nothing is.
std::string BeyondText(const record::Damage& damage);

// Returns seconds.
inline double SecondsOf(judge::Time time) { return 1e-9 * static_cast<double>(time); }

// Returns what decided, for people: "base.height was 0.213 m at 3.410 s, 0.087 m short".
std::string Explain(const Expectation& expectation, const Ruling& ruling);

// Returns the margin with its unit, "" if there is none.
std::string MarginText(const Expectation& expectation, const judge::Verdict& verdict);

// Returns a number with four digits, or fewer where they are 0.
std::string NumberText(double number);

}  // namespace understudy::rehearse
