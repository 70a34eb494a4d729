#include "judge/condition.h"

#include <gtest/gtest.h>

namespace understudy::judge {
namespace {

using Kind = Condition::Kind;

Condition Read(const std::string& text) {
  const auto condition = ReadCondition(text);
  EXPECT_TRUE(condition) << text << ": " << condition.why();
  return condition ? *condition : Condition{};
}
std::string WhyNot(const std::string& text) { return ReadCondition(text).why(); }

TEST(ConditionTest, ReadsEveryFormOfComparison) {
  for (const char* text :
       {"base.height < 0.8", "base.height <= 0.8 cm", "rt/lowstate:imu_state.rpy[0] > -3",
        "gap(rt/lowcmd) >= 20 ms", "state is 500", "gate is damping", "base.x is 1 +- 0.25 m",
        "refused happens", "lowcmd arrives", "the program prints \"all (is) well\""}) {
    const Condition read = Read(text);
    EXPECT_EQ(read.kind, Kind::kComparison) << text;
    EXPECT_EQ(Text(read.comparison), text);
  }
}

TEST(ConditionTest, ReadsWithoutSpacesAroundComparisons) {
  EXPECT_EQ(Read("base.height<0.8").comparison, Read("base.height < 0.8").comparison);
}

TEST(ConditionTest, BindsNotBeforeAndBeforeOr) {
  const Condition any = Read("not a > 1 and b > 2 or c > 3");
  ASSERT_EQ(any.kind, Kind::kAny);
  ASSERT_EQ(any.parts.size(), 2U);
  ASSERT_EQ(any.parts[0].kind, Kind::kAll);
  EXPECT_EQ(any.parts[0].parts[0].kind, Kind::kNot);
  EXPECT_EQ(any.parts[1].comparison.subject, "c");
  EXPECT_EQ(Read("a > 1 and (b > 2 or c > 3)").kind, Kind::kAll);
}

TEST(ConditionTest, MakesBetweenOfTwoComparisonsAndIsNotOfOne) {
  const Condition between = Read("base.x between -1 and 2 cm");
  ASSERT_EQ(between.kind, Kind::kAll);
  EXPECT_EQ(Text(between.parts[0].comparison), "base.x >= -1 cm");
  EXPECT_EQ(Text(between.parts[1].comparison), "base.x <= 2 cm");
  EXPECT_EQ(Read("gate is not closed").kind, Kind::kNot);
}

TEST(ConditionTest, SaysWhatWasExpectedAfterWhat) {
  EXPECT_EQ(WhyNot(""), "expected a signal, an event or a topic, got the end");
  EXPECT_EQ(
      WhyNot("base.height"),
      "expected one of < <= > >= is between happens arrives after 'base.height', got the end");
  EXPECT_EQ(WhyNot("the robot prints \"x\""), "expected 'program' after 'the', got 'robot'");
  EXPECT_EQ(WhyNot("the program says \"x\""), "expected 'prints' after 'program', got 'says'");
  for (const char* text : {"the program prints", "the program prints x", "the program prints \"\"",
                           "the program prints \"x"}) {
    EXPECT_TRUE(WhyNot(text).starts_with("expected a text between double quotes")) << text;
  }
  EXPECT_EQ(WhyNot("the program prints \"" + std::string(101, 'x') + "\""),
            "a text has at most 100 bytes");
  EXPECT_EQ(WhyNot("base.height < high"), "expected a number after '<', got 'high'");
  EXPECT_EQ(WhyNot("a > 1 b > 2"), "expected 'and', 'or' or the end after 'b', got '>'");
  EXPECT_EQ(WhyNot("(a > 1"), "expected ')' after '1', got the end");
  EXPECT_EQ(WhyNot("a between 2 and 1"), "between: the second number is below the first");
  EXPECT_EQ(WhyNot("a is 1 +- -1"),
            "expected a number that is not negative after '-1', got the end");
  EXPECT_EQ(WhyNot("a is and"), "expected a number or a word after 'is', got 'and'");
  EXPECT_EQ(WhyNot("a < nan"), "expected a number after '<', got 'nan'");
}

TEST(ConditionTest, RefusesWhatIsTooLongOrTooDeep) {
  EXPECT_EQ(WhyNot(std::string(1001, 'a')), "a condition has at most 1000 characters");
  EXPECT_EQ(WhyNot(std::string(500, '(')), "it is nested too deeply");
}

}  // namespace
}  // namespace understudy::judge
