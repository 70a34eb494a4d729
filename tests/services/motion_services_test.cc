// Tests sport, loco and arm: the goals of their calls, and the codes for verdicts.
#include <tuple>
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
  EXPECT_TRUE(caller.robot.owner.sticks());
  EXPECT_EQ(caller.Ask(1027, R"({"data":false})").code, 0);
  EXPECT_FALSE(caller.robot.owner.sticks());
  EXPECT_EQ(caller.Ask(1027, R"({"data":1})").code, 0);
  EXPECT_TRUE(caller.robot.owner.sticks());
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

TEST(G1SportTest, AnswersZeroToStatesItDoesNotHaveOrCannotReach) {
  Caller caller(TableOf("g1", "sport"));
  for (const authority::MotionVerdict verdict :
       {authority::MotionVerdict::kUnknown, authority::MotionVerdict::kNotNow}) {
    caller.robot.book.verdict = verdict;
    EXPECT_EQ(caller.Ask(7101, R"({"data":99999})").code, 0);
  }
}

TEST(G1SportTest, TellsTheStateThatIs) {
  Caller caller(TableOf("g1", "sport"));
  caller.robot.Be({.id = 500, .mode = 1});
  EXPECT_EQ(caller.Ask(7001).data, R"({"data":500})");
  EXPECT_EQ(caller.Ask(7002).data, R"({"data":1})");
}

