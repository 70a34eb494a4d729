#include "judge/judge.h"

#include <algorithm>
#include <utility>

namespace understudy::judge {

Judge::Judge(std::vector<Claim> claims) : claims_(std::move(claims)) {
  for (const Claim& claim : claims_) judges_.emplace_back(claim);
}

void Judge::Take(Time at, std::span<const double> signals) {
  if (now_ && at <= *now_) return;
  if (now_) {
    for (ClaimJudge& judge : judges_) judge.Advance(*now_, at, signals_);
  }
  now_ = at;
  signals_.assign(signals.begin(), signals.end());
}

void Judge::Finish(bool cut) {
  if (!now_) return;
  for (ClaimJudge& judge : judges_) {
    judge.Advance(*now_, *now_ + 1, signals_);
    judge.Finish(*now_, cut);
  }
}

bool Judge::decided() const {
  return std::ranges::none_of(judges_, [](const ClaimJudge& judge) {
    return judge.verdict().outcome == Outcome::kUndecided;
  });
}

bool Judge::failed() const {
  return std::ranges::any_of(
      judges_, [](const ClaimJudge& judge) { return judge.verdict().outcome == Outcome::kFailed; });
}

}  // namespace understudy::judge
