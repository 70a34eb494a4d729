#include "base/nearest_word.h"

#include <gtest/gtest.h>

namespace understudy {
namespace {

const std::vector<std::string> kWords{"mode", "timeout", "damping_kd"};

TEST(NearestWordTest, ForgivesALetterTooFewTooManyOrSwapped) {
  EXPECT_EQ(NearestWord("timout", kWords), "timeout");
  EXPECT_EQ(NearestWord("timeoutt", kWords), "timeout");
  EXPECT_EQ(NearestWord("tiemout", kWords), "timeout");
  EXPECT_EQ(NearestWord("mdoe", kWords), "mode");
}

TEST(NearestWordTest, ForgivesMoreOfAWordWhoseFirstLetterIsRight) {
  EXPECT_EQ(NearestWord("ruff", {"flat", "rough", "row"}), "rough");
  EXPECT_EQ(NearestWord("huff", {"flat", "rough", "row"}), "");
}

TEST(NearestWordTest, IgnoresLetterCase) { EXPECT_EQ(NearestWord("TIMEOUT", kWords), "timeout"); }

TEST(NearestWordTest, FindsNothingInWordsFarAway) {
  EXPECT_EQ(NearestWord("colour", kWords), "");
  EXPECT_EQ(NearestWord("", kWords), "");
  EXPECT_EQ(NearestWord("mode", {}), "");
  EXPECT_EQ(NearestWord(std::string(100000, 'x'), kWords), "");
}

TEST(NearestHintTest, AsksForTheNearestWordOrSaysNothing) {
  EXPECT_EQ(NearestHint("timout", kWords), "; did you mean 'timeout'?");
  EXPECT_EQ(NearestHint("colour", kWords), "");
}

TEST(DidYouMeanTest, ListsAllWords) {
  EXPECT_EQ(DidYouMean("timout", kWords),
            "; did you mean 'timeout'? (valid: mode, timeout, damping_kd)");
  EXPECT_EQ(DidYouMean("colour", kWords), "; valid: mode, timeout, damping_kd");
}

}  // namespace
}  // namespace understudy
