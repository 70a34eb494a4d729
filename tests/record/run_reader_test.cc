#include "record/run_reader.h"

#include <gmock/gmock.h>

#include "tests/record/runs.h"

namespace understudy::record {
namespace {

class RunReaderTest : public RunsTest {
 protected:
  BusySpan Busy(const MadeRun& run) { return BusySpanOf(McapReader(Make("run.mcap", run))); }
};

TEST_F(RunReaderTest, FindsNothingWhereNothingMoves) {
  EXPECT_TRUE(Busy({}).never);
  // It sways by less than counts.
  EXPECT_TRUE(Busy({.height = [](double t) { return 0.3 + 0.004 * std::sin(9 * t); },
                    .q = [](double t) { return 0.009 * std::sin(5 * t); }})
                  .never);
  EXPECT_NEAR(Busy({}).end, 10, 1e-6);
}

TEST_F(RunReaderTest, FindsTheFirstAndTheLastMovementOfBaseOrJoint) {
  const auto between = [](double from, double to, double way) {
    return [=](double t) { return way * std::min(std::max(t - from, 0.0) / (to - from), 1.0); };
  };
  const BusySpan base = Busy({.height = between(3, 4, 0.2)});
  EXPECT_NEAR(base.from, 3.06, 0.011);  // 0.01 of 0.2 m in a second
  EXPECT_NEAR(base.to, 4, 0.06);
  const BusySpan joint = Busy({.q = between(5, 7, 1)});
  EXPECT_NEAR(joint.from, 5.05, 0.011);
  EXPECT_NEAR(joint.to, 7, 0.06);
  const BusySpan both = Busy({.height = between(3, 4, 0.2), .q = between(5, 7, 1)});
  EXPECT_FALSE(both.never);
  EXPECT_EQ(both.from, base.from);
  EXPECT_EQ(both.to, joint.to);
}

TEST_F(RunReaderTest, FindsEventsButThoseOfTheBegin) {
  const RecordedEvent begins{.step = 0, .time = 0, .kind = "motion_service", .text = "mcf is on"};
  const RecordedEvent late{.step = 10, .time = 2, .kind = "overrun", .text = "late"};
  EXPECT_TRUE(Busy({.events = {begins, late}}).never);
  const BusySpan busy =
      Busy({.events = {begins, {.step = 600, .time = 6, .kind = "refused", .text = "crc"}}});
  EXPECT_FALSE(busy.never);
  EXPECT_NEAR(busy.from, 6, 1e-6);
  EXPECT_NEAR(busy.to, 6, 1e-6);
}

}  // namespace
}  // namespace understudy::record
