// Tests sport of Go2, B2 and A2: the goals of its calls, and the codes for verdicts.
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "config/load.h"
#include "services/robot_services.h"
#include "tests/services/services_fixture.h"

namespace understudy::services {
namespace {

using authority::MotionGoal;
using nlohmann::json;
namespace goal = authority::goal;

TEST(Go2SportTest, MovesForASecondWithinItsLimits) {
  Caller caller(TableOf("go2", "sport"));
  EXPECT_EQ(caller.Ask(1008, R"({"x":9,"y":-9,"z":0.5})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::Move{3.8, -1, 0.5, 1}));
}

TEST(Go2SportTest, TellsByCodeWhatBecameOfAGoal) {
  Caller caller(TableOf("go2", "sport"));
  MotionBook& book = caller.robot.book;
  book.verdict = authority::MotionVerdict::kNotNow;
  EXPECT_EQ(caller.Ask(1002).code, 4201);
  EXPECT_EQ(caller.Ask(1016).code, 4206);
  EXPECT_EQ(caller.Ask(1028, R"({"data":true})").code, 4206);
  book.verdict = authority::MotionVerdict::kUnable;
  EXPECT_EQ(caller.Ask(1017).code, 4205);
}

TEST(Go2SportTest, HasNotTheIdsThatNewFirmwareRemoved) {
  Caller caller(TableOf("go2", "sport"));
  for (const std::int64_t id : {1011, 1012, 1013, 1014, 1018, 1019, 1021, 1024, 1025}) {
    EXPECT_EQ(caller.Ask(id, R"({"data":0})").code, 3203) << id;
  }
}

TEST(Go2SportTest, SwitchesAutoRecoveryAndGivesItBack) {
  Caller caller(TableOf("go2", "sport"));
  EXPECT_EQ(caller.Ask(2055).data, R"({"data":false})");
  EXPECT_EQ(caller.Ask(2054, R"({"data":true})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::AutoRecovery{true}));
  EXPECT_EQ(caller.Ask(2055).data, R"({"data":true})");
}

TEST(Go2SportTest, SwitchesTheSticksOfTheRemoteController) {
  Caller caller(TableOf("go2", "sport"));
  EXPECT_TRUE(caller.robot.owner.onboard().sticks);
  EXPECT_EQ(caller.Ask(1027, R"({"data":false})").code, 0);
  EXPECT_FALSE(caller.robot.owner.onboard().sticks);
  EXPECT_EQ(caller.Ask(1027, R"({"data":1})").code, 0);
  EXPECT_TRUE(caller.robot.owner.onboard().sticks);
}

TEST(Go2SportTest, SetsASpeedLevelAndGivesItBack) {
  Caller caller(TableOf("go2", "sport"));
  EXPECT_EQ(caller.Ask(1026).data, R"({"data":0})");
  EXPECT_EQ(caller.Ask(1015, R"({"data":-1})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::SpeedLevel{-1}));
  EXPECT_EQ(caller.Ask(1026).data, R"({"data":-1})");
  EXPECT_EQ(caller.Ask(1015, R"({"data":2})").code, kRpcApiParameter);
}

TEST(Go2SportTest, AsksForGaitsAndGesturesByTheirNames) {
  using enum goal::GaitName;
  using enum goal::GestureName;
  Caller caller(TableOf("go2", "sport"));
  const std::vector<std::pair<std::int64_t, MotionGoal>> kCalls{
      {1061, goal::Gait{kStatic}},     {1062, goal::Gait{kRun}},
      {1063, goal::Gait{kEconomic}},   {2045, goal::Gait{kFree}},
      {1016, goal::Gesture{kHello}},   {1017, goal::Gesture{kStretch}},
      {1020, goal::Gesture{kContent}}, {1022, goal::Gesture{kDance1}},
      {1023, goal::Gesture{kDance2}},  {1029, goal::Gesture{kScrape}},
      {1036, goal::Gesture{kHeart}}};
  for (const auto& [id, wish] : kCalls) {
    EXPECT_EQ(caller.Ask(id).code, 0) << id;
    EXPECT_EQ(caller.robot.book.goals.back(), wish) << id;
  }
  caller.Ask(2049, R"({"data":true})");
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{kClassic}));
  caller.Ask(2049, R"({"data":false})");
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{kFree}));
}

TEST(Go2SportTest, EndsAPoseWithTheCallThatBeginsIt) {
  Caller caller(TableOf("go2", "sport"));
  caller.Ask(1028, R"({"data":true})");
  caller.Ask(1028, R"({"data":false})");
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::Pose{}));
  EXPECT_EQ(caller.robot.book.goals.at(1), MotionGoal(goal::EndPose{}));
}

// A path of so many points, one every 0.1 s and 0.05 m.
json PathOf(int points) {
  json path = json::array();
  for (int i = 0; i < points; ++i) {
    path.push_back({{"t_from_start", 0.1 * i}, {"x", 0.05 * i}, {"y", 0}, {"yaw", 0}});
  }
  return path;
}

TEST(B2SportTest, TakesAPathOfThirtyPointsAndNoOther) {
  Caller caller(TableOf("b2", "sport"));
  EXPECT_EQ(caller.Ask(1018, PathOf(29).dump()).code, 4101);
  EXPECT_EQ(caller.Ask(1018, PathOf(30).dump()).code, 0);
  const auto& path = std::get<goal::FollowPath>(caller.robot.book.goals.at(0));
  ASSERT_EQ(path.points->size(), 30U);
  EXPECT_DOUBLE_EQ(path.points->back().t, 2.9);
  EXPECT_DOUBLE_EQ(path.points->back().x, 1.45);
  caller.robot.book.verdict = authority::MotionVerdict::kNotNow;
  EXPECT_EQ(caller.Ask(1018, PathOf(30).dump()).code, 4201);
}

TEST(B2SportTest, ChoosesGaitsByNumberAndByName) {
  using enum goal::GaitName;
  Caller caller(TableOf("b2", "sport"));
  for (const auto& [number, gait] :
       {std::pair(0, kFree), std::pair(1, kTrot), std::pair(2, kRun), std::pair(3, kStairs)}) {
    caller.Ask(1011, json{{"data", number}}.dump());
    EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{gait})) << number;
  }
  caller.Ask(1011, R"({"data":7})");
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{kNone})) << "which none has";
  caller.Ask(1050, R"({"data":1})");
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{kFast}));
}

