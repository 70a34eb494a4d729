#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "authority/unheeded.h"
#include "emulator/told_event.h"
#include "robot/refusal.h"
#include "services/service_port.h"
#include "tests/support/requests.h"

namespace understudy::emulator {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Event Made(EventKind kind, const std::array<double, 4>& numbers = {}, std::string_view text = {},
           double time = 0) {
  Event event{.time = time, .kind = kind, .numbers = numbers};
  CopyText(text, &event.text);
  return event;
}

Event Refused(robot::Refusal why, std::string_view topic = "rt/lowcmd") {
  return Made(EventKind::kRefused, {static_cast<double>(why)}, topic);
}

std::string Said(const Event& event) { return ToldEvent{.event = event}.text(); }
std::string Detail(const Event& event) { return ToldEvent{.event = event}.detail().dump(); }

TEST(EventTableTest, NamesEachKindOnceAndSaysWhenItHappens) {
  std::set<std::string_view> names;
  for (const EventRow& row : EventTable()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.when.empty()) << row.name;
    EXPECT_FALSE(row.say(Event{.kind = row.kind}, 1).empty() && row.name != "script" &&
                 row.kind != EventKind::kRequest)
        << row.name;
  }
}

TEST(EventTableTest, StandsInTheDocumentOfRecordings) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/recording.md");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  for (const EventRow& row : EventTable()) {
    std::string fields;
    for (const EventField& field : row.fields) {
      if (field.name.empty()) break;
      fields += (fields.empty() ? "`" : ", `") + std::string(field.name) + "`";
    }
    if (row.pace != EventPace::kEach) fields += fields.empty() ? "`count`" : ", `count`";
    EXPECT_THAT(text, testing::HasSubstr("| `" + std::string(row.name) + "` | " +
                                         std::string(row.when) + " | " + fields + " |\n"));
  }
}

TEST(EventTableTest, HasRoomForTheNumbersOfEachRow) {
  for (const EventRow& row : EventTable()) {
    std::size_t numbers = 0;
    for (const EventField& field : row.fields) {
      if (field.name.empty() || field.type == EventFieldType::kText) continue;
      ++numbers;
    }
    EXPECT_LE(numbers, Event{}.numbers.size()) << row.name;
  }
}

TEST(EventTableTest, TellsARequestUnderItsOwnName) {
  const ToldEvent told{.event = {.kind = EventKind::kRequest,
                                 .request = test::RequestOf(
                                     "push", {{"body", "base"}, {"force", {0, -50, 0.125}}})}};
  EXPECT_EQ(told.kind(), "push");
  EXPECT_EQ(told.text(), Describe(told.event.request));
  EXPECT_EQ(told.detail()["body"], "base");
  EXPECT_EQ(told.detail()["force"], nlohmann::json({0, -50, 0.125}));
}

TEST(EventTableTest, SaysWhatBefellTheRobot) {
  EXPECT_EQ(Said(Made(EventKind::kMotionService)),
            "no motion service is on: motors follow rt/lowcmd");
  EXPECT_EQ(Said(Made(EventKind::kMotionService, {}, "mcf")),
            "motion service mcf moves the motors");
  EXPECT_EQ(Said(Made(EventKind::kGate, {1})), "gate: following");
  EXPECT_EQ(Detail(Made(EventKind::kGate, {4})), R"({"state":"motion_service"})");
  EXPECT_EQ(Said(Made(EventKind::kRemote, {0x220})), "L2+B");
  EXPECT_EQ(Said(Made(EventKind::kMotion, {1004, 5}, "lying")), "lying (1004)");
  EXPECT_EQ(Detail(Made(EventKind::kMotion, {1004, 5}, "lying")),
            R"({"mode":5,"name":"lying","state":1004})");
  EXPECT_EQ(Said(Made(EventKind::kTimeout, {}, "rt/lowcmd")),
            "LowCmd stopped: motors are damping until the next one");
  EXPECT_EQ(Said(Made(EventKind::kTimeout, {}, "rt/user_lowcmd")),
            "LowCmd of rt/user_lowcmd stopped: motors are damping until the next one");
  EXPECT_EQ(Said(Made(EventKind::kTimeout, {}, "rt/dex3/left/cmd")),
            "HandCmd of rt/dex3/left/cmd stopped: watched motors lock until the next one");
  EXPECT_EQ(Said(Made(EventKind::kDivergence, {}, "", 1.25)), "the physics diverged at 1.250 s");
  EXPECT_EQ(Said(Made(EventKind::kSpeed, {0})), "speed as fast as possible");
  EXPECT_EQ(Said(Made(EventKind::kSpeed, {2.5})), "speed 2.5");
}

