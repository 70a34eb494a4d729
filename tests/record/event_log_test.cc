#include "record/event_log.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "tests/support/requests.h"

namespace understudy::record {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class EventLogTest : public testing::Test {
 protected:
  // Kind and text of each event of a status 2 ms after the one before.
  std::vector<std::string> Next() {
    status_.time += 0.002;
    std::vector<std::string> told;
    for (const Event& event : log_.Compare(status_, ++step_)) {
      told.push_back(event.kind + ": " + event.text);
      last_ = event;
    }
    return told;
  }
  std::uint64_t& refused(robot::Refusal why) {
    return status_.commands.refused[static_cast<std::size_t>(why)];
  }

  EventLog log_{{"a.yaml:1", "a.yaml:2"}};
  emulator::Status status_;
  std::int64_t step_ = 0;
  Event last_;
};

TEST_F(EventLogTest, BeginsWithWhoMovesTheMotors) {
  EXPECT_THAT(Next(), ElementsAre("motion_service: no motion service", "gate: start"));
  EXPECT_THAT(Next(), IsEmpty());
}

TEST_F(EventLogTest, TellsOfAMotionServiceAndTheGate) {
  Next();
  std::ranges::copy(std::string_view("mcf"), status_.motion_service.begin());
  status_.gate = authority::GateState::kClosed;
  EXPECT_THAT(Next(), ElementsAre("motion_service: motion service mcf", "gate: motion_service"));
}

TEST_F(EventLogTest, TellsOfTheFirstRefusalAtOnceAndOfACrowdByItsCount) {
  Next();
  refused(robot::Refusal::kCrc) = 1;
  EXPECT_THAT(Next(), ElementsAre("refused: refused 1 LowCmd (crc)"));
  EXPECT_EQ(last_.step, step_);
  std::vector<std::string> told;
  for (int i = 0; i < 50; ++i) {
    ++refused(robot::Refusal::kCrc);
    std::ranges::move(Next(), std::back_inserter(told));
  }
  EXPECT_THAT(told, ElementsAre("refused: refused 50 LowCmd (crc)"));
  EXPECT_EQ(last_.detail, R"({"count":50,"reason":"crc","topic":"rt/lowcmd"})");
}

TEST_F(EventLogTest, TellsAtTheEndWhatItHeldBack) {
  Next();
  refused(robot::Refusal::kGain) = 1;
  Next();
  refused(robot::Refusal::kGain) = 4;
  EXPECT_THAT(Next(), IsEmpty());
  const std::vector<Event> rest = log_.Rest(step_);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].text, "refused 3 LowCmd (gain)");
}

TEST_F(EventLogTest, TellsOfWhatAScriptDid) {
  Next();
  status_.script_done = 2;
  EXPECT_THAT(Next(), ElementsAre("script: a.yaml:1", "script: a.yaml:2"));
}

TEST_F(EventLogTest, TellsOfWhatBefellTheRobot) {
  Next();
  status_.divergences = 1;
  status_.commands.timeouts = 1;
  status_.crane_attached = true;
  status_.clamped = true;
  status_.silenced = true;
  status_.remote.keys = 0x220;
  status_.pace.shifts = 1;
  EXPECT_THAT(
      Next(),
      ElementsAre("timeout: LowCmd stopped", "remote: L2+B", "divergence: the physics diverged",
                  "silence: silenced: another robot speaks", "crane: hangs from the crane",
                  "clamp: clamped", "stall: a stall that is not made up for"));
}

TEST_F(EventLogTest, NamesTheHandWhoseCommandIsRefused) {
  Next();
  std::ranges::copy(std::string_view("left"), status_.hands[0].name.begin());
  status_.hands[0].commands.refused[static_cast<std::size_t>(robot::Refusal::kMotorMode)] = 2;
  EXPECT_THAT(Next(), Contains("refused: refused 2 HandCmd to the left hand (motor_mode)"));
  EXPECT_EQ(last_.detail, R"({"count":2,"hand":"left","reason":"motor_mode"})");
}

TEST_F(EventLogTest, NamesTheTopicThatARefusedCommandCameBy) {
  Next();
  status_.arm_commands.refused[static_cast<std::size_t>(robot::Refusal::kNoMotionService)] = 1;
  status_.user_commands.timeouts = 1;
  EXPECT_THAT(Next(), ElementsAre("timeout: LowCmd of rt/user_lowcmd stopped",
                                  "refused: refused 1 LowCmd of rt/arm_sdk (no_motion_service)"));
}

TEST_F(EventLogTest, TellsOfRequests) {
  Next();
  const auto push =
      test::RequestOf("push", {{"body", "base"}, {"force", {0, 50, 0}}, {"for", 0.1}});
  status_.requests.Add({.time = 0.003, .request = push});
  status_.requests.Add({.time = 0.003, .request = test::RequestOf("step", 1)});
  EXPECT_THAT(Next(), ElementsAre("push: push base 0 50 0 N for 0.1 s", "step: step 1"));
  EXPECT_THAT(Next(), IsEmpty());
  status_.requests.Add({.time = 0.005, .request = test::RequestOf("reset", "lying")});
  EXPECT_THAT(Next(), ElementsAre("reset: reset lying"));
  EXPECT_EQ(last_.detail, R"({"pose":"lying","time":0.005})");
}

TEST_F(EventLogTest, CountsRequestsThatCameTooFastToBeKept) {
  Next();
  for (int i = 0; i < 10; ++i) {
    status_.requests.Add({.time = 0, .request = test::RequestOf("step", 1)});
  }
  const std::vector<std::string> told = Next();
  ASSERT_EQ(told.size(), 9U);
  EXPECT_EQ(told[0], "requests: 2 more requests");
  EXPECT_EQ(told[8], "step: step 1");
}

}  // namespace
}  // namespace understudy::record
