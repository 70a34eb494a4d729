#include "judge/claim.h"

#include <algorithm>
#include <cmath>

namespace understudy::judge {
namespace {

constexpr OperatorRow kRows[] = {
    {Operator::kAlways, "always", "G[a,b] f; with until: f U[a,b] g", true, true, false, false,
     "It holds at every instant of the window; with `until`, at every one before that comes, and "
     "that does come"},
    {Operator::kNever, "never", "G[a,b] not f", false, false, false, false,
     "It holds at no instant of the window"},
    {Operator::kEventually, "eventually", "F[a,b] f; with within T: F[a,a+T] f", false, true, false,
     false, "It holds at some instant of the window, at the latest `within` after it begins"},
    {Operator::kSettles, "settles", "F[a,a+T] G[t,b] f, which is G[a+T,b] f", false, true, false,
     false, "At the latest `within` after the window begins it holds, and from then to its end"},
    {Operator::kStays, "stays", "F[a,b-D] G[0,D] f", false, false, true, false,
     "At some instant it begins to hold and does so `for` that long, all in the window"},
    {Operator::kCount, "count", "least <= n <= most", false, false, false, true,
     "It becomes true, or the event happens, so many times in the window: `least`, `most`"},
    {Operator::kFinal, "final", "f at b", false, false, false, false,
     "It holds at the last instant of the window"},
};

// What is folded for the claim.
Formula Streamed(const Claim& claim) {
  if (claim.op == Operator::kNever) return {.op = Op::kNot, .parts = {claim.formula}};
  if (claim.op == Operator::kStays) {
    return {.op = Op::kAlways, .parts = {claim.formula}, .from = 0, .to = claim.hold};
  }
  return claim.formula;
}

}  // namespace

std::span<const OperatorRow> Operators() { return kRows; }

const OperatorRow& RowOf(Operator op) { return kRows[static_cast<std::size_t>(op)]; }

ClaimJudge::ClaimJudge(const Claim& claim) : claim_(claim), main_(Streamed(claim)) {
  const auto add = [this](const std::optional<Formula>& formula, std::optional<std::size_t>* at) {
    if (!formula) return;
    *at = sources_.size();
    sources_.push_back({.stream = Stream(*formula)});
  };
  sources_.push_back({.stream = Stream(main_)});
  add(claim.until, &until_);
  add(claim.from.when, &from_);
  add(claim.to.when, &to_);
}

void ClaimJudge::Advance(Time begin, Time end, std::span<const double> signals) {
  if (stage_ == Stage::kOver) return;
  if (!first_) first_ = begin;
  for (Source& source : sources_) {
    scratch_.clear();
    source.stream.Advance(begin, end, signals, &scratch_);
    source.pieces.insert(source.pieces.end(), scratch_.begin(), scratch_.end());
  }
  while (stage_ != Stage::kOver &&
         std::ranges::none_of(sources_, [](const Source& one) { return one.pieces.empty(); })) {
    Stretch stretch{.begin = sources_.front().pieces.front().begin,
                    .end = sources_.front().pieces.front().end};
    for (const Source& source : sources_) {
      stretch.end = std::min(stretch.end, source.pieces.front().end);
    }
    const auto worth = [this](const std::optional<std::size_t>& at) {
      return at ? sources_[*at].pieces.front().worth : Worth{};
    };
    stretch.main = worth(0);
    stretch.until = worth(until_);
    stretch.from = worth(from_);
    stretch.to = worth(to_);
    for (Source& source : sources_) {
      Piece& piece = source.pieces.front();
      piece.begin = stretch.end;
      if (piece.end == stretch.end) source.pieces.pop_front();
    }
    Take(stretch);
  }
}

void ClaimJudge::Take(const Stretch& whole) {
  Stretch stretch = whole;
  if (stage_ == Stage::kBefore) {
    if (claim_.from.when) {
      if (!stretch.from.known() || !stretch.from.holds()) return;
      Begin(stretch.begin);
    } else {
      const Time at = std::max(claim_.from.at.value_or(*first_), *first_);
      if (stretch.end <= at) return;
      Begin(at);
    }
  }
  stretch.begin = std::max(stretch.begin, *verdict_.begin);
  // The window ends before the instant at which its end's formula holds.
  if (claim_.to.when && stretch.to.known() && stretch.to.holds()) {
    last_ = stretch.begin - 1;
    Close();
    return;
  }
  if (last_ && stretch.begin > *last_) {
    Close();
    return;
  }
  verdict_.end = last_ ? std::min(*last_, stretch.end - 1) : stretch.end - 1;
  Fold(stretch);
  if (last_ && stretch.end > *last_) {
    Close();
  } else {
    DecideEarly();
  }
}

void ClaimJudge::Begin(Time at) {
  stage_ = Stage::kIn;
  verdict_.begin = at;
  if (claim_.to.at) last_ = *claim_.to.at;
  if (claim_.length) last_ = at + *claim_.length;
  const bool latest = claim_.op == Operator::kEventually || claim_.op == Operator::kAlways;
  if (claim_.within && latest)
    last_ = std::min(last_.value_or(at + *claim_.within), at + *claim_.within);
  if (last_ && claim_.op == Operator::kStays) last_ = *last_ - claim_.hold;
}

// The instant from which the formula must hold.
Time ClaimJudge::FoldsFrom() const {
  return *verdict_.begin + (claim_.op == Operator::kSettles ? claim_.within.value_or(0) : 0);
}

void ClaimJudge::Fold(const Stretch& stretch) {
  const Worth& main = stretch.main;
  // An instant before the window is not the one that decided.
  const auto within = [this](Worth worth) {
    worth.at = std::max(worth.at, FoldsFrom());
    return worth;
  };
  if (claim_.op == Operator::kSettles && main.known()) {
    if (main.holds() && !held_) verdict_.came_true = stretch.begin;
    if (!main.holds()) verdict_.came_true.reset();
    held_ = main.holds();
  }
  if (stretch.end <= FoldsFrom()) return;
  if (until_) {
    if (!stretch.until.known()) return;
    const Worth& both = has_low_ ? Least(stretch.until, low_) : stretch.until;
    if (!any_ || IsLess(verdict_.worth.margin, both.margin)) {
      verdict_.worth = within(both);
      verdict_.of_until = &both == &stretch.until;
    }
    any_ = true;
    if (stretch.until.holds() && !verdict_.came_true) verdict_.came_true = stretch.begin;
    if (main.known() && (!has_low_ || IsLess(main.margin, low_.margin))) low_ = main;
    has_low_ = has_low_ || main.known();
    return;
  }
  if (!main.known()) return;
  switch (claim_.op) {
    case Operator::kAlways:
    case Operator::kNever:
    case Operator::kSettles:
      if (!any_ || IsLess(main.margin, verdict_.worth.margin)) verdict_.worth = within(main);
      break;
    case Operator::kEventually:
    case Operator::kStays:
      if (main.holds() && !verdict_.came_true) verdict_.came_true = stretch.begin;
      if (!any_ || IsLess(verdict_.worth.margin, main.margin)) verdict_.worth = within(main);
      break;
    case Operator::kCount:
      if (main.holds() && !held_) {
        // An event may happen several times at once.
        const bool event = main_.op == Op::kLeaf && main_.leaf.compare == Compare::kTrue;
        times_ += event ? main.value : 1;
        verdict_.worth.at = stretch.begin;
      }
      held_ = main.holds();
      verdict_.worth.value = times_;
      verdict_.worth.margin = std::min(times_ - claim_.least, claim_.most - times_);
      break;
    case Operator::kFinal:
      verdict_.worth = within(main);
      break;
  }
  any_ = true;
}

// What no later sample can change.
void ClaimJudge::DecideEarly() {
  if (!any_) return;
  const bool holds = verdict_.worth.holds();
  switch (claim_.op) {
    case Operator::kAlways:
      if (until_) {
        if (holds) return Decide(Outcome::kPassed);
        if (has_low_ && !low_.holds()) Decide(Outcome::kFailed);
        return;
      }
      [[fallthrough]];
    case Operator::kNever:
    case Operator::kSettles:
      if (!holds) Decide(Outcome::kFailed);
      return;
    case Operator::kEventually:
    case Operator::kStays:
      if (holds) Decide(Outcome::kPassed);
      return;
    case Operator::kCount:
      if (times_ > claim_.most) Decide(Outcome::kFailed);
      return;
    case Operator::kFinal:
      return;
  }
}

void ClaimJudge::Close() {
  stage_ = Stage::kOver;
  if (!any_) return Decide(Outcome::kNotJudged, Reason::kNothingSaid);
  // Too few is decided by the end.
  if (claim_.op == Operator::kCount && times_ < claim_.least) verdict_.worth.at = *verdict_.end;
  Decide(verdict_.worth.holds() ? Outcome::kPassed : Outcome::kFailed);
}

void ClaimJudge::Finish(Time last, bool cut) {
  if (stage_ == Stage::kOver) return;
  if (stage_ == Stage::kBefore) {
    stage_ = Stage::kOver;
    if (claim_.from.when) return Decide(Outcome::kFailed, Reason::kNeverBegan);
    return Decide(Outcome::kNotJudged, Reason::kEndedBefore);
  }
  // A window to the end is over now; another one was not to end here.
  const bool open =
      cut || last_ || claim_.to.when || (claim_.op == Operator::kSettles && last < FoldsFrom());
  if (!open) return Close();
  stage_ = Stage::kOver;
  if (verdict_.outcome == Outcome::kUndecided) Decide(Outcome::kNotJudged, Reason::kEndedWithin);
}

void ClaimJudge::Decide(Outcome outcome, Reason reason) {
  verdict_.outcome = outcome;
  verdict_.reason = reason;
}

}  // namespace understudy::judge
