// The judgement of a recording.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "judge/judge.h"
#include "record/audience.h"
#include "record/plot.h"
#include "record/recording_reader.h"
#include "record/truth.h"
#include "rehearse/evidence.h"
#include "rehearse/expectations.h"

namespace understudy::rehearse {

// Judges messages as they come. It is the audience of a run, and reads a recording likewise.
class Jury final : public record::Audience {
 public:
  // `expectations` must outlive the jury.
  explicit Jury(const Expectations& expectations);

  void Begin(std::uint64_t start) override;
  void Hear(const record::McapChannel& channel, std::string_view ros_type,
            const record::McapMessage& message) override;
  // Nothing comes any more.
  void Finish();

  // Whether an expectation has failed; whether nothing that may come changes an outcome. Any
  // thread.
  bool failed() const { return failed_; }
  bool decided() const { return decided_; }

  // After Finish: the verdicts, those that cannot be known replaced by kNotJudged.
  std::vector<judge::Verdict> verdicts() const;
  // Why an expectation cannot be judged from these messages, "" if it can.
  std::string WhyNot(std::size_t expectation) const;
  const Evidence& evidence() const { return *evidence_; }
  // The last instant.
  judge::Time end() const { return judge_.now().value_or(0); }

 private:
  const Expectations& expectations_;
  judge::Judge judge_;
  std::unique_ptr<Evidence> evidence_;  // from Begin on
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

struct Judged {
  std::vector<Ruling> rulings{};  // by expectation
  std::vector<Evidence::Told> events{};
  std::vector<record::TracePoints> whole{};      // by signal: s and value, thinned
  std::vector<std::vector<Closeup>> closeups{};  // by expectation, in the order of its signals
  std::optional<record::Damage> damage{};        // the last damage sheet
  double end = 0;                                // s
  record::StringMap about{};                     // of the recording, "" for another's
  std::string cut_short{};                       // as McapContents has it

  std::size_t Count(judge::Outcome outcome) const;
};

// Throws RecordError.
Judged JudgeRecording(const record::RecordingReader& reader, const Expectations& expectations);

// Returns seconds.
inline double SecondsOf(judge::Time time) { return 1e-9 * static_cast<double>(time); }

// Returns what decided, for people: "base.height was 0.213 m at 3.410 s, 0.087 m short".
std::string Explain(const Expectation& expectation, const Ruling& ruling);

// Returns the margin with its unit, "" if there is none.
std::string MarginText(const Expectation& expectation, const judge::Verdict& verdict);

// Returns a number with four digits, or fewer where they are 0.
std::string NumberText(double number);

}  // namespace understudy::rehearse
