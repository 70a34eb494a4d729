// Claims about a run, and their verdicts.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "judge/stream.h"

namespace understudy::judge {

enum class Operator : std::uint8_t {
  kAlways,
  kNever,
  kEventually,
  kSettles,
  kStays,
  kCount,
  kFinal,
};

// A claim holds over a window [a, b] of time. `f` is its formula, `rob` its robustness.
struct OperatorRow {
  Operator op;
  std::string_view word;
  std::string_view formula;  // in signal temporal logic
  bool takes_until, takes_within, takes_for, takes_bounds;
  std::string_view says;  // for the documentation
};

// In the order of the enumeration.
std::span<const OperatorRow> Operators();
const OperatorRow& RowOf(Operator op);

// One end of a window: an instant, or the first instant at which a formula holds.
struct Edge {
  std::optional<Time> at{};
  std::optional<Formula> when{};

  bool given() const { return at || when; }
};

struct Claim {
  Operator op = Operator::kAlways;
  Formula formula{};
  std::optional<Formula> until{};  // kAlways: the formula holds until this does, which it must
  Edge from{};                     // else the first sample
  Edge to{};                       // else the end; the instant of a formula is not in the window
  std::optional<Time> length{};    // of the window, in place of `to`
  // kEventually: at the latest so long after the window's beginning; kSettles: and from then on;
  // kAlways with `until`: the latest for that.
  std::optional<Time> within{};
  Time hold = 0;     // kStays: for so long
  double least = 0;  // kCount
  double most = std::numeric_limits<double>::infinity();
};

enum class Outcome : std::uint8_t { kUndecided, kPassed, kFailed, kNotJudged };

constexpr std::string_view Name(Outcome outcome) {
  constexpr std::string_view kNames[] = {"undecided", "passed", "failed", "not judged"};
  return kNames[static_cast<std::size_t>(outcome)];
}

// Why there is no margin.
enum class Reason : std::uint8_t {
  kNone,
  kNeverBegan,   // what the window begins with never came: the claim fails
  kEndedBefore,  // the samples end before the window begins
  kEndedWithin,  // the samples end before the window does, and the claim is open
  kNothingSaid,  // the formula is unknown at every instant of the window
};

struct Verdict {
  Outcome outcome = Outcome::kUndecided;
  Reason reason = Reason::kNone;
  // The robustness, and the instant, comparison and value that gave it. Of kCount the number of
  // times is the value and the margin that to the nearer bound.
  Worth worth{};
  bool of_until = false;               // the comparison is one of `until`
  std::optional<Time> came_true{};     // the first instant of kEventually and of what kAlways waits
                                       // for; that from which kSettles holds
  std::optional<Time> begin{}, end{};  // of the window, as far as it came
};

// Judges one claim while the samples come. The verdict is the same however they are handed over.
class ClaimJudge {
 public:
  // `claim` must outlive the judge.
  explicit ClaimJudge(const Claim& claim);

  // The signals have these values from `begin` to `end`.
  void Advance(Time begin, Time end, std::span<const double> signals);
  // No sample comes after `last`; `cut`: though some were to come, so a window to the end is open.
  void Finish(Time last, bool cut = false);

  // kUndecided while samples to come may change the outcome. The margin may change until Finish.
  const Verdict& verdict() const { return verdict_; }

 private:
  enum class Stage : std::uint8_t { kBefore, kIn, kOver };
  // The pieces of all streams of the claim, cut at the same instants.
  struct Source {
    Stream stream;
    std::deque<Piece> pieces{};
  };
  // One stretch of time with the worth of each stream; of those that the claim has.
  struct Stretch {
    Time begin = 0, end = 0;
    Worth main{}, until{}, from{}, to{};
  };

  void Take(const Stretch& stretch);
  void Begin(Time at);
  void Fold(const Stretch& stretch);
  void Close();
  void DecideEarly();
  void Decide(Outcome outcome, Reason reason = Reason::kNone);
  Time FoldsFrom() const;

  const Claim& claim_;
  Formula main_;  // as it is streamed
  std::vector<Source> sources_;
  std::optional<std::size_t> until_, from_, to_;  // places in sources_; main is the first
  std::vector<Piece> scratch_;

  Stage stage_ = Stage::kBefore;
  std::optional<Time> first_;  // sample
  std::optional<Time> last_;   // end of the window, inclusive, if it is known
  Verdict verdict_;
  bool any_ = false;   // something was known in the window
  bool held_ = false;  // the formula at the last instant
  Worth low_;          // of kAlways with until: the least so far
  bool has_low_ = false;
  double times_ = 0;
};

}  // namespace understudy::judge
