#include "emulator/frame_board.h"

#include "emulator/refusal_log.h"
#include "gtest/gtest.h"
#include "tests/support/control.h"

namespace understudy::emulator {
namespace {

TEST(FrameBoardTest, NothingIsWantedUntilSomebodyAsks) {
  FrameBoard dut{Frame{}};
  EXPECT_EQ(dut.Wanted(), nullptr);
  EXPECT_EQ(dut.Shown(), nullptr);
}

TEST(FrameBoardTest, TheFrameGoesToTheTickAndBack) {
  FrameBoard dut{Frame{}};
  dut.Ask(kPartCom);
  Frame* frame = dut.Wanted();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->parts, kPartCom);
  EXPECT_EQ(dut.Shown(), nullptr);
  frame->step = 3;
  dut.Show();
  EXPECT_EQ(dut.Wanted(), nullptr);
  ASSERT_NE(dut.Shown(), nullptr);
  EXPECT_EQ(dut.Shown()->step, 3);
  dut.Leave();
  EXPECT_EQ(dut.Wanted(), nullptr);
  EXPECT_EQ(dut.Shown(), nullptr);
}

TEST(FrameBoardTest, IsSafeBetweenTwoThreads) {
  FrameBoard dut{Frame{}};
  const test::Showing tick(&dut);
  for (std::int64_t i = 1; i <= 100; ++i) {
    dut.Ask(kAllFrameParts);
    ASSERT_TRUE(test::Eventually([&] { return dut.Shown() != nullptr; }));
    EXPECT_EQ(dut.Shown()->step, i);
    dut.Leave();
  }
}

TEST(RefusalLogTest, CountsWhatRepeatsAndKeepsTheNewest) {
  RefusalLog dut;
  std::vector<RefusedCommands> kept;
  dut.CopyTo(&kept);
  EXPECT_TRUE(kept.empty());
  dut.Add(robot::kLowCmdTopic, robot::Refusal::kNone, 1);
  dut.CopyTo(&kept);
  EXPECT_TRUE(kept.empty());
  dut.Add(robot::kLowCmdTopic, robot::Refusal::kCrc, 1);
  dut.Add(robot::kLowCmdTopic, robot::Refusal::kCrc, 2);
  dut.Add(robot::kLowCmdTopic, robot::Refusal::kGain, 3);
  dut.Add(robot::kFirstHandTopic, robot::Refusal::kGain, 4);
  dut.CopyTo(&kept);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].first, 1);
  EXPECT_EQ(kept[0].last, 2);
  EXPECT_EQ(kept[0].count, 2u);
  EXPECT_EQ(kept[2].topic, robot::kFirstHandTopic);
  for (int i = 0; i < 1000; ++i)
    dut.Add(static_cast<std::size_t>(i % 2), robot::Refusal::kCrc, 5 + i);
  dut.CopyTo(&kept);
  ASSERT_EQ(kept.size(), kMostFrameRefusals);
  EXPECT_EQ(kept.front().first, 5 + 1000 - static_cast<double>(kMostFrameRefusals));
  EXPECT_EQ(kept.back().first, 5 + 999);
}

}  // namespace
}  // namespace understudy::emulator
