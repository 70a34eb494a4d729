#include "robot/nearest_word.h"

#include <gtest/gtest.h>

namespace understudy {
namespace {

TEST(EditDistanceTest, CountsInsertionsDeletionsAndReplacements) {
  EXPECT_EQ(EditDistance("knee", "knee"), 0U);
  EXPECT_EQ(EditDistance("knee", "kneee"), 1U);
  EXPECT_EQ(EditDistance("knee", "nee"), 1U);
  EXPECT_EQ(EditDistance("knee", "kneo"), 1U);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3U);
}

TEST(EditDistanceTest, IsTheLengthOfTheOtherForAnEmptyWord) {
  EXPECT_EQ(EditDistance("", "knee"), 4U);
  EXPECT_EQ(EditDistance("knee", ""), 4U);
  EXPECT_EQ(EditDistance("", ""), 0U);
}

TEST(NearestWordTest, FindsTheWordThatWasMeant) {
  EXPECT_EQ(NearestWord("FL_calf_jiont", {"FR_hip_joint", "FL_calf_joint", "RL_calf_joint"}),
            "FL_calf_joint");
}

TEST(NearestWordTest, TakesTheFirstOfEquallyNearWords) {
  EXPECT_EQ(NearestWord("ax", {"bx", "cx"}), "bx");
}

TEST(NearestWordTest, IsEmptyWithoutValidWords) { EXPECT_EQ(NearestWord("knee", {}), ""); }

}  // namespace
}  // namespace understudy
