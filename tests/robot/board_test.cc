#include "robot/board.h"

#include <vector>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

RobotSpec WithFans() {
  RobotSpec spec;
  spec.thermal.ambient_c = 25;
  spec.board = {.centre_rise_c = 20, .charger_rise_c = 16, .still_air = 1.5, .time_constant = 10};
  spec.fans = {{.name = "left", .place = 0, .rpm = 100},
               {.name = "front", .place = 2, .rpm = 200, .stall_bit = 4}};
  return spec;
}

class BoardTest : public testing::Test {
 protected:
  void Go(double seconds, const std::vector<FanEffects>& fans, const BoardEffects& fault = {}) {
    for (double t = 0; t < seconds; t += 0.01) board_.Step(0.01, fans, fault);
  }

  const std::vector<FanEffects> fine_{{}, {}};
  RobotSpec spec_ = WithFans();
  Board board_{spec_};
};

TEST_F(BoardTest, IsWarmFromTheStartAndSettled) {
  EXPECT_EQ(board_.reading().centre_c, 45);
  EXPECT_EQ(board_.reading().charger_c, 41);
  EXPECT_EQ(board_.reading().fan_rpm, (std::array<double, 3>{100, 0, 200}));
  EXPECT_TRUE(board_.settled());
}

TEST_F(BoardTest, GetsWarmerByTheShareOfFansThatStandStillInItsTime) {
  Go(10, {{}, {.share = 0}});
  EXPECT_NEAR(board_.reading().centre_c, 45 + 5 * 0.632, 0.05);
  Go(200, {{}, {.share = 0}});
  EXPECT_NEAR(board_.reading().centre_c, 50, 0.01);
  EXPECT_NEAR(board_.reading().charger_c, 45, 0.01);
  Go(200, {{.share = 0}, {.share = 0}});
  EXPECT_NEAR(board_.reading().centre_c, 55, 0.01);
}

TEST_F(BoardTest, CoolsDownAgainAndSettles) {
  Go(200, {{}, {.share = 0}});
  Go(1, fine_);
  EXPECT_FALSE(board_.settled());
  Go(200, fine_);
  EXPECT_TRUE(board_.settled());
  EXPECT_EQ(board_.reading().centre_c, 45);
}

TEST_F(BoardTest, TellsAFanStalledWhereItHasABitAndOnlyIfItStandsStill) {
  Go(0.1, {{.share = 0}, {.share = 0.5}});
  EXPECT_EQ(board_.reading().stalled, 0);
  EXPECT_EQ(board_.reading().fan_rpm, (std::array<double, 3>{0, 0, 100}));
  Go(0.1, {{}, {.share = 0}});
  EXPECT_EQ(board_.reading().stalled, 4);
}

TEST_F(BoardTest, TellsWhatItToldWhileItsControllerIsMute) {
  Go(100, {{.share = 0}, {.share = 0}}, {.mute = true});
  EXPECT_EQ(board_.reading().centre_c, 45);
  EXPECT_EQ(board_.reading().stalled, 0);
  EXPECT_TRUE(board_.reading().mute);
  Go(0.01, {{.share = 0}, {.share = 0}});
  EXPECT_NEAR(board_.reading().centre_c, 55, 0.1);
  EXPECT_FALSE(board_.reading().mute);
}

TEST_F(BoardTest, IsHotterByWhatAFaultAdds) {
  Go(0.01, fine_, {.heat_c = 30});
  EXPECT_EQ(board_.reading().centre_c, 75);
  EXPECT_FALSE(board_.settled());
}

}  // namespace
}  // namespace understudy::robot
