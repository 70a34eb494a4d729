#include "server/event_history.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robot/refusal.h"

namespace understudy::server {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

class EventHistoryTest : public testing::Test {
 protected:
  void Refuse(robot::Refusal why, std::string_view topic) {
    ring_.Add(emulator::EventKind::kRefused, 0, {static_cast<double>(why)}, topic);
  }

  emulator::EventRing ring_;
  EventHistory dut_{&ring_};
};

TEST_F(EventHistoryTest, TellsWhatHappenedOldestFirst) {
  ring_.SetStep(20, 0.02);
  Refuse(robot::Refusal::kCrc, "rt/lowcmd");
  ring_.SetStep(21, 0.021);
  Refuse(robot::Refusal::kMotorMode, "rt/dex3/left/cmd");
  dut_.Update(milliseconds(0));
  const json events = EventsJson(dut_)["events"];
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0]["number"], 0);
  EXPECT_EQ(events[0]["step"], 20);
  EXPECT_EQ(events[0]["time"], 0.02);
  EXPECT_EQ(events[0]["kind"], "refused");
  EXPECT_EQ(events[0]["level"], "warning");
  EXPECT_EQ(events[0]["detail"], json({{"count", 1}, {"reason", "crc"}, {"topic", "rt/lowcmd"}}));
  EXPECT_EQ(events[1]["detail"]["topic"], "rt/dex3/left/cmd");
  EXPECT_NE(events[0]["text"], events[1]["text"]);
}

TEST_F(EventHistoryTest, TellsOfABurstOnceASecondAndCountsAll) {
  for (int ms = 0; ms <= 1000; ms += 10) {
    for (int i = 0; i < 5; ++i) Refuse(robot::Refusal::kCrc, "rt/lowcmd");
    dut_.Update(milliseconds(ms));
  }
  const json events = EventsJson(dut_)["events"];
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0]["detail"]["count"], 1);
  EXPECT_EQ(events[1]["number"], 1);
  EXPECT_EQ(dut_.counts()[static_cast<std::size_t>(emulator::EventKind::kRefused)], 505U);
}

TEST_F(EventHistoryTest, KeepsTheNewest) {
  for (std::size_t i = 0; i < EventHistory::kMost + 3; ++i) ring_.Add(emulator::EventKind::kClamp);
  dut_.Update(milliseconds(0));
  EXPECT_EQ(dut_.newest().size(), EventHistory::kMost);
  EXPECT_EQ(dut_.newest().front().number, 3U);
}

TEST(EventHistoryOfNothingTest, IsEmpty) {
  EventHistory dut;
  dut.Update(milliseconds(0));
  EXPECT_EQ(EventsJson(dut).dump(), R"({"events":[]})");
}

}  // namespace
}  // namespace understudy::server
