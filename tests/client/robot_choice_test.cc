#include "client/robot_choice.h"

#include <sstream>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::client {
namespace {

// What is made of those lines, and what was asked.
struct Asked {
  std::optional<std::string> name;
  std::string text;
};

Asked Answering(const std::string& lines) {
  std::istringstream in(lines);
  std::ostringstream out;
  auto name = AskWhich({"left", "right"}, in, out);
  return {std::move(name), out.str()};
}

TEST(AskWhichTest, TakesANumberOrAName) {
  EXPECT_EQ(Answering("1\n").name, "left");
  EXPECT_EQ(Answering("2\n").name, "right");
  EXPECT_EQ(Answering("right\n").name, "right");
  EXPECT_THAT(Answering("1\n").text, ::testing::HasSubstr("  1  left\n  2  right\nwhich one? "));
}

TEST(AskWhichTest, AsksAgainUntilItIsOneOfThem) {
  const Asked asked = Answering("3\nrigth\n\n2\n");
  EXPECT_EQ(asked.name, "right");
  EXPECT_THAT(asked.text, ::testing::HasSubstr("a number from 1 to 2, or a name, please\n"));
}

TEST(AskWhichTest, NoAnswerIsNone) {
  EXPECT_EQ(Answering("").name, std::nullopt);
  EXPECT_EQ(Answering("3\n").name, std::nullopt);
}

}  // namespace
}  // namespace understudy::client
