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

}  // namespace
}  // namespace understudy::server