TEST(EventTableTest, SaysWhatAProgramWaitsForInVainAndWhoWouldServeIt) {
  EXPECT_EQ(Said(Made(EventKind::kUnserved, {1, 12}, "rt/utlidar/cloud")),
            "process 12 waits for rt/utlidar/cloud, which nobody here sends; it would come from "
            "the lidar of a Go2; what of it is simulated is in docs/seeing.md");
  EXPECT_EQ(Said(Made(EventKind::kUnserved, {0, 0}, "rt/dex1/left/cmd")),
            "a program writes rt/dex1/left/cmd, which nobody here reads; it is for "
            "a robot with Dex1-1 grippers, as `understudy run g1 --hands dex1`");
  EXPECT_EQ(Detail(Made(EventKind::kUnserved, {1, 12}, "rt/gnss")),
            R"({"process":12,"reads":true,"topic":"rt/gnss"})");
}

TEST(EventTableTest, NamesTheRemedyForAnotherCyclone) {
  EXPECT_THAT(Said(Made(EventKind::kUnmatched, {},
                        "rt/lowcmd by process 12 (python3): another definition of X")),
              testing::HasSubstr("`pip install cyclonedds==0.10.2`"));
  EXPECT_THAT(Said(Made(EventKind::kUnmatched, {}, "rt/lowcmd by process 12 (python3): type Y")),
              testing::Not(testing::HasSubstr("pip")));
}

TEST(EventTableTest, SaysWhyTheRemoteControllerMovesNothing) {
  constexpr double kR2A = 0x110;
  const auto unheeded = [](authority::Unheeded::Reason reason, double keys, double wish,
                           std::string_view name) {
    return Made(EventKind::kUnheeded, {static_cast<double>(reason), keys, wish, 4}, name);
  };
  using enum authority::Unheeded::Reason;
  EXPECT_EQ(Said(unheeded(kNotSimulated, kR2A, 801, "ready")),
            "R2+A asks for state 801 of the real robot, which is not modelled: the robot stays in "
            "ready (4)");
  EXPECT_EQ(Said(unheeded(kNotSimulated, kR2A, -1, "ready")),
            "R2+A asks for a motion, which is not modelled: the robot stays in ready (4)");
  EXPECT_EQ(
      Said(unheeded(kNotSimulated, 0, -1, "ready")),
      "the sticks ask the robot to walk, which is not modelled: the robot stays in ready (4)");
  EXPECT_EQ(Said(unheeded(kState, kR2A, -1, "ready")), "R2+A has no effect in ready (4)");
  EXPECT_EQ(Said(unheeded(kState, 0, -1, "ready")), "the sticks have no effect in ready (4)");
  EXPECT_EQ(
      Said(unheeded(kNoMotionService, kR2A, -1, "ai")),
      "R2+A: no motion service is on that could obey; `understudy ctl service call motion_switcher "
      "1002 '{\"name\": \"ai\"}'` switches it on");
  EXPECT_EQ(Detail(unheeded(kState, kR2A, -1, "ready")),
            R"({"keys":"R2+A","name":"ready","reason":"state","state":4,"wish":-1})");
}

TEST(EventTableTest, NamesTopicAndReasonOfARefusal) {
  const Event arms = Refused(robot::Refusal::kNoMotionService, "rt/arm_sdk");
  EXPECT_THAT(Said(arms),
              testing::StartsWith("refused 1 LowCmd of rt/arm_sdk (no_motion_service)"));
  const Event hand = Refused(robot::Refusal::kMotorMode, "rt/dex3/left/cmd");
  EXPECT_THAT(Said(hand),
              testing::StartsWith("refused 1 HandCmd of rt/dex3/left/cmd (motor_mode)"));
  EXPECT_EQ(Detail(hand), R"({"count":1,"reason":"motor_mode","topic":"rt/dex3/left/cmd"})");
}

