#include "base/log_line.h"

#include <array>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace understudy {
namespace {

TEST(JsonLogLineTest, IsOneObjectHoweverManyLinesTheMessageHas) {
  const std::string line = JsonLogLine(
      std::chrono::system_clock::time_point(std::chrono::milliseconds(1500)), "error", "a\nb\"c");
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const auto read = nlohmann::json::parse(line);
  EXPECT_EQ(read["time"], 1.5);
  EXPECT_EQ(read["level"], "error");
  EXPECT_EQ(read["message"], "a\nb\"c");
}

TEST(JsonLogLineTest, ReplacesWhatIsNoUtf8) {
  const std::string line = JsonLogLine({}, "info", "a\xff\xfe\x01z");
  EXPECT_NE(nlohmann::json::parse(line)["message"], "");
}

TEST(AsksForJsonTest, LooksAtThisProgramsWordsOnly) {
  const std::array ours = {"understudy", "run", "--json", "go2"};
  const std::array theirs = {"understudy", "exec", "go2", "--", "prog", "--json"};
  EXPECT_TRUE(AsksForJson(ours.size(), ours.data()));
  EXPECT_FALSE(AsksForJson(theirs.size(), theirs.data()));
  EXPECT_FALSE(AsksForJson(1, ours.data()));
}

}  // namespace
}  // namespace understudy
