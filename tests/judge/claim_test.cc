#include "judge/claim.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "judge/judge.h"

namespace understudy::judge {
namespace {

using Line = std::vector<double>;

Formula Above(double value, std::size_t signal = 0) {
  return {.op = Op::kLeaf,
          .leaf = {.signal = signal, .compare = Compare::kAtLeast, .value = value}};
}
Formula Happens(std::size_t signal = 0) {
  return {.op = Op::kLeaf, .leaf = {.signal = signal, .compare = Compare::kTrue}};
}

// Judges a claim over a signal with one value per instant from 0 on.
Verdict Judged(const Claim& claim, const Line& signal) {
  Judge judge({claim});
  for (std::size_t i = 0; i < signal.size(); ++i) {
    judge.Take(static_cast<Time>(i), std::span(&signal[i], 1));
  }
  judge.Finish();
  return judge.verdict(0);
}
// Likewise over several signals.
Verdict Judged(const Claim& claim, const std::vector<Line>& samples) {
  Judge judge({claim});
  for (std::size_t i = 0; i < samples.size(); ++i) judge.Take(static_cast<Time>(i), samples[i]);
  judge.Finish();
  return judge.verdict(0);
}

TEST(ClaimTest, AlwaysHasTheLeastMarginAndItsInstant) {
  const Claim claim{.formula = Above(1)};
  Verdict verdict = Judged(claim, Line{4, 2, 3});
  EXPECT_EQ(verdict.outcome, Outcome::kPassed);
  EXPECT_EQ(verdict.worth.margin, 1);
  EXPECT_EQ(verdict.worth.at, 1);
  verdict = Judged(claim, Line{4, 0.5, 3});
  EXPECT_EQ(verdict.outcome, Outcome::kFailed);
  EXPECT_EQ(verdict.worth.margin, -0.5);
}

TEST(ClaimTest, NeverIsAlwaysNot) {
  const Verdict verdict = Judged({.op = Operator::kNever, .formula = Above(3)}, Line{1, 2.5, 2});
  EXPECT_EQ(verdict.outcome, Outcome::kPassed);
  EXPECT_EQ(verdict.worth.margin, 0.5);
  EXPECT_EQ(Judged({.op = Operator::kNever, .formula = Above(3)}, Line{3}).outcome,
            Outcome::kFailed);
}

TEST(ClaimTest, EventuallyHasTheLargestMarginAndSaysWhenItCameTrue) {
  const Claim claim{.op = Operator::kEventually, .formula = Above(2)};
  const Verdict verdict = Judged(claim, Line{0, 2.5, 4, 3});
  EXPECT_EQ(verdict.outcome, Outcome::kPassed);
  EXPECT_EQ(verdict.worth.margin, 2);
  EXPECT_EQ(verdict.worth.at, 2);
  EXPECT_EQ(verdict.came_true, 1);
  EXPECT_EQ(Judged(claim, Line{0, 1}).outcome, Outcome::kFailed);
}

TEST(ClaimTest, WithinEndsTheWindow) {
  const Claim claim{
      .op = Operator::kEventually, .formula = Above(2), .from = {.at = 1}, .within = 2};
  EXPECT_EQ(Judged(claim, Line{0, 0, 0, 2, 0}).outcome, Outcome::kPassed);
  EXPECT_EQ(Judged(claim, Line{0, 0, 0, 0, 2}).outcome, Outcome::kFailed);
  EXPECT_EQ(Judged(claim, Line{2, 0, 0, 0, 2}).outcome, Outcome::kFailed);
}

TEST(ClaimTest, UntilNeedsTheFirstToHoldBeforeTheSecondAndTheSecondToCome) {
  const Claim claim{.formula = Above(0, 0), .until = Above(0, 1)};
  EXPECT_EQ(Judged(claim, std::vector<Line>{{1, -1}, {1, -1}, {-1, 2}}).outcome, Outcome::kPassed);
  EXPECT_EQ(Judged(claim, std::vector<Line>{{1, -1}, {-1, -1}, {1, 2}}).outcome, Outcome::kFailed);
  EXPECT_EQ(Judged(claim, std::vector<Line>{{1, -1}, {1, -1}}).outcome, Outcome::kFailed);
  const Verdict verdict = Judged(claim, std::vector<Line>{{3, -1}, {2, -1}, {-1, 5}});
  EXPECT_EQ(verdict.worth.margin, 2);
  EXPECT_EQ(verdict.worth.at, 1);
  EXPECT_FALSE(verdict.of_until);
  EXPECT_EQ(verdict.came_true, 2);
}

TEST(ClaimTest, SettlesLooksOnlyFromTheTimeGivenAndSaysFromWhenItHolds) {
  const Claim claim{.op = Operator::kSettles, .formula = Above(1), .within = 3};
  const Verdict verdict = Judged(claim, Line{0, 2, 0, 3, 2, 4});
  EXPECT_EQ(verdict.outcome, Outcome::kPassed);
  EXPECT_EQ(verdict.worth.margin, 1);
  EXPECT_EQ(verdict.worth.at, 4);
  EXPECT_EQ(verdict.came_true, 3);
  EXPECT_EQ(Judged(claim, Line{2, 2, 2, 0, 2}).outcome, Outcome::kFailed);
  EXPECT_EQ(Judged(claim, Line{2, 2}).outcome, Outcome::kNotJudged);
}

TEST(ClaimTest, StaysNeedsItForThatLongInTheWindow) {
  const Claim claim{.op = Operator::kStays, .formula = Above(1), .hold = 2};
  const Verdict verdict = Judged(claim, Line{0, 2, 0, 3, 4, 2, 0});
  EXPECT_EQ(verdict.outcome, Outcome::kPassed);
  EXPECT_EQ(verdict.worth.margin, 1);
  EXPECT_EQ(verdict.worth.at, 5);
  EXPECT_EQ(verdict.came_true, 3);
  EXPECT_EQ(Judged(claim, Line{0, 2, 2, 0, 3, 4}).outcome, Outcome::kFailed);
}

TEST(ClaimTest, CountsHowOftenAConditionBecomesTrue) {
  Claim claim{.op = Operator::kCount, .formula = Above(1), .least = 2, .most = 3};
  const Verdict verdict = Judged(claim, Line{2, 0, 2, 2, 0});
  EXPECT_EQ(verdict.outcome, Outcome::kPassed);
  EXPECT_EQ(verdict.worth.value, 2);
  EXPECT_EQ(verdict.worth.margin, 0);
  EXPECT_EQ(Judged(claim, Line{2, 2, 2}).outcome, Outcome::kFailed);
  EXPECT_EQ(Judged(claim, Line{2, 0, 2, 0, 2, 0, 2}).worth.margin, -1);
}

TEST(ClaimTest, CountsEventsThatHappenAtOnce) {
  const Claim claim{.op = Operator::kCount, .formula = Happens(), .most = 4};
  const Verdict verdict = Judged(claim, Line{0, 3, 0, 2, 0});
  EXPECT_EQ(verdict.worth.value, 5);
  EXPECT_EQ(verdict.outcome, Outcome::kFailed);
}

TEST(ClaimTest, FinalIsTheLastInstantOfTheWindow) {
  EXPECT_EQ(Judged({.op = Operator::kFinal, .formula = Above(1)}, Line{0, 0, 3}).worth.margin, 2);
  const Claim before{.op = Operator::kFinal, .formula = Above(1), .to = {.at = 1}};
  EXPECT_EQ(Judged(before, Line{0, 4, 0}).worth.margin, 3);
}

TEST(ClaimTest, AWindowBeginsWhereItsConditionFirstHolds) {
  const Claim claim{.formula = Above(1, 0), .from = {.when = Above(1, 1)}};
  const Verdict verdict = Judged(claim, std::vector<Line>{{0, 0}, {2, 1}, {3, 0}});
  EXPECT_EQ(verdict.outcome, Outcome::kPassed);
  EXPECT_EQ(verdict.begin, 1);
  EXPECT_EQ(Judged(claim, std::vector<Line>{{2, 0}, {2, 1}, {0, 0}}).outcome, Outcome::kFailed);
}

TEST(ClaimTest, AWindowThatNeverBeginsIsAFailure) {
  const Verdict verdict =
      Judged({.formula = Above(1, 0), .from = {.when = Above(1, 1)}}, std::vector<Line>{{2, 0}});
  EXPECT_EQ(verdict.outcome, Outcome::kFailed);
  EXPECT_EQ(verdict.reason, Reason::kNeverBegan);
}

TEST(ClaimTest, AWindowEndsBeforeItsConditionHolds) {
  const Claim claim{.formula = Above(1, 0), .to = {.when = Above(1, 1)}};
  EXPECT_EQ(Judged(claim, std::vector<Line>{{2, 0}, {0, 1}}).outcome, Outcome::kPassed);
  EXPECT_EQ(Judged(claim, std::vector<Line>{{2, 0}, {0, 0}, {2, 1}}).outcome, Outcome::kFailed);
}

TEST(ClaimTest, SamplesThatEndBeforeTheWindowDoLeaveOpenWhatTheyDoNotDecide) {
  EXPECT_EQ(Judged({.formula = Above(1), .to = {.at = 9}}, Line{2, 2}).outcome,
            Outcome::kNotJudged);
  EXPECT_EQ(Judged({.formula = Above(1), .to = {.at = 9}}, Line{2, 0}).outcome, Outcome::kFailed);
  const Claim eventually{.op = Operator::kEventually, .formula = Above(1), .to = {.at = 9}};
  EXPECT_EQ(Judged(eventually, Line{0, 2}).outcome, Outcome::kPassed);
  EXPECT_EQ(Judged(eventually, Line{0, 0}).outcome, Outcome::kNotJudged);
  EXPECT_EQ(Judged({.formula = Above(1), .from = {.at = 9}}, Line{2}).reason, Reason::kEndedBefore);
}

TEST(ClaimTest, WhatNobodySaidIsNotJudged) {
  const Verdict verdict = Judged({.formula = Above(1)}, Line{NAN, NAN});
  EXPECT_EQ(verdict.outcome, Outcome::kNotJudged);
  EXPECT_EQ(verdict.reason, Reason::kNothingSaid);
  EXPECT_EQ(Judged({.formula = Above(1)}, Line{NAN, 0}).outcome, Outcome::kFailed);
}

TEST(ClaimTest, WhatComesOnlyWithEventsFailsUntilItIsSaid) {
  Formula said = Above(1);
  said.leaf.fails_unsaid = true;
  EXPECT_EQ(Judged({.formula = said}, Line{NAN, 2}).outcome, Outcome::kFailed);
}

// All claims over one signal, with windows that end with the samples and before.
std::vector<Claim> AllClaims() {
  std::vector<Claim> claims;
  for (const OperatorRow& row : Operators()) {
    for (const std::optional<Time> to : {std::optional<Time>(), std::optional<Time>(30)}) {
      Claim claim{.op = row.op, .formula = Above(0.3), .from = {.at = 3}, .to = {.at = to}};
      if (row.takes_within) claim.within = 8;
      if (row.op == Operator::kAlways) claim.within.reset();
      claim.hold = 2;
      claim.most = 6;
      claims.push_back(claim);
    }
  }
  Claim until{.formula = Above(-0.9), .until = Above(0.95), .within = 20};
  claims.push_back(until);
  return claims;
}

TEST(JudgeTest, DecidesEarlyOnlyWhatTheRestCannotChange) {
  std::mt19937 randomizer(2);
  std::uniform_real_distribution<double> value(-1, 1);
  int decided = 0;
  for (int round = 0; round < 200; ++round) {
    Judge judge(AllClaims());
    std::vector<Outcome> early(judge.size(), Outcome::kUndecided);
    for (Time at = 0; at < 40; ++at) {
      const double signal = value(randomizer);
      judge.Take(at, std::span(&signal, 1));
      for (std::size_t i = 0; i < judge.size(); ++i) {
        const Outcome now = judge.verdict(i).outcome;
        if (early[i] != Outcome::kUndecided) {
          ASSERT_EQ(now, early[i]) << "claim " << i << " at " << at;
        }
        early[i] = now;
      }
    }
    judge.Finish();
    for (std::size_t i = 0; i < judge.size(); ++i) {
      if (early[i] == Outcome::kUndecided) continue;
      ASSERT_EQ(judge.verdict(i).outcome, early[i]) << "claim " << i;
      ++decided;
    }
  }
  EXPECT_GT(decided, 1000);
}

TEST(JudgeTest, GivesTheSameVerdictForSamplesThatChangeNothing) {
  std::mt19937 randomizer(3);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int round = 0; round < 50; ++round) {
    Judge sparse(AllClaims()), dense(AllClaims());
    for (Time at = 0; at < 40; at += 2) {
      const double signal = value(randomizer);
      sparse.Take(at, std::span(&signal, 1));
      dense.Take(at, std::span(&signal, 1));
      if (at < 38) dense.Take(at + 1, std::span(&signal, 1));
    }
    sparse.Finish();
    dense.Finish();
    for (std::size_t i = 0; i < sparse.size(); ++i) {
      const Verdict &a = sparse.verdict(i), &b = dense.verdict(i);
      EXPECT_EQ(a.outcome, b.outcome) << i;
      EXPECT_EQ(a.worth.margin, b.worth.margin) << i;
    }
  }
}

// A run that somebody ends early has not shown what was to hold to its end.
TEST(JudgeTest, DoesNotPassWhatWasToHoldToTheEndOfARunThatIsCut) {
  const auto outcomes = [](bool cut) {
    Judge judge({{.formula = Above(1)}, {.op = Operator::kEventually, .formula = Above(3)}});
    const double low = 2, high = 4;
    judge.Take(0, std::span(&low, 1));
    judge.Take(1, std::span(&high, 1));
    judge.Take(2, std::span(&low, 1));
    judge.Finish(cut);
    return std::pair(judge.verdict(0).outcome, judge.verdict(1).outcome);
  };
  EXPECT_EQ(outcomes(false), std::pair(Outcome::kPassed, Outcome::kPassed));
  EXPECT_EQ(outcomes(true), std::pair(Outcome::kNotJudged, Outcome::kPassed));
}

TEST(JudgeTest, IgnoresASampleThatIsNotLater) {
  Judge judge({{.formula = Above(1)}});
  const double high = 2, low = 0;
  judge.Take(5, std::span(&high, 1));
  judge.Take(5, std::span(&low, 1));
  judge.Take(4, std::span(&low, 1));
  judge.Finish();
  EXPECT_EQ(judge.verdict(0).outcome, Outcome::kPassed);
}

}  // namespace
}  // namespace understudy::judge
