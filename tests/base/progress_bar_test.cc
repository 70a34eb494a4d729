#include "base/progress_bar.h"

#include "gtest/gtest.h"

namespace understudy {
namespace {

TEST(ProgressBarTest, SaysHowFarAndHowLongStill) {
  EXPECT_EQ(ProgressText("a.mp4", 2.5, 10, 4),
            "a.mp4 [#####---------------]  25 %  2.5 of 10.0 s, 12 s to go");
}

TEST(ProgressBarTest, SaysNothingOfTheRestBeforeItCanTell) {
  EXPECT_EQ(ProgressText("a.mp4", 0, 10, 4), "a.mp4 [--------------------]   0 %  0.0 of 10.0 s");
  EXPECT_EQ(ProgressText("a.mp4", 5, 10, 0.1), "a.mp4 [##########----------]  50 %  5.0 of 10.0 s");
}

TEST(ProgressBarTest, OfStepsOfWhichThereMayBeFewerTheRestIsTheMost) {
  EXPECT_EQ(ProgressText("fit", 5, 20, 4, ProgressOf::kSteps),
            "fit [#####---------------]  25 %  step 5 of at most 20, at most 12 s to go");
}

TEST(ProgressBarTest, EndsFull) {
  EXPECT_EQ(ProgressText("a.mp4", 11, 10, 0), "a.mp4 [####################] 100 %  11.0 of 10.0 s");
}

}  // namespace
}  // namespace understudy
