#include "ctl/status_screen.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "server/status_json.h"

namespace understudy::ctl {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::StartsWith;

nlohmann::ordered_json Json(const emulator::Status& status) {
  return server::StatusJson({.robot = "g1", .version = "", .pid = 42}, status);
}

emulator::Status Running() {
  emulator::Status status;
  status.loop.ready = true;
  status.time = 12.5;
  status.steps = 12'500;
  status.loop.pace.real_time_factor = 0.75;
  status.commands.refused = {0, 2, 0, 0, 0, 0, 0, 0, 1};
  return status;
}

TEST(StatusScreenTest, FirstShowsTotalsAndThenRatesBetweenTwo) {
  StatusScreen dut;
  emulator::Status status = Running();
  EXPECT_THAT(dut.Text(Json(status), milliseconds(1000)),
              AllOf(StartsWith("g1, process 42: ready\n12.500 s, 0.75 x real time of 1.000\n"),
                    HasSubstr("steps              -           12500")));
  status.steps += 375;
  status.commands.refused[1] += 50;
  EXPECT_THAT(dut.Text(Json(status), milliseconds(1500)),
              AllOf(HasSubstr("steps              750         12875"),
                    HasSubstr("commands refused   100         53     crc 52, gain 1")));
}

TEST(StatusScreenTest, SaysThatTheRobotIsPaused) {
  StatusScreen dut;
  emulator::Status status = Running();
  status.paused = true;
  EXPECT_THAT(dut.Text(Json(status), milliseconds(1)), HasSubstr("12.500 s, paused\n"));
  status.steps_left = 7;
  EXPECT_THAT(dut.Text(Json(status), milliseconds(2)), HasSubstr("paused, 7 steps to make\n"));
}

TEST(StatusScreenTest, ShowsTheForceOnEachHand) {
  StatusScreen dut;
  emulator::Status status = Running();
  emulator::CopyText("left", &status.hand_forces[0].name);
  status.hand_forces[0].force = 12.25;
  EXPECT_THAT(dut.Text(Json(status), milliseconds(1)), HasSubstr("left hand force  12.2 N\n"));
}

TEST(StatusScreenTest, ANumberThatIsNotFiniteIsADash) {
  StatusScreen dut;
  nlohmann::ordered_json status = Json(Running());
  status["base"]["tilt"] = nullptr;
  EXPECT_THAT(dut.Text(status, milliseconds(1)), HasSubstr("tilted by - rad"));
}

TEST(StatusScreenTest, AStatusOfAnotherShapeThrows) {
  StatusScreen dut;
  EXPECT_THROW(dut.Text({{"robot", "g1"}}, milliseconds(1)), nlohmann::json::exception);
}

TEST(OverTheScreenTest, ClearsWhatWasThereBeyondEachLineAndBelowTheLast) {
  EXPECT_EQ(OverTheScreen("a\nb\n"), "\033[Ha\033[K\nb\033[K\n\033[J");
}

}  // namespace
}  // namespace understudy::ctl
