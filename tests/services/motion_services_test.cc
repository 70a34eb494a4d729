// sport, loco and arm: what a goal becomes and what its verdict is answered with.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
  for (const std::int64_t id : {1011, 1012, 1013, 1014, 1018, 1019, 1021, 1024, 1025, 1026}) {
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

TEST(Go2SportTest, SaysThatNoSpeedIsThereToBeSet) {
  Caller caller(TableOf("go2", "sport"));
  EXPECT_EQ(caller.Ask(1015, R"({"data":1})").code, 4205);
  EXPECT_NE(caller.notice, "");
  EXPECT_EQ(caller.Ask(1015, R"({"data":2})").code, kRpcApiParameter);
}

TEST(Go2SportTest, EndsAPoseWithTheCallThatBeginsIt) {
  Caller caller(TableOf("go2", "sport"));
  caller.Ask(1028, R"({"data":true})");
  caller.Ask(1028, R"({"data":false})");
  EXPECT_EQ(caller.robot.book.goals.at(0), MotionGoal(goal::Pose{}));
  EXPECT_EQ(caller.robot.book.goals.at(1), MotionGoal(goal::EndPose{}));
}

TEST(B2SportTest, RefusesAPathOfAnotherLengthWithItsOwnCode) {
  Caller caller(TableOf("b2", "sport"));
  json path = json::array();
  for (int i = 0; i < 29; ++i) {
    path.push_back({{"t_from_start", i}, {"x", 0}, {"y", 0}, {"yaw", 0}});
  }
  EXPECT_EQ(caller.Ask(1018, path.dump()).code, 4101);
  path.push_back(path.front());
  EXPECT_EQ(caller.Ask(1018, path.dump()).code, 4205);
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
  caller.robot.book.state.id = 3;
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
  caller.robot.book.state = {.id = 500, .mode = 1};
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
  caller.robot.book.state.id = 501;
  EXPECT_EQ(caller.Ask(7005).code, 7301);
  EXPECT_EQ(caller.Ask(7005).data, R"({"data":1.0})");
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
  book.state.id = 501;
  EXPECT_EQ(caller.Ask(7106, R"({"action_id":26})").code, 7400);
  book.state.arm_holding = true;
  EXPECT_EQ(caller.Ask(7106, R"({"action_id":26})").code, 7401);
}

TEST(G1ArmTest, ListsActionsAndHasNoTaughtOnes) {
  Caller caller(TableOf("g1", "arm"));
  EXPECT_EQ(json::parse(caller.Ask(7107).data).at(0).at("id"), 99);
  EXPECT_EQ(caller.Ask(7108, R"({"action_name":"mine"})").code, 7402);
}

}  // namespace
}  // namespace understudy::services