TEST(B2SportTest, KeepsSteppingMovesOnAndGoesToPlaces) {
  Caller caller(TableOf("b2", "sport"));
  caller.Ask(1019, R"({"data":1})");
  caller.Ask(1038, R"({"data":true})");
  caller.Ask(1036, R"({"x":1,"y":-2,"yaw":0.5})");
  EXPECT_THAT(caller.robot.book.goals,
              testing::ElementsAre(MotionGoal(goal::KeepStepping{true}),
                                   MotionGoal(goal::LastingMoves{true}),
                                   MotionGoal(goal::GoTo{1, -2, 0.5, false})));
}

TEST(B2SportTest, TakesAnglesAndAFlagForFreeEuler) {
  Caller caller(TableOf("b2", "sport"));
  EXPECT_EQ(caller.Ask(1051, R"({"x":0.1,"y":0.2,"z":0.3})").code, 0);
  EXPECT_EQ(caller.Ask(1051, R"({"data":true})").code, 0);
  EXPECT_THAT(caller.robot.book.goals, testing::ElementsAre(MotionGoal(goal::Euler{0.1, 0.2, 0.3}),
                                                            MotionGoal(goal::Euler{})));
}

TEST(A2SportTest, FollowsAPathByItsOwnEstimateOnly) {
  Caller caller(TableOf("a2", "sport"));
  json parameter = {{"path", PathOf(3)},
                    {"feedback_mode", 0},
                    {"external_x", 0},
                    {"external_y", 0},
                    {"external_yaw", 0}};
  EXPECT_EQ(caller.Ask(1035, parameter.dump()).code, 0);
  EXPECT_EQ(std::get<goal::FollowPath>(caller.robot.book.goals.at(0)).points->size(), 3U);
  parameter["feedback_mode"] = 1;
  const ServiceReply reply = caller.Ask(1035, parameter.dump());
  EXPECT_EQ(reply.code, 4205);
  EXPECT_EQ(reply.refusal, CallRefusal::kNotSimulated);
  EXPECT_EQ(caller.robot.book.goals.size(), 1U);
  EXPECT_NE(caller.notice, "");
}

