#include "config/reference.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace understudy::config {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ConfigReferenceTest, HasARowForEveryKey) {
  const std::string text = ConfigReference();
  const std::vector<std::string> keys = ConfigKeys();
  EXPECT_GT(keys.size(), 70U);
  EXPECT_EQ(std::set<std::string>(keys.begin(), keys.end()).size(), keys.size());
  for (const std::string& key : keys) EXPECT_THAT(text, HasSubstr("\n| `" + key + "` | "));
}

TEST(ConfigReferenceTest, SaysUnitRangeDefaultAndMeaning) {
  EXPECT_THAT(ConfigReference(), HasSubstr("\n| `gate.timeout` | s | 0.001 to 3600 | `0.2` | "
                                           "Simulated time without a taken command"));
  EXPECT_THAT(ConfigReference(),
              HasSubstr("\n| `guard.on_stranger` |  | silence, warn, stop | `silence` | "));
}

TEST(ConfigReferenceTest, NamesElementsOfLists) {
  EXPECT_THAT(ConfigKeys(), Contains("robot.motors[].torque_limit"));
  EXPECT_THAT(ConfigReference(), HasSubstr("\n## robot.motors[]\n"));
}

TEST(ConfigReferenceTest, MentionsTheShortFormOfTheGate) {
  EXPECT_THAT(ConfigReference(), HasSubstr("`gate: WORD` is short for `gate.mode`"));
}

TEST(ConfigReferenceTest, KnowsTheWordsThatAKeyTakes) {
  EXPECT_THAT(WordsOfKey("gate.mode"), ElementsAre("strict", "lenient"));
  EXPECT_THAT(WordsOfKey("motion.fight"), ElementsAre("false", "true"));
  EXPECT_THAT(WordsOfKey("robot.dynamics.use"), ElementsAre("catalogue", "fitted"));
  for (const char* key : {"gate.timeout", "robot.model", "gate", "none"}) {
    EXPECT_THAT(WordsOfKey(key), IsEmpty()) << key;
  }
}

TEST(ConfigReferenceTest, HasFiveCellsInEachRow) {
  std::string line;
  std::istringstream lines(ConfigReference());
  while (std::getline(lines, line)) {
    if (line.empty() || line[0] != '|') continue;
    EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 6) << line;
  }
}

}  // namespace
}  // namespace understudy::config
