// Tests sport, loco and arm of humanoids: the goals of their calls, and the codes for verdicts.
#include <string>
#include <tuple>

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

TEST(R1SportTest, AnswersVelocitiesWithAFailureAndWalks) {
  Caller caller(TableOf("r1", "sport"));
  for (const int id : {0, 1, 4, 811}) {
    caller.robot.Be({.id = id});
    EXPECT_EQ(caller.Ask(7105, R"({"velocity":[0.3,0,0],"duration":1})").code, 127) << id;
  }
  EXPECT_EQ(caller.Ask(7105, R"({"velocity":"much"})").code, 3202);
  const goal::Move move{0.3, 0, 0, 1};
  EXPECT_EQ(caller.robot.book.goals, std::vector<MotionGoal>(4, move));
}

TEST(G1LocoTest, IsTheServiceOfFirmwareBeforeOneFour) {
  const auto apis = [](const std::string& firmware) {
    return config::LoadConfig({.robot = "g1", .sets = {"robot.firmware='" + firmware + "'"}},
                              UNDERSTUDY_SOURCE_DIR)
        .robots[0]
        .spec.apis;
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

}  // namespace
}  // namespace understudy::services