TEST(G1SportTest, GivesVelocityItsDuration) {
  Caller caller(TableOf("g1", "sport"));
  EXPECT_EQ(caller.Ask(7105, R"({"velocity":[0.3,0,-0.2],"duration":864000})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::Move{0.3, 0, -0.2, 864000}));
}

TEST(G1SportTest, SaturatesTheStandHeightAndGivesItBack) {
  Caller caller(TableOf("g1", "sport"));
  EXPECT_EQ(caller.Ask(7104, R"({"data":4294967295})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::SetStandHeight{1}));
  EXPECT_EQ(caller.Ask(7005).data, R"({"data":1.0})");
  caller.Ask(7104, R"({"data":0})");
  EXPECT_EQ(caller.Ask(7005).data, R"({"data":0.0})");
}

TEST(G1SportTest, KeepsNothingOfAGoalThatWasNotTaken) {
  Caller caller(TableOf("g1", "sport"));
  caller.robot.book.verdict = authority::MotionVerdict::kNotNow;
  EXPECT_EQ(caller.Ask(7102, R"({"data":1})").code, 0);
  EXPECT_EQ(caller.Ask(7003).data, R"({"data":0})");
}

// A G1's SetStandHeight, a Go2's Move after StandUp.
TEST(MotionServicesTest, AnswerZeroAndTellWhatIsTakenWithoutEffect) {
  for (const auto& [robot, api, parameter] :
       {std::tuple("g1", 7104, R"({"data":0.5})"), std::tuple("g1", 7101, R"({"data":0})"),
        std::tuple("go2", 1008, R"({"x":1,"y":0,"z":0})"),
        std::tuple("r1", 7101, R"({"data":4})")}) {
    Caller caller(TableOf(robot, "sport"));
    caller.robot.book.verdict = authority::MotionVerdict::kIgnored;
    const ServiceReply reply = caller.Ask(api, parameter);
    EXPECT_EQ(reply.code, 0) << robot << " " << api;
    EXPECT_EQ(reply.refusal, CallRefusal::kIgnored) << robot << " " << api;
  }
}

TEST(G1SportTest, SendsHeightsWithACodeWhileItWalksAsSeenOnOne) {
  Caller caller(TableOf("g1", "sport"));
  for (const int id : {500, 501, 801, 802}) {
    caller.robot.Be({.id = id});
    EXPECT_EQ(caller.Ask(7005).code, 7301) << id;
    EXPECT_EQ(caller.Ask(7005).data, R"({"data":1.0})");
  }
  caller.robot.Be({.id = 4});
  EXPECT_EQ(caller.Ask(7005).code, 0);
}

TEST(G1SportTest, SaysThatItDoesNotPlayTheAppsActions) {
  Caller caller(TableOf("g1", "sport"));
  EXPECT_EQ(caller.Ask(7100, R"({"fsm_id":550,"api_id":2,"motion_paused":false})").code, 7301);
}

TEST(G1SportTest, TakesTheMotorsBackIntoTheWalkOfTheRobot) {
  Caller caller(TableOf("g1", "sport"));
  EXPECT_EQ(caller.Ask(7111, R"({"data":2})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::BalanceStand{}));
}

// xr_teleoperate issue 319, unitree_sdk2_python issues 168 and 182, phanthymotus-driver pull 27.
TEST(R1SportTest, HasCodesOfItsOwn) {
  Caller caller(TableOf("r1", "sport"));
  MotionBook& book = caller.robot.book;
  caller.robot.Be({.id = 811});
  EXPECT_EQ(caller.Ask(7101, R"({"data":811})").code, 1001);
  caller.robot.Be({.id = 816});
  EXPECT_EQ(caller.Ask(7101, R"({"data":811})").code, 1001) << "while rt/arm_sdk has a weight";
  EXPECT_TRUE(book.goals.empty());
  EXPECT_EQ(caller.Ask(7101, R"({"data":1})").code, 0);
  EXPECT_EQ(book.goals.back(), MotionGoal(goal::SetFsm{1}));
  book.verdict = authority::MotionVerdict::kUnknown;
  EXPECT_EQ(caller.Ask(7101, R"({"data":9999})").code, 1003);
  book.verdict = authority::MotionVerdict::kUnable;
  EXPECT_EQ(caller.Ask(7101, R"({"data":701})").code, 7301);
  EXPECT_EQ(caller.Ask(7002).code, 3203);
  EXPECT_EQ(caller.Ask(7107, R"({"data":1})").code, 3203);
}

TEST(R1SportTest, RefusesVelocitiesInEveryState) {
  Caller caller(TableOf("r1", "sport"));
  for (const int id : {0, 1, 4, 811}) {
    caller.robot.Be({.id = id});
    EXPECT_EQ(caller.Ask(7105, R"({"velocity":[0.3,0,0],"duration":1})").code, 127) << id;
  }
  EXPECT_EQ(caller.Ask(7105, R"({"velocity":"much"})").code, 3202);
  EXPECT_TRUE(caller.robot.book.goals.empty());
}

TEST(G1LocoTest, IsTheServiceOfFirmwareBeforeOneFour) {
  const auto apis = [](const std::string& firmware) {
    return config::LoadConfig({.robot = "g1", .sets = {"robot.firmware='" + firmware + "'"}},
                              UNDERSTUDY_SOURCE_DIR)
        .robot.apis;
  };
  EXPECT_THAT(apis("1.3.9"), testing::AllOf(testing::Contains("loco_g1"),
                                            testing::Not(testing::Contains("sport_g1"))));
  for (const char* newer : {"1.4", "1.4.7", "1.5.3"}) {
    EXPECT_THAT(apis(newer), testing::Contains("sport_g1")) << newer;
  }
  Caller caller(TableNamed("loco_g1"));
  EXPECT_EQ(caller.service.table().name, "loco");
  EXPECT_EQ(caller.Ask(7101, R"({"data":200})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::SetFsm{200}));
  EXPECT_EQ(caller.Ask(7104, R"({"data":0})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.back(), MotionGoal(goal::SetStandHeight{0}));
  caller.robot.Be({.id = 200});
  EXPECT_EQ(caller.Ask(7005).code, 0) << "getters answer while it walks";
  EXPECT_EQ(caller.Ask(7106, R"({"data":0})").code, 3203) << "as on a robot of 2025-02";
}

TEST(OldGo2SportTest, HasWhatFirmwareOneOneSixTookAway) {
  const robot::RobotSpec old =
      config::LoadConfig({.robot = "go2", .sets = {"robot.firmware='1.1.5'"}},
                         UNDERSTUDY_SOURCE_DIR)
          .robot;
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

TEST(Go2SportTest, TellsItsStateInTexts) {
  Caller caller(TableOf("go2", "sport"));
  caller.robot.Be({.id = 1017, .body_height = 0.25, .gait = 1});
  caller.Ask(1015, R"({"data":-1})");
  const json state = json::parse(caller.Ask(1034).data);
  EXPECT_EQ(state["state"], "batteryLife");
  EXPECT_EQ(state["bodyHeight"], "0.25");
  EXPECT_EQ(state["speedLevel"], "-1");
  EXPECT_EQ(state["gait"], "1");
  EXPECT_EQ(state["economicGait"], "true");
  EXPECT_EQ(state["continuousGait"], "false");
  caller.robot.Be({.keeps_stepping = true});
  EXPECT_EQ(json::parse(caller.Ask(1034).data)["continuousGait"], "true");
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

TEST(G1SportTest, RefusesATaskItDoesNotHave) {
  Caller caller(TableOf("g1", "sport"));
  EXPECT_EQ(caller.Ask(7106, R"({"data":4})").code, 7303);
  EXPECT_EQ(caller.Ask(7106, R"({"data":-1})").code, 7303);
  EXPECT_EQ(caller.Ask(7106, R"({"data":2})").code, 0);
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::ArmAction{27}));
}

TEST(H1LocoTest, GivesBackThePhase) {
  Caller caller(TableOf("h1", "loco"));
  EXPECT_EQ(caller.Ask(8106, R"({"data":[0.25,0.75]})").code, 0);
  EXPECT_EQ(caller.Ask(8006).data, R"({"data":[0.25,0.75]})");
  EXPECT_EQ(caller.Ask(8107, R"({"data":9})").code, 8304);
}

TEST(G1ArmTest, AnswersAnActionWhenItHasEnded) {
  Caller caller(TableOf("g1", "arm"));
  const ServiceReply reply = caller.Ask(7106, R"({"data":26})");
  EXPECT_EQ(reply.code, 0);
  ASSERT_NE(reply.once, nullptr);
  EXPECT_FALSE(reply.once({.arm_action = 25}));
  EXPECT_TRUE(reply.once({.arm_action = 25, .arm_holding = true}));
  EXPECT_TRUE(reply.once({}));
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::ArmAction{26}));
}

TEST(G1ArmTest, SaysWhyAnActionIsNotDone) {
  Caller caller(TableOf("g1", "arm"));
  MotionBook& book = caller.robot.book;
  book.verdict = authority::MotionVerdict::kUnknown;
  EXPECT_EQ(caller.Ask(7106, R"({"action_id":1000})").code, 7402);
  book.verdict = authority::MotionVerdict::kNotNow;
  EXPECT_EQ(caller.Ask(7106, R"({"action_id":26})").code, 7404);
  caller.robot.Be({.id = 501});
  EXPECT_EQ(caller.Ask(7106, R"({"action_id":26})").code, 7400);
  caller.robot.Be({.id = 501, .arm_holding = true});
  EXPECT_EQ(caller.Ask(7106, R"({"action_id":26})").code, 7401);
}

TEST(G1ArmTest, ListsActionsAndHasNoTaughtOnes) {
  Caller caller(TableOf("g1", "arm"));
  const json lists = json::parse(caller.Ask(7107).data);
  ASSERT_EQ(lists.size(), 2U);
  EXPECT_EQ(lists[0].at(0), (json{{"id", 99}, {"name", "release_arm"}}));
  EXPECT_EQ(lists[0].at(1).at("fsm"), (json{500, 501}));
  EXPECT_EQ(lists[0].size(), 23U) << "as one with 29 motors";
  EXPECT_TRUE(lists[1].empty());
  EXPECT_EQ(caller.Ask(7109, R"({"action_name":"mine"})").code, 7402);
  EXPECT_EQ(caller.Ask(7110, R"({"action_name":""})").code, 7402);
  EXPECT_EQ(caller.Ask(7108, R"({"action_name":"mine"})").code, 7402);
}

}  // namespace
}  // namespace understudy::services