TEST(B2SportTest, HoldsAMoveHalfAsLongOnWheels) {
  Caller legs(TableOf("b2", "sport")), wheels(TableOf("b2w", "sport"));
  legs.Ask(1008, R"({"x":1,"y":0,"z":0})");
  wheels.Ask(1008, R"({"x":1,"y":0,"z":0})");
  EXPECT_EQ(legs.robot.book.goals.at(0), MotionGoal(goal::Move{1, 0, 0, 1.0}));
  EXPECT_EQ(wheels.robot.book.goals.at(0), MotionGoal(goal::Move{1, 0, 0, 0.5}));
}

TEST(A2SportTest, TellsItsStateInTexts) {
  Caller caller(TableOf("a2", "sport"));
  caller.robot.Be({.id = 3});
  caller.Ask(1015, R"({"data":2})");
  const json state = json::parse(caller.Ask(1034).data);
  EXPECT_EQ(state["fsm_id"], "3");
  EXPECT_EQ(state["speed_level"], "2");
  for (const auto& [key, value] : state.items()) EXPECT_TRUE(value.is_string()) << key;
}

TEST(OldGo2SportTest, HasWhatFirmwareOneOneSixTookAway) {
  const robot::RobotSpec old =
      config::LoadConfig({.robot = "go2", .sets = {"robot.firmware='1.1.5'"}},
                         UNDERSTUDY_SOURCE_DIR)
          .robots[0]
          .spec;
  EXPECT_THAT(old.apis, testing::Contains("sport_go2_2024"));
  Caller caller(TableNamed("sport_go2_2024"));
  EXPECT_EQ(caller.Ask(1011, R"({"data":1})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{goal::GaitName::kTrot}));
  EXPECT_EQ(caller.Ask(1013, R"({"data":-9})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::BodyHeight{-0.18}));
  EXPECT_EQ(caller.Ask(1024).data, R"({"data":-0.18})");
  EXPECT_EQ(caller.Ask(1014, R"({"data":0.5})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::FootRaise{0.03}));
  EXPECT_EQ(caller.Ask(1025).data, R"({"data":0.03})");
  EXPECT_EQ(caller.Ask(1033).code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(),
            MotionGoal(goal::Gesture{goal::GestureName::kWiggleHips}));
  EXPECT_EQ(caller.Ask(1021).code, 4205);
  EXPECT_EQ(caller.Ask(2045).code, 3203) << "FreeWalk came with 1.1.6";
}

TEST(Go2SportTest, TellsItsStateInTextsThatAreObjects) {
  for (const char* table : {"sport_go2", "sport_go2_2024"}) {
    Caller caller(TableNamed(table));
    const auto told = [&] {
      std::map<std::string, json> values;
      const json all = json::parse(caller.Ask(1034, R"(["state","gait "])").data);
      for (const auto& [key, text] : all.items()) {
        values[key] = json::parse(text.get<std::string>()).at("data");
      }
      return values;
    };
    caller.robot.Be({.id = 1017, .body_height = 0.25, .gait = 1, .foot_raise = 0.09});
    caller.Ask(1015, R"({"data":-1})");
    EXPECT_EQ(told(), (std::map<std::string, json>{{"state", "locomotion"},
                                                   {"bodyHeight", 0.25},
                                                   {"footRaiseHeight", 0.09},
                                                   {"speedLevel", -1},
                                                   {"gait", 1},
                                                   {"joystick", 1},
                                                   {"dance", 0},
                                                   {"continuousGait", 0},
                                                   {"economicGait", 1}}))
        << table;
    caller.robot.Be({.id = 1006, .keeps_stepping = true});
    EXPECT_EQ(told()["dance"], 1);
    EXPECT_EQ(told()["continuousGait"], 1);
  }
}

TEST(Go2SportTest, KnowsWhatTheAppAsksFor) {
  Caller caller(TableOf("go2", "sport"));
  EXPECT_EQ(caller.Ask(1049, R"({"data":true})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{goal::GaitName::kStairs}));
  EXPECT_EQ(caller.Ask(1049, R"({"data":false})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::Gait{goal::GaitName::kFree}));
  EXPECT_EQ(caller.Ask(2056, R"({"data":true})").code, 4205);
  EXPECT_EQ(caller.Ask(2059, R"({"data":true})").code, 4205);
}

}  // namespace
}  // namespace understudy::services
