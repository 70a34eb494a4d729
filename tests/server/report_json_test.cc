#include "server/report_json.h"

#include "gtest/gtest.h"

namespace understudy::server {
namespace {

using nlohmann::json;

TEST(TimingsJsonTest, TellsWhatIsMeasured) {
  emulator::Status status;
  status.steps = 2;
  status.pace.overruns = 1;
  status.ticks.Add(15e-6);
  status.ticks.Add(1);
  const json timings = TimingsJson(status);
  EXPECT_EQ(timings["steps"], 2);
  EXPECT_EQ(timings["overruns"], 1);
  EXPECT_EQ(timings["tick"]["count"], 2);
  EXPECT_EQ(timings["tick"]["buckets"][2], json({{"le", 2e-5}, {"count", 1}}));
  EXPECT_EQ(timings["tick"]["buckets"].back(), json({{"count", 1}}));
  EXPECT_EQ(timings["late"]["count"], 0);
  EXPECT_EQ(timings["late"]["mean"], 0.0);
}

TEST(RefusalsJsonTest, SaysWhyAndWhatToDo) {
  emulator::Frame frame;
  frame.command_topics = {"rt/lowcmd", "", "", "rt/dex3/left/cmd"};
  frame.refusals = {{.first = 1, .last = 2, .reason = robot::Refusal::kCrc, .count = 500},
                    {.first = 3,
                     .last = 3,
                     .topic = robot::kFirstHandTopic,
                     .reason = robot::Refusal::kMotorMode,
                     .count = 1}};
  const json refusals = RefusalsJson(frame)["refusals"];
  ASSERT_EQ(refusals.size(), 2u);
  EXPECT_EQ(refusals[0]["time"], 2.0);
  EXPECT_EQ(refusals[0]["since"], 1.0);
  EXPECT_EQ(refusals[0]["count"], 500);
  EXPECT_EQ(refusals[0]["topic"], "rt/lowcmd");
  EXPECT_EQ(refusals[0]["reason"], "crc");
  EXPECT_EQ(refusals[1]["topic"], "rt/dex3/left/cmd");
  EXPECT_NE(refusals[0]["text"], refusals[1]["text"]);
  EXPECT_NE(refusals[1]["text"], "");
}

}  // namespace
}  // namespace understudy::server
