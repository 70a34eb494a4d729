// Judges the claims of a run from its samples.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "judge/claim.h"

namespace understudy::judge {

// Pure: it has no clock and reads nothing. The same samples give the same verdicts, bit for bit.
class Judge {
 public:
  explicit Judge(std::vector<Claim> claims);
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  // The signals at `at`, which they keep until the next sample; NaN: nothing has been said yet.
  // Ignores a sample that is not later than the one before.
  void Take(Time at, std::span<const double> signals);
  // No sample comes any more; `cut`: though some were to come, as in a run that is interrupted.
  void Finish(bool cut = false);

  const Verdict& verdict(std::size_t claim) const { return judges_[claim].verdict(); }
  std::size_t size() const { return judges_.size(); }
  // Returns whether samples to come can change no outcome, and whether a claim has failed.
  bool decided() const;
  bool failed() const;
  // The last sample.
  std::optional<Time> now() const { return now_; }

 private:
  std::vector<Claim> claims_;
  std::deque<ClaimJudge> judges_;
  std::optional<Time> now_;
  std::vector<double> signals_;  // since then
};

}  // namespace understudy::judge
