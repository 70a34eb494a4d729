#include "schema/field.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace understudy::schema {
namespace {

using nlohmann::json;

constexpr std::string_view kWords[] = {"strict", "lenient"};
const Field kSeconds{.key = "for", .unit = "s", .range = {0, 10}};
const Field kDomain{.key = "domain", .type = &kWhole, .range = {0, 232}};
const Field kMode{.key = "mode", .type = &kWord, .words = kWords};
const Field kOn{.key = "on", .type = &kSwitch};

// The number that a field takes of a scalar of YAML, as text; "refused" if it takes none.
std::string OfYaml(const Field& field, const std::string& text) {
  const YamlValue value = ParseYaml(text, "a.yaml");
  const auto taken = Take(field, value);
  return taken ? NumberText(taken->number) : "refused";
}

std::string OfJson(const Field& field, const json& value) {
  const auto taken = Take(field, value);
  return taken ? NumberText(taken->number) : "refused";
}

std::string RefusedYaml(const Field& field, const std::string& text) {
  const YamlValue value = ParseYaml(text, "a.yaml");
  return Refusal(field, value);
}

TEST(FieldTest, TakesANumberInItsRangeFromYamlAndJson) {
  for (const char* text : {"10", "+10", "1e1", "10.0"}) EXPECT_EQ(OfYaml(kSeconds, text), "10");
  for (const char* text : {"'10'", "10.1", "-1", "ten", "nan", "[1]", "true", ""}) {
    EXPECT_EQ(OfYaml(kSeconds, text), "refused") << text;
  }
  EXPECT_EQ(OfJson(kSeconds, 10), "10");
  for (const json& value : {json("10"), json(10.1), json(true), json(), json::array({1})}) {
    EXPECT_EQ(OfJson(kSeconds, value), "refused") << value;
  }
}

TEST(FieldTest, TakesAWholeNumberWithoutAPointFromYamlAndInBothWritingsFromJson) {
  EXPECT_EQ(OfYaml(kDomain, "3"), "3");
  EXPECT_EQ(OfYaml(kDomain, "3.0"), "refused");
  EXPECT_EQ(OfJson(kDomain, 3.0), "3");
  EXPECT_EQ(OfJson(kDomain, 3.5), "refused");
  EXPECT_EQ(OfJson(kDomain, 233), "refused");
}

TEST(FieldTest, MovesAClampedNumberToTheEndOfItsRange) {
  Field clamped = kSeconds;
  clamped.clamped = true;
  EXPECT_EQ(OfJson(clamped, 99), "10");
  EXPECT_EQ(OfJson(clamped, -99), "0");
}

TEST(FieldTest, TakesSwitchesAndWordsByTheirPlace) {
  EXPECT_EQ(OfYaml(kOn, "true"), "1");
  EXPECT_EQ(OfYaml(kOn, "off"), "0");
  EXPECT_EQ(OfYaml(kOn, "yes"), "refused");
  EXPECT_EQ(OfJson(kOn, 1), "refused");
  EXPECT_EQ(OfJson(kMode, "lenient"), "1");
  EXPECT_EQ(OfYaml(kMode, "loose"), "refused");
}

TEST(FieldTest, RefusesWithWhatItExpectedAndTheNearestWord) {
  EXPECT_EQ(RefusedYaml(kSeconds, "fast"), "expected a number from 0 to 10 s, got 'fast'");
  EXPECT_EQ(Refusal(kSeconds, json(11)), "expected a number from 0 to 10 s, got 11");
  EXPECT_EQ(Refusal(kMode, json("lenint")),
            "expected one of strict, lenient, got \"lenint\"; did you mean 'lenient'?");
  EXPECT_EQ(Refusal(kSeconds, json::array()), "expected a number from 0 to 10 s, got an array");
}

TEST(FieldTest, SaysWhatItTakesInErrorsAndInTables) {
  const Field open{.key = "a", .unit = "m"}, least{.key = "a", .unit = "m", .range = kNotNegative};
  EXPECT_EQ(Expected(open), "a number in m");
  EXPECT_EQ(Expected(least), "a number of at least 0 m");
  EXPECT_EQ(Allowed(least), "at least 0");
  EXPECT_EQ(Allowed(kDomain), "whole, 0 to 232");
  EXPECT_EQ(Allowed(kMode), "strict, lenient");
  const Field pair{.key = "a", .type = &kNumbers, .range = {0, 1}, .count = 2};
  EXPECT_EQ(Expected(pair), "a list of 2 numbers from 0 to 1");
  EXPECT_EQ(Allowed(pair), "2 numbers, 0 to 1");
}

TEST(NumberTextTest, ReadsBackAsTheSameNumberAndIsPlainWhereThatIsShort) {
  EXPECT_EQ(NumberText(1e6), "1000000");
  EXPECT_EQ(NumberText(1e-4), "0.0001");
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(-0.35), "-0.35");
  EXPECT_EQ(NumberText(0), "0");
  EXPECT_EQ(NumberText(2147483647), "2147483647");
  EXPECT_EQ(NumberText(1e8), "1e+08");
}

}  // namespace
}  // namespace understudy::schema
