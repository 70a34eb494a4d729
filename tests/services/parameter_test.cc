#include "services/parameter.h"

#include <gtest/gtest.h>

namespace understudy::services {
namespace {

const std::vector<Field> kMove = {
    {.key = "x", .range = {-2.5, 3.8}, .required = true, .clamped = true},
    {.key = "level", .type = &schema::kWhole, .range = {-1, 1}}};

TEST(ParameterTest, ClampsWhatTheFieldSaysIsClamped) {
  EXPECT_EQ(DecodeParameter(R"({"x":9})", kMove)->at("x"), 3.8);
  EXPECT_EQ(DecodeParameter(R"({"x":-9.5})", kMove)->at("x"), -2.5);
}

TEST(ParameterTest, RefusesWhatIsOutOfRangeOtherwise) {
  EXPECT_FALSE(DecodeParameter(R"({"x":0,"level":2})", kMove));
}

TEST(ParameterTest, TakesWholeNumbersInBothWritings) {
  EXPECT_EQ(DecodeParameter(R"({"x":0,"level":1.0})", kMove)->at("level"), 1);
  EXPECT_FALSE(DecodeParameter(R"({"x":0,"level":0.5})", kMove));
}

TEST(ParameterTest, RefusesNumbersThatAreNoNumbers) {
  for (const char* text : {R"({"x":NaN})", R"({"x":1e999})", R"({"x":"1"})", R"({"x":null})",
                           R"({"x":true})", R"({"x":[1]})"}) {
    EXPECT_FALSE(DecodeParameter(text, kMove)) << text;
  }
}

TEST(ParameterTest, LeavesOutWhatTheSchemaDoesNotKnow) {
  EXPECT_EQ(DecodeParameter(R"({"x":1,"y":[[]]})", kMove)->size(), 1U);
}

TEST(ParameterTest, WantsNothingWhereThereIsNoField) {
  for (const char* text : {"", "{}", "garbage", "[1]"}) EXPECT_TRUE(DecodeParameter(text, {}));
}

TEST(ParameterTest, TakesEveryWayClientsSendAFlag) {
  const Field flag{.key = "data", .type = &kFlag, .required = true};
  EXPECT_EQ(DecodeParameter(R"({"data":true})", {&flag, 1})->at("data"), true);
  EXPECT_EQ(DecodeParameter(R"({"data":1})", {&flag, 1})->at("data"), true);
  EXPECT_EQ(DecodeParameter(R"({"data":0})", {&flag, 1})->at("data"), false);
  EXPECT_FALSE(DecodeParameter(R"({"data":2})", {&flag, 1}));
  EXPECT_FALSE(DecodeParameter(R"({"data":"on"})", {&flag, 1}));
}

TEST(ParameterTest, TakesAFieldByItsOtherName) {
  const Field action{.key = "action_id", .type = &schema::kWhole, .required = true, .also = "data"};
  EXPECT_EQ(DecodeParameter(R"({"data":27})", {&action, 1})->at("action_id"), 27);
}

TEST(ParameterTest, CountsTheElementsOfArrays) {
  const Field velocity{.key = "v", .type = &schema::kNumbers, .required = true, .count = 3};
  EXPECT_TRUE(DecodeParameter(R"({"v":[1,2,3]})", {&velocity, 1}));
  EXPECT_FALSE(DecodeParameter(R"({"v":[1,2]})", {&velocity, 1}));
  EXPECT_FALSE(DecodeParameter(R"({"v":[1,2,"3"]})", {&velocity, 1}));
}

TEST(ParameterTest, DescribesWhatItTakes) {
  EXPECT_EQ(DescribeFields(kMove),
            "x: a number from -2.5 to 3.8, clamped; level: a whole number from -1 to 1, if any");
  EXPECT_EQ(DescribeFields({}), "");
}

}  // namespace
}  // namespace understudy::services
