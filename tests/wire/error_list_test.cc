#include "wire/error_list.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/wire/robots.h"

namespace understudy::wire {
namespace {

class ErrorListTest : public testing::Test {
 protected:
  // The text that is sent at that time, "" for none.
  std::string Sent(std::int64_t tick_ms) {
    state_.tick_ms = tick_ms;
    return list_.Update(state_) ? list_.text() : "";
  }

  const robot::RobotSpec spec_ = GoRobot();  // motors in slots 1, 4, 19
  robot::RobotState state_ = StateOf(spec_);
  ErrorList list_{spec_};
};

TEST_F(ErrorListTest, IsNotSentWhileNothingIsWrong) {
  EXPECT_EQ(Sent(0), "");
  EXPECT_EQ(Sent(5000), "");
}

TEST_F(ErrorListTest, TellsEachBitOfEachMotorByItsSlot) {
  state_.motors[1].overheated = state_.motors[1].undervoltage = true;
  state_.motors[2].encoder_error = true;
  EXPECT_EQ(Sent(3200), R"({"errors":[[3,304,8],[3,304,16],[3,319,32]]})");
}

TEST_F(ErrorListTest, TellsFansAndTheBoardAndMotorsThatDoNotAnswer) {
  state_.motors[0].silent = state_.board.mute = true;
  state_.board.stalled = 6;
  EXPECT_EQ(Sent(0), R"({"errors":[[0,100,64],[0,100,128],[0,200,2],[0,200,4],[0,301,256]]})");
}

TEST_F(ErrorListTest, TellsTheMotionServicesProtectionFromHeatAndLowCharge) {
  using robot::Danger;
  state_.motion.emplace();
  auto& dangers = state_.motion->dangers;
  dangers[static_cast<std::size_t>(Danger::kTilt)].does = robot::Protection::kDamp;
  EXPECT_EQ(Sent(0), "");
  dangers[static_cast<std::size_t>(Danger::kCharge)].does = robot::Protection::kStop;
  EXPECT_EQ(Sent(10), R"({"errors":[[0,600,8]]})");
  dangers[static_cast<std::size_t>(Danger::kHeat)].does = robot::Protection::kLieDown;
  EXPECT_EQ(Sent(20), R"({"errors":[[0,600,4],[0,600,8]]})");
}

TEST_F(ErrorListTest, IsSentWhenItChangesAndOnceASecondUntilItIsEmpty) {
  state_.board.stalled = 4;
  EXPECT_EQ(Sent(1500), R"({"errors":[[1,200,4]]})");
  EXPECT_EQ(Sent(2499), "");
  EXPECT_EQ(Sent(2500), R"({"errors":[[1,200,4]]})");
  state_.motors[0].overheated = true;
  EXPECT_EQ(Sent(3100), R"({"errors":[[1,200,4],[3,301,16]]})");
  state_.motors[0].overheated = false;
  state_.board.stalled = 0;
  EXPECT_EQ(Sent(3200), R"({"errors":[]})");
  EXPECT_EQ(Sent(9000), "");
}

}  // namespace
}  // namespace understudy::wire
