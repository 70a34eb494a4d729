#include "run/reporter.h"

#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include "robot/refusal.h"

namespace understudy::run {
namespace {

using emulator::EventKind;
using std::chrono::milliseconds;
using testing::HasSubstr;

class ReporterTest : public testing::Test {
 protected:
  ReporterTest() : before_(spdlog::default_logger()) {
    auto log = std::make_shared<spdlog::logger>(
        "", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_));
    log->set_pattern("%l: %v");
    spdlog::set_default_logger(log);
  }
  ~ReporterTest() override { spdlog::set_default_logger(before_); }

  void Refuse(robot::Refusal why) {
    ring_.Add(EventKind::kRefused, 0, {static_cast<double>(why)}, "rt/lowcmd");
  }
  // Lines since the last call.
  std::string Said() {
    const std::string said = log_.str();
    log_.str("");
    return said;
  }

  emulator::EventRing ring_;
  std::ostringstream log_;
  std::shared_ptr<spdlog::logger> before_;
};

TEST_F(ReporterTest, LogsEventsAtTheirLevelButForSilentOnes) {
  Reporter dut(&ring_, 500, false);
  ring_.Add(EventKind::kClamp, 0, {1});
  ring_.Add(EventKind::kSpeed, 0, {2});
  ring_.Add(EventKind::kDivergence);
  dut.Update({}, milliseconds(0));
  EXPECT_EQ(Said(), "info: speed 2\nerror: the physics diverged at 0.000 s\n");
}

TEST_F(ReporterTest, SaysEachCauseAtMostOnceASecond) {
  Reporter dut(&ring_, 500, false);
  Refuse(robot::Refusal::kCrc);
  dut.Update({}, milliseconds(0));
  EXPECT_THAT(Said(), HasSubstr("warning: refused 1 LowCmd (crc): "));
  for (int ms = 20; ms < 1000; ms += 20) {
    Refuse(robot::Refusal::kCrc);
    dut.Update({}, milliseconds(ms));
  }
  EXPECT_EQ(Said(), "");
  dut.Update({}, milliseconds(1000));
  EXPECT_THAT(Said(), HasSubstr("warning: refused 49 LowCmd (crc): "));
}

TEST_F(ReporterTest, SaysEverLessOftenWhatIsRefusedOnAndOn) {
  Reporter dut(&ring_, 500, false);
  int lines = 0;
  const auto lasts = [&](int from, int to) {  // ms
    for (int ms = from; ms < to; ms += 20) {
      Refuse(robot::Refusal::kCrc);
      dut.Update({}, milliseconds(ms));
      lines += Said().empty() ? 0 : 1;
    }
  };
  lasts(0, 60'000);
  EXPECT_EQ(lines, 9) << "at 0, 1, 3, 7, 15, 25 s ...";
  dut.Update({}, milliseconds(80'000));
  Said();
  lines = 0;
  lasts(100'000, 102'000);
  EXPECT_EQ(lines, 2) << "after a pause at once, and after a second";
}

TEST_F(ReporterTest, SaysThatTheMachineIsTooSlowAtOnceAndThenOnceAMinute) {
  Reporter dut(&ring_, 500, false);
  std::string said;
  for (int ms = 0; ms < 125'000; ms += 20) {
    for (int i = 0; i < 5; ++i) ring_.Add(EventKind::kOverrun, 0, {ms == 30'000 ? 0.05 : 0.004});
    if (ms % 1000 == 0) ring_.Add(EventKind::kStall, 0, {0.25});
    dut.Update({}, milliseconds(ms));
    const std::string now = Said();
    const bool quiet = (ms >= 2000 && ms < 60'000) || (ms >= 62'000 && ms < 120'000);
    EXPECT_TRUE(!quiet || now.empty()) << ms << ": " << now;
    said += now;
  }
  EXPECT_THAT(said, HasSubstr("250 ticks began late, the worst by 4.0 ms"));
  EXPECT_THAT(said, HasSubstr("15000 ticks began late, the worst by 50.0 ms"));
  EXPECT_THAT(said, HasSubstr("0.2 s behind wall time"));
  EXPECT_THAT(said, HasSubstr("15.0 s behind wall time"));
}

TEST_F(ReporterTest, SaysEachTimeThatTheMachineStoodStill) {
  Reporter dut(&ring_, 500, false);
  for (int ms = 0; ms < 10'000; ms += 2000) {
    ring_.Add(EventKind::kStall, 0, {1.5});
    dut.Update({}, milliseconds(ms));
    EXPECT_THAT(Said(), HasSubstr("1.5 s behind wall time"));
  }
}

TEST_F(ReporterTest, SaysNothingOfAFewLateTicksEachSecond) {
  Reporter dut(&ring_, 500, false);
  for (int ms = 0; ms < 125'000; ms += 100) {
    ring_.Add(EventKind::kOverrun, 0, {0.004});
    dut.Update({}, milliseconds(ms));
  }
  EXPECT_EQ(Said(), "");
}

TEST_F(ReporterTest, SaysTheLastRefusalOfARun) {
  {
    Reporter dut(&ring_, 500, false);
    Refuse(robot::Refusal::kCrc);
    dut.Update({}, milliseconds(0));
    Said();
    Refuse(robot::Refusal::kCrc);  // held back
    dut.Update({}, milliseconds(20));
    Refuse(robot::Refusal::kGain);  // after the last update
    EXPECT_EQ(Said(), "");
  }
  const std::string said = Said();
  EXPECT_THAT(said, HasSubstr("refused 1 LowCmd (crc)"));
  EXPECT_THAT(said, HasSubstr("refused 1 LowCmd (gain)"));
}

}  // namespace
}  // namespace understudy::run
