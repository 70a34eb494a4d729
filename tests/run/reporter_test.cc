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
