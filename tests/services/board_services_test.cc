// motion_switcher, robot_state, config and the devices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/services/services_fixture.h"

namespace understudy::services {
namespace {

using nlohmann::json;

TEST(MotionSwitcherTest, NamesTheMotionServiceThatRuns) {
  Caller caller(TableOf("go2", "motion_switcher"));
  for (const char* parameter : {"", "{}"}) {
    EXPECT_EQ(caller.Ask(1001, parameter).data, R"({"form":"0","name":"ai"})");
  }
}

TEST(MotionSwitcherTest, ReleasesAndSelects) {
  Caller caller(TableOf("go2", "motion_switcher"));
  EXPECT_EQ(caller.Ask(1003).code, 0);
  EXPECT_EQ(caller.Ask(1001).data, R"({"form":"0","name":""})");
  EXPECT_EQ(caller.Ask(1003).code, 0);
  EXPECT_EQ(caller.Ask(1002, R"({"name":"ai"})").code, 0);
  EXPECT_EQ(caller.robot.owner.active(), "ai");
}

TEST(MotionSwitcherTest, RefusesAnUnknownName) {
  Caller caller(TableOf("go2", "motion_switcher"));
  EXPECT_EQ(caller.Ask(1002, R"({"name":"dance"})").code, 7004);
  for (const char* parameter : {"", "{}", R"({"name": 1})", "[]", "null", R"("ai")", "{"}) {
    EXPECT_EQ(caller.Ask(1002, parameter).code, 7001) << parameter;
  }
}

// Seen on a Go2: the busy check comes first.
TEST(MotionSwitcherTest, SelectsNothingElseWhileMcfIsOn) {
  Caller caller(TableOf("go2", "motion_switcher"));
  caller.robot.owner =
      authority::MotorOwner({{.name = "mcf", .alias = "mcf"}}, "0", Plays(&caller.robot.book));
  for (const char* name : {"normal", "dance"}) {
    const std::string parameter = json{{"name", name}}.dump();
    EXPECT_EQ(caller.Ask(1002, parameter).code, 7002) << name;
  }
  EXPECT_EQ(caller.Ask(1002, R"({"name":"mcf"})").code, 0);
  caller.Ask(1003);
  EXPECT_EQ(caller.Ask(1002, R"({"name":"normal"})").code, 7004);
  EXPECT_EQ(caller.Ask(1002, R"({"name":"mcf"})").code, 0);
}

TEST(MotionSwitcherTest, NeverClaimsToHaveStartedWhatNothingPlays) {
  Service service(TableOf("go2", "motion_switcher"));
  authority::MotorOwner owner({{.name = "mcf", .alias = "mcf", .on = false}}, "0", nullptr);
  std::string notice;
  const std::string parameter = R"({"name":"mcf"})";
  const ServiceReply reply = service.Answer(
      {.api_id = 1002, .parameter = parameter, .parameter_bytes = 14}, &owner, {}, &notice);
  EXPECT_EQ(reply.code, 7007);
  EXPECT_EQ(owner.active(), "");
  EXPECT_EQ(reply.refusal, CallRefusal::kNotSimulated);
}

TEST(MotionSwitcherTest, KeepsSilentModeToBeReadBack) {
  Caller caller(TableOf("go2", "motion_switcher"));
  EXPECT_EQ(caller.Ask(1005).data, R"({"silent":false})");
  EXPECT_EQ(caller.Ask(1004, R"({"silent":true})").code, 0);
  EXPECT_EQ(caller.Ask(1005).data, R"({"silent":true})");
  EXPECT_EQ(caller.Ask(1004, R"({"silent":false})").code, 0);
  EXPECT_EQ(caller.Ask(1005).data, R"({"silent":false})");
  for (const char* parameter : {"", "{}", R"({"silent": 1})", "[]"}) {
    EXPECT_EQ(caller.Ask(1004, parameter).code, 7001) << parameter;
  }
}

TEST(ServiceTest, AnswersAnUnknownApiWith3203) {
  Caller caller(TableOf("go2", "motion_switcher"));
  for (const std::int64_t api : {0L, 2L, 1000L, 1006L, -1L, 9223372036854775807L}) {
    EXPECT_EQ(caller.Ask(api).code, 3203) << api;
  }
}

TEST(RobotStateTest, ListsABareArrayInWhichOnIsZero) {
  Caller caller(TableOf("go2", "robot_state"));
  EXPECT_EQ(json::parse(caller.Ask(1003).data),
            json::parse(R"([{"name":"ai_sport","status":0,"protect":0},
                            {"name":"vui_service","status":0,"protect":0},
                            {"name":"basic_service","status":0,"protect":1}])"));
}

TEST(RobotStateTest, TakesAnOrderForReports) {
  Caller caller(TableOf("g1", "robot_state"));
  EXPECT_EQ(caller.Ask(1002, R"({"interval":5,"duration":60})").code, 0);
  EXPECT_EQ(caller.robot.owner.onboard().report.interval, 5);
  EXPECT_EQ(caller.robot.owner.onboard().report.duration, 60);
  EXPECT_EQ(caller.robot.owner.onboard().report.asked, 1U);
  EXPECT_EQ(caller.Ask(1002, R"({"interval":-1,"duration":60})").code, 3204);
  EXPECT_EQ(caller.robot.owner.onboard().report.asked, 1U);
}

TEST(RobotStateTest, SwitchesWithOneForOnAndAnswersZeroForOn) {
  Caller caller(TableOf("go2", "robot_state"));
  EXPECT_EQ(json::parse(caller.Ask(1001, R"({"name":"vui_service","switch":0})").data),
            json::parse(R"({"name":"vui_service","status":1})"));
  EXPECT_EQ(json::parse(caller.Ask(1003).data).at(1).at("status"), 1);
  EXPECT_EQ(json::parse(caller.Ask(1001, R"({"name":"vui_service","switch":1})").data)["status"],
            0);
}

TEST(RobotStateTest, AnswersFiveForAProtectedServiceAndLeavesItOn) {
  Caller caller(TableOf("go2", "robot_state"));
  const ServiceReply reply = caller.Ask(1001, R"({"name":"basic_service","switch":0})");
  EXPECT_EQ(reply.code, 0);
  EXPECT_EQ(json::parse(reply.data)["status"], 5);
  EXPECT_TRUE(caller.robot.owner.services()[2].on);
}

TEST(RobotStateTest, AnswersNeitherOnNorOffForAnUnknownService) {
  Caller caller(TableOf("go2", "robot_state"));
  EXPECT_EQ(json::parse(caller.Ask(1001, R"({"name":"x","switch":1})").data)["status"], 2);
}

TEST(RobotStateTest, TakesTheMotorsFromTheMotionServiceItSwitchesOff) {
  Caller caller(TableOf("go2", "robot_state"));
  caller.Ask(1001, R"({"name":"ai_sport","switch":0})");
  EXPECT_EQ(caller.robot.owner.active(), "");
}

TEST(ServiceTest, IsNotServedWhileItsProgramOrTheMotionServiceIsOff) {
  ServedRobot robot;
  const Service sport(TableOf("go2", "sport")), vui(TableOf("go2", "vui")),
      switcher(TableOf("go2", "motion_switcher"));
  EXPECT_TRUE(sport.IsServed(robot.owner) && vui.IsServed(robot.owner));
  robot.owner.Release();
  robot.owner.Switch("vui_service", false);
  EXPECT_FALSE(sport.IsServed(robot.owner) || vui.IsServed(robot.owner));
  EXPECT_TRUE(switcher.IsServed(robot.owner));
}

TEST(ConfigServiceTest, KeepsForgetsAndDescribesTexts) {
  Caller caller(TableOf("go2", "config"));
  EXPECT_EQ(caller.Ask(1002, R"({"name":"a"})").code, 8202);
  EXPECT_EQ(caller.Ask(1001, R"({"name":"a","content":"{\"b\":1}"})").code, 0);
  EXPECT_EQ(json::parse(caller.Ask(1002, R"({"name":"a"})").data)["content"], R"({"b":1})");
  const json meta = json::parse(caller.Ask(1004, R"({"name":"a"})").data)["meta"];
  EXPECT_EQ(meta["name"], "a");
  EXPECT_EQ(meta["size"], 7);
  EXPECT_TRUE(meta["lastModified"].is_string() && meta["epoch"].is_number_integer());
  EXPECT_EQ(caller.Ask(1003, R"({"name":"a"})").code, 0);
  EXPECT_EQ(caller.Ask(1003, R"({"name":"a"})").code, 8202);
}

TEST(ConfigServiceTest, TellsWhatChanged) {
  Caller caller(TableOf("go2", "config"));
  EXPECT_FALSE(caller.Ask(1003, R"({"name":"a"})").change);
  const auto set = caller.Ask(1001, R"({"name":"a","content":"b"})").change;
  ASSERT_TRUE(set);
  EXPECT_EQ(set->name + "=" + set->content, "a=b");
  EXPECT_FALSE(caller.Ask(1002, R"({"name":"a"})").change);
  const auto deleted = caller.Ask(1003, R"({"name":"a"})").change;
  ASSERT_TRUE(deleted);
  EXPECT_EQ(deleted->name + "=" + deleted->content, "a=");
}

TEST(ConfigServiceTest, BoundsNamesAndNumber) {
  Caller caller(TableOf("go2", "config"));
  EXPECT_EQ(caller.Ask(1001, R"({"name":"","content":""})").code, 8203);
  const std::string name(65, 'n');
  EXPECT_EQ(caller.Ask(1001, json{{"name", name}, {"content", ""}}.dump()).code, 8204);
  std::int32_t code = 0;
  for (int i = 0; i < 257; ++i) {
    code = caller.Ask(1001, json{{"name", std::to_string(i)}, {"content", ""}}.dump()).code;
  }
  EXPECT_EQ(code, 8204);
  EXPECT_EQ(caller.Ask(1001, R"({"name":"3","content":"again"})").code, 0);
}

TEST(VuiTest, GivesBackWhatWasSet) {
  Caller caller(TableOf("go2", "vui"));
  EXPECT_EQ(caller.Ask(1003, R"({"volume":7})").code, 0);
  EXPECT_EQ(caller.Ask(1004).data, R"({"volume":7})");
  EXPECT_EQ(caller.Ask(1003, R"({"volume":11})").code, 100);
  EXPECT_EQ(caller.Ask(1004).data, R"({"volume":7})");
}

TEST(VoiceTest, SaysInTheLogWhatIsSpoken) {
  Caller caller(TableOf("g1", "voice"));
  EXPECT_EQ(caller.Ask(1001, "{\"index\":0,\"speaker_id\":0,\"text\":\"a\\u001b\"}").code, 0);
  EXPECT_EQ(caller.notice, "voice says \"a\\u001b\"");
}

TEST(VoiceTest, TakesSoundButNotMoreThanAChunk) {
  Caller caller(TableOf("g1", "voice"));
  const std::string parameter = R"({"app_name":"a","stream_id":"b"})";
  for (const auto& [bytes, code] : {std::pair{96000UL, 0}, std::pair{96001UL, 100}}) {
    EXPECT_EQ(caller.service
                  .Answer({.api_id = 1003,
                           .parameter = parameter,
                           .parameter_bytes = parameter.size(),
                           .binary_bytes = bytes},
                          &caller.robot.owner, {}, &caller.notice)
                  .code,
              code);
  }
}

TEST(VideoTest, InventsNoPicture) {
  Caller caller(TableOf("go2", "videohub"));
  const ServiceReply reply = caller.Ask(1001);
  EXPECT_EQ(reply.code, 100);
  EXPECT_EQ(reply.refusal, CallRefusal::kNotSimulated);
}

TEST(ObstaclesAvoidTest, WalksOnlyWhenTold) {
  Caller caller(TableOf("go2", "obstacles_avoid"));
  const char* move = R"({"x":2,"y":0,"yaw":0,"mode":0})";
  const ServiceReply ignored = caller.Ask(1003, move);
  EXPECT_EQ(ignored.code, 0);
  EXPECT_EQ(ignored.refusal, CallRefusal::kState);
  EXPECT_TRUE(caller.robot.book.goals.empty());
  EXPECT_EQ(caller.Ask(1004, R"({"is_remote_commands_from_api":true})").code, 0);
  caller.Ask(1003, move);
  caller.Ask(1003, R"({"x":3,"y":-1,"yaw":9,"mode":1})");
  caller.Ask(1003, R"({"x":3,"y":-1,"yaw":2,"mode":2})");
  using authority::MotionGoal;
  namespace goal = authority::goal;
  EXPECT_THAT(caller.robot.book.goals,
              testing::ElementsAre(MotionGoal(goal::Move{1.5, 0, 0, 1}),
                                   MotionGoal(goal::GoTo{2, -1, 1.57, true}),
                                   MotionGoal(goal::GoTo{3, -1, 2, false})));
}

TEST(ObstaclesAvoidTest, AvoidsObstaclesWhileItsSwitchIsOn) {
  Caller caller(TableOf("go2", "obstacles_avoid"));
  const char* move = R"({"x":1,"y":0,"yaw":0,"mode":0})";
  const char* go = R"({"x":1,"y":0,"yaw":0,"mode":1})";
  caller.Ask(1004, R"({"is_remote_commands_from_api":true})");
  EXPECT_EQ(caller.Ask(1002).data, R"({"enable":false})");
  caller.Ask(1003, move);
  EXPECT_EQ(caller.Ask(1001, R"({"enable":true})").code, 0);
  EXPECT_EQ(caller.Ask(1002).data, R"({"enable":true})");
  EXPECT_TRUE(caller.robot.owner.avoids());
  caller.Ask(1003, move);
  caller.Ask(1003, go);
  caller.Ask(1001, R"({"enable":false})");
  EXPECT_FALSE(caller.robot.owner.avoids());
  caller.Ask(1003, go);
  using authority::MotionGoal;
  namespace goal = authority::goal;
  EXPECT_THAT(
      caller.robot.book.goals,
      testing::ElementsAre(MotionGoal(goal::Move{.vx = 1, .hold = 1}),
                           MotionGoal(goal::Move{.vx = 1, .hold = 1, .avoids = true}),
                           MotionGoal(goal::GoTo{.x = 1, .from_here = true, .avoids = true}),
                           MotionGoal(goal::GoTo{.x = 1, .from_here = true})));
}

TEST(ObstaclesAvoidTest, SaysWhetherItWalks) {
  Caller caller(TableOf("go2", "obstacles_avoid"));
  const char* move = R"({"x":1,"y":0,"yaw":0,"mode":0})";
  caller.Ask(1004, R"({"is_remote_commands_from_api":true})");
  EXPECT_EQ(caller.Ask(1003, move).code, 0);
  caller.robot.book.verdict = authority::MotionVerdict::kIgnored;
  EXPECT_EQ(caller.Ask(1003, move).code, 0);
  caller.robot.book.verdict = authority::MotionVerdict::kUnable;
  const ServiceReply unable = caller.Ask(1003, move);
  EXPECT_EQ(unable.code, 3202);
  EXPECT_EQ(unable.refusal, CallRefusal::kNotSimulated);
  caller.robot.book.verdict = authority::MotionVerdict::kNotNow;
  EXPECT_EQ(caller.Ask(1003, move).code, 3202);
}

}  // namespace
}  // namespace understudy::services
