#include "drive/stiction.h"

#include <gtest/gtest.h>

namespace understudy::drive {
namespace {

constexpr double kQuarter = 0.25;  // s

class StictionTest : public testing::Test {
 protected:
  // Whether the joint sticks after `seconds` at `rate`.
  bool After(double seconds, double rate, bool driven = false) {
    bool sticks = false;
    for (double t = 0; t < seconds; t += kQuarter)
      sticks = stiction_.Step(1, driven, rate, kQuarter);
    return sticks;
  }

  Stiction stiction_{2};
};

TEST_F(StictionTest, AJointSticksAfterASecondAtRest) {
  EXPECT_FALSE(After(Stiction::kAfter - kQuarter, 0.005));
  EXPECT_TRUE(After(kQuarter, -0.005));
  EXPECT_FALSE(stiction_.Step(0, false, 0, kQuarter)) << "each by itself";
}

TEST_F(StictionTest, AJointThatCreepsBeginsAnew) {
  After(Stiction::kAfter - kQuarter, 0);
  EXPECT_FALSE(After(kQuarter, 0.02));
  EXPECT_FALSE(After(Stiction::kAfter - kQuarter, 0));
  EXPECT_TRUE(After(kQuarter, 0));
}

TEST_F(StictionTest, AJointThatSticksBreaksLooseOnceItTurns) {
  EXPECT_TRUE(After(Stiction::kAfter, 0));
  EXPECT_TRUE(After(kQuarter, 0.04));
  EXPECT_FALSE(After(kQuarter, -0.06));
}

TEST_F(StictionTest, AJointThatIsDrivenDoesNotStick) {
  EXPECT_TRUE(After(Stiction::kAfter, 0));
  EXPECT_FALSE(After(kQuarter, 0, true));
  EXPECT_FALSE(After(Stiction::kAfter, 0, true));
  EXPECT_TRUE(After(Stiction::kAfter, 0));
}

}  // namespace
}  // namespace understudy::drive
