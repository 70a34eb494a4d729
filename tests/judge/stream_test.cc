#include "judge/stream.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace understudy::judge {
namespace {

// A signal with one value per instant from 0 on.
using Line = std::vector<double>;

Formula Above(double value) {
  return {.op = Op::kLeaf, .leaf = {.compare = Compare::kAtLeast, .value = value}};
}
Formula Over(Op op, Time from, Time to, Formula part) {
  return {.op = op, .parts = {std::move(part)}, .from = from, .to = to};
}

// The margin at each instant that is known.
Line MarginsOf(const Formula& formula, const Line& signal) {
  Stream stream(formula);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const auto at = static_cast<Time>(i);
    stream.Advance(at, at + 1, std::span(&signal[i], 1), &pieces);
  }
  Line margins;
  for (const Piece& piece : pieces) {
    EXPECT_EQ(piece.begin, static_cast<Time>(margins.size()));
    EXPECT_LT(piece.begin, piece.end);
    margins.resize(static_cast<std::size_t>(piece.end), piece.worth.margin);
  }
  return margins;
}

TEST(MarginTest, HoldsAtABoundOnlyIfItIsPartOfTheComparison) {
  EXPECT_FALSE(Holds(MarginOf({.compare = Compare::kBelow, .value = 5}, 5)));
  EXPECT_TRUE(Holds(MarginOf({.compare = Compare::kAtMost, .value = 5}, 5)));
  EXPECT_FALSE(Holds(MarginOf({.compare = Compare::kAbove, .value = 5}, 5)));
  EXPECT_TRUE(Holds(MarginOf({.compare = Compare::kAtLeast, .value = 5}, 5)));
  EXPECT_TRUE(Holds(MarginOf({.compare = Compare::kNear, .value = 5, .tolerance = 1}, 6)));
}

TEST(MarginTest, HasTheUnitOfTheComparison) {
  EXPECT_DOUBLE_EQ(MarginOf({.compare = Compare::kBelow, .value = 100, .scale = 1000}, 0.02), 80);
}

TEST(MarginTest, OrdersAFailureByNothingBelowAnHoldByNothing) {
  EXPECT_TRUE(IsLess(-0.0, 0.0));
  EXPECT_FALSE(IsLess(0.0, -0.0));
  EXPECT_FALSE(IsLess(0.0, 0.0));
}

// A formula that does not look ahead, by chance.
Formula Draw(int depth, std::minstd_rand* random) {
  const auto kind = (*random)() % (depth == 0 ? 1U : 4U);
  if (kind == 0) {
    return {.op = Op::kLeaf,
            .leaf = {.signal = (*random)() % 2,
                     .compare = (*random)() % 2 == 0 ? Compare::kBelow : Compare::kEqual,
                     .value = static_cast<double>((*random)() % 4),
                     .fails_unsaid = (*random)() % 2 == 0}};
  }
  if (kind == 1) return {.op = Op::kNot, .parts = {Draw(depth - 1, random)}};
  return {.op = kind == 2 ? Op::kAll : Op::kAny,
          .parts = {Draw(depth - 1, random), Draw(depth - 1, random), Draw(depth - 1, random)}};
}

TEST(MarginTest, OfAFormulaAtAnInstantIsWhatItsStreamSays) {
  std::minstd_rand random(5);
  for (int i = 0; i < 2000; ++i) {
    const Formula formula = Draw(3, &random);
    const auto value = [&] {
      const auto drawn = random() % 5;
      return drawn == 4 ? kUnknown : static_cast<double>(drawn);
    };
    const double signals[] = {value(), value()};
    std::vector<Piece> pieces;
    Stream(formula).Advance(0, 1, signals, &pieces);
    ASSERT_EQ(pieces.size(), 1U);
    const double streamed = pieces[0].worth.margin, margin = MarginOf(formula, signals);
    ASSERT_EQ(IsKnown(margin), IsKnown(streamed));
    if (!IsKnown(margin)) continue;
    ASSERT_EQ(margin, streamed);
    ASSERT_EQ(Holds(margin), Holds(streamed));
  }
}

TEST(MarginTest, OfAFormulaThatLooksAheadIsUnknown) {
  const double signal = 1;
  EXPECT_FALSE(IsKnown(MarginOf(Over(Op::kAlways, 0, 1, Above(0)), std::span(&signal, 1))));
}

TEST(StreamTest, LooksAheadOverAWindow) {
  const Line signal{3, 1, 4, 1, 5, 9, 2, 6};
  EXPECT_EQ(MarginsOf(Over(Op::kAlways, 0, 2, Above(0)), signal), (Line{1, 1, 1, 1, 2, 2}));
  EXPECT_EQ(MarginsOf(Over(Op::kEventually, 1, 3, Above(0)), signal), (Line{4, 5, 9, 9, 9}));
}

TEST(StreamTest, KnowsAnInstantOnlyWhenAllThatItLooksAheadToHasCome) {
  const Formula formula = Over(Op::kAlways, 5, 7, Above(0));
  Stream stream(formula);
  std::vector<Piece> pieces;
  const double signal = 1;
  stream.Advance(0, 7, std::span(&signal, 1), &pieces);
  EXPECT_TRUE(pieces.empty());
  stream.Advance(7, 8, std::span(&signal, 1), &pieces);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces.front().end, 1);
}

TEST(StreamTest, AgreesWithItsDefinitionOnRandomSignals) {
  std::mt19937 randomizer(1);
  std::uniform_real_distribution<double> value(-1, 1);
  std::uniform_int_distribution<int> delay(0, 6);
  for (int round = 0; round < 50; ++round) {
    Line signal(60);
    for (double& one : signal) one = value(randomizer);
    const Time from = delay(randomizer), inner_to = delay(randomizer);
    const Time to = from + delay(randomizer);
    const Formula formula =
        Over(Op::kAlways, from, to, Over(Op::kEventually, 0, inner_to, Above(0.1)));
    const Line margins = MarginsOf(formula, signal);
    ASSERT_EQ(margins.size(), signal.size() - static_cast<std::size_t>(to + inner_to));
    for (std::size_t t = 0; t < margins.size(); ++t) {
      double least = INFINITY;
      for (Time i = from; i <= to; ++i) {
        const auto begin = signal.begin() + static_cast<std::ptrdiff_t>(t) + i;
        least = std::min(least, *std::max_element(begin, begin + inner_to + 1) - 0.1);
      }
      ASSERT_EQ(margins[t], least) << "round " << round << ", instant " << t;
    }
  }
}

TEST(StreamTest, NamesTheInstantAndTheComparisonThatDecided) {
  Formula formula{.op = Op::kAll, .parts = {Above(0), Above(2)}};
  ASSERT_EQ(NumberLeaves(&formula), 2U);
  const Formula always = Over(Op::kAlways, 0, 2, formula);
  Stream stream(always);
  std::vector<Piece> pieces;
  for (const auto& [at, signal] : {std::pair(10, 5.0), std::pair(11, 3.0), std::pair(12, 4.0)}) {
    stream.Advance(at, at + 1, std::span(&signal, 1), &pieces);
  }
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces.front().worth.margin, 1);
  EXPECT_EQ(pieces.front().worth.at, 11);
  EXPECT_EQ(pieces.front().worth.leaf, 1U);
  EXPECT_EQ(pieces.front().worth.value, 3);
}

}  // namespace
}  // namespace understudy::judge