TEST(EventDigestTest, TellsTheFirstAtOnceAndOfABurstItsCount) {
  EventDigest digest(0.1);
  EXPECT_EQ(digest.Take(Refused(robot::Refusal::kCrc), 1.0)->count, 1U);
  for (int i = 0; i < 40; ++i) {
    EXPECT_FALSE(digest.Take(Refused(robot::Refusal::kCrc), 1.0 + 0.002 * i));
  }
  EXPECT_THAT(digest.Due(1.09), IsEmpty());
  const std::vector<ToldEvent> due = digest.Due(1.1);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].detail().dump(), R"({"count":40,"reason":"crc","topic":"rt/lowcmd"})");
  EXPECT_THAT(digest.Due(9), IsEmpty());
}

TEST(EventDigestTest, TellsFewOfTheIdsThatAClientTries) {
  EventDigest digest(1);
  std::size_t told = 0;
  for (int i = 0; i < 200; ++i) {
    const Event event =
        Made(EventKind::kCallRefused, {static_cast<double>(services::CallRefusal::kUnknownApi)},
             "sport " + std::to_string(i));
    if (digest.Take(event, 0.001 * i)) ++told;
  }
  EXPECT_EQ(told, 8U);
}

TEST(EventDigestTest, KeepsCausesApart) {
  EventDigest digest(1);
  EXPECT_TRUE(digest.Take(Refused(robot::Refusal::kCrc), 0));
  EXPECT_TRUE(digest.Take(Refused(robot::Refusal::kGain), 0));
  EXPECT_TRUE(digest.Take(Refused(robot::Refusal::kCrc, "rt/arm_sdk"), 0));
  Event of_another = Refused(robot::Refusal::kCrc);
  of_another.robot = 1;
  EXPECT_TRUE(digest.Take(of_another, 0));
  EXPECT_FALSE(digest.Take(Refused(robot::Refusal::kGain), 0.5));
}

TEST(EventDigestTest, TellsInTheEndWhatItHeldBack) {
  EventDigest digest(1);
  digest.Take(Refused(robot::Refusal::kGain), 0);
  for (int i = 0; i < 3; ++i) digest.Take(Refused(robot::Refusal::kGain), 0.1);
  const std::vector<ToldEvent> rest = digest.Flush();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_THAT(rest[0].text(), testing::StartsWith("refused 3 LowCmd (gain)"));
}

TEST(EventDigestTest, HoldsBackNothingThatComesAlone) {
  EventDigest digest(1);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(digest.Take(Made(EventKind::kClamp), 0));
}

TEST(EventDigestTest, TellsNoMoreCausesApartThanItHasRoomFor) {
  EventDigest digest(1);
  std::size_t told = 0;
  for (int api = 0; api < 5000; ++api) {
    if (digest.Take(Made(EventKind::kCall, {static_cast<double>(api)}), 0)) ++told;
  }
  EXPECT_EQ(told, EventDigest::kMostCauses);
  const std::vector<ToldEvent> rest = digest.Flush();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].count, 5000 - EventDigest::kMostCauses);
  // What is over makes room.
  EXPECT_TRUE(digest.Take(Made(EventKind::kCall, {6000}), 2));
}

TEST(EventDigestTest, KeepsTheWorstAndTheSumOfABurst) {
  EventDigest digest(1);
  for (const double late : {0.0, 0.002, 0.004, 0.001}) {
    digest.Take(Made(EventKind::kOverrun, {late}), 0);
    digest.Take(Made(EventKind::kWriteFailure, {2}), 0);
  }
  std::vector<std::string> said;
  for (const ToldEvent& told : digest.Flush()) said.push_back(told.text());
  EXPECT_THAT(
      said, ElementsAre("3 ticks began late, the worst by 4.0 ms", "6 messages could not be sent"));
}

TEST(EventDigestTest, WarnsOfLateTicksOnlyWhereTheyAreMany) {
  EXPECT_EQ((ToldEvent{.event = Made(EventKind::kOverrun), .count = 50}.level()),
            EventLevel::kSilent);
  EXPECT_EQ((ToldEvent{.event = Made(EventKind::kOverrun), .count = 51}.level()),
            EventLevel::kWarning);
}

}  // namespace
}  // namespace understudy::emulator
