#include "server/order_json.h"

#include <functional>
#include <string>
#include <vector>

#include <pthread.h>

#include "gtest/gtest.h"

namespace understudy::server {
namespace {

double LoweredBy(const OrderReading& reading) {
  return std::get<emulator::LowerCrane>(std::get<emulator::Order>(reading)).by;
}

template <class Kind>
bool Is(const OrderReading& reading) {
  const auto* order = std::get_if<emulator::Order>(&reading);
  return order != nullptr && std::holds_alternative<Kind>(*order);
}

// "" when the body was taken.
std::string Refusal(const OrderReading& reading) {
  const auto* why = std::get_if<std::string>(&reading);
  return why == nullptr ? "" : *why;
}

// Calls `function` in a thread with 1 MB of stack.
void OnASmallStack(std::function<void()> function) {
  pthread_attr_t attributes{};
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, 1 << 20);
  const auto call = [](void* what) -> void* {
    (*static_cast<std::function<void()>*>(what))();
    return nullptr;
  };
  pthread_t thread{};
  const int error = ::pthread_create(&thread, &attributes, call, &function);
  ::pthread_attr_destroy(&attributes);
  ASSERT_EQ(error, 0);
  ::pthread_join(thread, nullptr);
}

TEST(OrderJsonTest, ReadsEveryCraneOrder) {
  EXPECT_EQ(LoweredBy(ReadCraneOrder(R"({"lower": 0.25})")), 0.25);
  EXPECT_EQ(LoweredBy(ReadCraneOrder(R"({"lower": 1})")), 1);
  EXPECT_EQ(LoweredBy(ReadCraneOrder(R"({"raise": 0.25})")), -0.25);
  EXPECT_TRUE(Is<emulator::AttachCrane>(ReadCraneOrder(R"({"attach": true})")));
  EXPECT_TRUE(Is<emulator::ReleaseCrane>(ReadCraneOrder(R"({"release": true})")));
}

TEST(OrderJsonTest, ReadsBothClampOrders) {
  EXPECT_TRUE(
      std::get<emulator::ClampBase>(std::get<emulator::Order>(ReadClampOrder(R"({"on": true})")))
          .on);
  EXPECT_FALSE(
      std::get<emulator::ClampBase>(std::get<emulator::Order>(ReadClampOrder(R"({"on": false})")))
          .on);
}

TEST(OrderJsonTest, ReadsAPush) {
  const auto push = std::get<emulator::PushBody>(std::get<emulator::Order>(
      ReadPushOrder(R"({"body": "trunk", "force": [1, -2, 3.5], "seconds": 0.25})")));
  EXPECT_EQ(push.body, "trunk");
  EXPECT_EQ(push.force, Eigen::Vector3d(1, -2, 3.5));
  EXPECT_EQ(push.seconds, 0.25);
}

TEST(OrderJsonTest, RefusesAPushWithoutForceOrTime) {
  EXPECT_EQ(Refusal(ReadPushOrder(R"({"force": [1, 2, 3]})")),
            R"("seconds": expected how long it acts)");
  EXPECT_EQ(Refusal(ReadPushOrder(R"({"force": [1, 2], "seconds": 1})")),
            R"("force": expected three numbers)");
  EXPECT_EQ(Refusal(ReadPushOrder(R"({"force": [1, 2, "x"], "seconds": 1})")),
            R"("force": expected three numbers in N, got "x")");
}

TEST(OrderJsonTest, ReadsEveryRemoteOrder) {
  const auto press = std::get<emulator::PressRemote>(
      std::get<emulator::Order>(ReadRemoteOrder(R"({"press": "l2+b", "seconds": 2})")));
  EXPECT_EQ(press.keys, 0x220);
  EXPECT_EQ(press.seconds, 2);
  EXPECT_TRUE(Is<emulator::HoldRemote>(ReadRemoteOrder(R"({"hold": "L2"})")));
  EXPECT_TRUE(Is<emulator::ReleaseRemote>(ReadRemoteOrder(R"({"release": "L2"})")));
  EXPECT_TRUE(Is<emulator::SwitchRemote>(ReadRemoteOrder(R"({"on": false})")));
  const auto sticks = std::get<emulator::MoveSticks>(
      std::get<emulator::Order>(ReadRemoteOrder(R"({"sticks": {"ly": 0.5}, "seconds": 3})")));
  EXPECT_EQ(sticks.ly, 0.5);
  EXPECT_FALSE(sticks.lx.has_value());
  EXPECT_EQ(sticks.seconds, 3);
}

TEST(OrderJsonTest, RefusesKeysAndSticksThatAreNone) {
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"press": "L3"})")),
            R"("press": expected keys of the remote controller, as in "L2+B", got "L3")");
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"sticks": {"ly": 2}})")),
            R"("ly": expected a number from -1 to 1, got 2)");
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"press": "A", "hold": "B"})")),
            R"(expected exactly one of "press", "hold", "release", "sticks", "set", "on", got 2)");
}

TEST(OrderJsonTest, RefusesATimeForWhatLastsUntilAnotherOrder) {
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"hold": "A", "seconds": 1})")),
            R"("seconds": "hold" lasts until another order)");
  EXPECT_NE(Refusal(ReadRemoteOrder(R"({"release": "A", "seconds": 1})")), "");
  EXPECT_NE(Refusal(ReadRemoteOrder(R"({"on": false, "seconds": 1})")), "");
}

TEST(OrderJsonTest, ReadsTheWholeRemoteAtOnce) {
  const auto set = std::get<emulator::SetRemote>(std::get<emulator::Order>(
      ReadRemoteOrder(R"({"set": {"keys": "L2+B", "lx": -0.5, "ry": 1}, "seconds": 0.5})")));
  EXPECT_EQ(set.reading.keys, 0x220);
  EXPECT_EQ(set.reading.lx, -0.5);
  EXPECT_EQ(set.reading.ly, 0);
  EXPECT_EQ(set.reading.ry, 1);
  EXPECT_EQ(set.seconds, 0.5);
}

TEST(OrderJsonTest, ReadsARemoteOnWhichNothingIsHeld) {
  for (const char* body :
       {R"({"set": {}, "seconds": 1})", R"({"set": {"keys": ""}, "seconds": 1})"}) {
    EXPECT_EQ(std::get<emulator::SetRemote>(std::get<emulator::Order>(ReadRemoteOrder(body)))
                  .reading.keys,
              0);
  }
}

TEST(OrderJsonTest, RefusesAWholeRemoteThatNobodyWouldLetGo) {
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"set": {"keys": "A"}})")),
            R"("seconds": expected after how long without another order all is let go)");
}

TEST(OrderJsonTest, RefusesAWholeRemoteWithWhatIsNone) {
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"set": {"keys": "L3"}, "seconds": 1})")),
            R"("keys": expected keys of the remote controller, as in "L2+B", or "", got "L3")");
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"set": {"lz": 0}, "seconds": 1})")),
            R"(unknown key "lz"; did you mean 'lx'? (valid: keys, lx, ly, rx, ry))");
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"set": {"lx": 1.5}, "seconds": 1})")),
            R"("lx": expected a number from -1 to 1, got 1.5)");
  EXPECT_EQ(Refusal(ReadRemoteOrder(R"({"set": "A", "seconds": 1})")),
            R"("set": expected an object of keys, lx, ly, rx, ry, got "A")");
}

TEST(OrderJsonTest, ResetTakesAnEmptyObjectOrNothing) {
  EXPECT_TRUE(Is<emulator::ResetRobot>(ReadResetOrder("{}")));
  EXPECT_TRUE(Is<emulator::ResetRobot>(ReadResetOrder("")));
}

TEST(OrderJsonTest, ResetTakesThePosesThatARobotCanStartIn) {
  const auto pose = [](const char* body) {
    return std::get<emulator::ResetRobot>(std::get<emulator::Order>(ReadResetOrder(body))).pose;
  };
  EXPECT_EQ(pose(R"({"pose": "lying"})"), robot::StartPose::kLying);
  EXPECT_EQ(pose(R"({"pose": "damped"})"), robot::StartPose::kLying);
  EXPECT_EQ(pose(R"({"pose": "standing"})"), robot::StartPose::kStanding);
  EXPECT_EQ(pose(R"({"pose": "hanging"})"), robot::StartPose::kHanging);
  EXPECT_EQ(pose(R"({"pose": "clamped"})"), robot::StartPose::kClamped);
  EXPECT_EQ(pose("{}"), std::nullopt);
}

TEST(OrderJsonTest, ResetRefusesAPoseThatIsNone) {
  EXPECT_EQ(Refusal(ReadResetOrder(R"({"pose": "standin"})")),
            "\"pose\": no pose \"standin\"; did you mean 'standing'? (valid: lying, standing, "
            "hanging, clamped)");
  EXPECT_EQ(Refusal(ReadResetOrder(R"({"pose": 1})")),
            R"("pose": expected one of "lying", "standing", "hanging", "clamped", got 1)");
}

TEST(OrderJsonTest, ResetRefusesAnotherKey) {
  EXPECT_EQ(Refusal(ReadResetOrder(R"({"hard": true})")), R"(unknown key "hard"; valid: pose)");
}

TEST(OrderJsonTest, ReadsADrag) {
  const auto drag = std::get<emulator::DragBody>(std::get<emulator::Order>(
      ReadDragOrder(R"({"body": "trunk", "at": [0, 0.1, 0], "to": [1, 2, 3], "seconds": 2})")));
  EXPECT_EQ(drag.body, "trunk");
  EXPECT_EQ(drag.p_BP, Eigen::Vector3d(0, 0.1, 0));
  EXPECT_EQ(drag.p_WT, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(drag.seconds, 2);
}

TEST(OrderJsonTest, ADragHoldsTheBodysOriginForHalfASecondUnlessToldOtherwise) {
  const auto drag = std::get<emulator::DragBody>(
      std::get<emulator::Order>(ReadDragOrder(R"({"body": "trunk", "to": [1, 2, 3]})")));
  EXPECT_EQ(drag.p_BP, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(drag.seconds, 0.5);
}

TEST(OrderJsonTest, ReadsTheReleaseOfOneBodyAndOfAll) {
  const auto body = [](const char* text) {
    return std::get<emulator::ReleaseDrag>(std::get<emulator::Order>(ReadDragOrder(text))).body;
  };
  EXPECT_EQ(body(R"({"body": "trunk", "release": true})"), "trunk");
  EXPECT_EQ(body(R"({"release": true})"), "");
}

TEST(OrderJsonTest, RefusesADragThatIsNone) {
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"to": [1, 2, 3]})")),
            R"("body": expected the name of a body)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"body": 3, "to": [1, 2, 3]})")),
            R"("body": expected the name of a body, got 3)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"body": "trunk"})")), R"("to": expected three numbers)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"body": "trunk", "to": [1, 2, 1e7]})")),
            R"("to": expected three numbers in m, at most 1e6, got 10000000.0)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"body": "trunk", "at": [11, 0, 0], "to": [1, 2, 3]})")),
            R"("at": expected three numbers in m, at most 10, got 11)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"body": "trunk", "to": [1, 2, 3], "seconds": 61})")),
            R"("seconds": expected more than 0 and at most 60, got 61)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"body": "trunk", "to": [1, 2, 3], "seconds": 0})")),
            R"("seconds": expected more than 0 and at most 60, got 0)");
}

TEST(OrderJsonTest, RefusesAReleaseOfADragThatSaysMore) {
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"release": false})")),
            R"("release": expected true, got false)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"release": true, "to": [1, 2, 3]})")),
            R"("release" takes nothing but "body" beside it)");
  EXPECT_EQ(Refusal(ReadDragOrder(R"({"body": "trunk", "release": true, "seconds": 1})")),
            R"("release" takes nothing but "body" beside it)");
}

TEST(OrderJsonTest, ReadsBothPauseOrders) {
  EXPECT_TRUE(
      std::get<emulator::PauseRun>(std::get<emulator::Order>(ReadPauseOrder(R"({"on": true})")))
          .on);
  EXPECT_FALSE(
      std::get<emulator::PauseRun>(std::get<emulator::Order>(ReadPauseOrder(R"({"on": false})")))
          .on);
}

TEST(OrderJsonTest, RefusesAPauseThatIsNeitherOnNorOff) {
  EXPECT_EQ(Refusal(ReadPauseOrder("{}")), R"("on": expected true or false, got null)");
  EXPECT_EQ(Refusal(ReadPauseOrder(R"({"on": "yes"})")),
            R"("on": expected true or false, got "yes")");
}

TEST(OrderJsonTest, ReadsSteps) {
  const auto steps = [](const char* body) {
    return std::get<emulator::StepRun>(std::get<emulator::Order>(ReadStepOrder(body))).steps;
  };
  EXPECT_EQ(steps(R"({"steps": 250})"), 250);
  EXPECT_EQ(steps("{}"), 1);
}

TEST(OrderJsonTest, RefusesStepsThatAreNoNumberOfSteps) {
  for (const char* steps : {"0", "-1", "1.5", "1000001", "\"10\"", "1e300"}) {
    EXPECT_TRUE(Refusal(ReadStepOrder("{\"steps\": " + std::string(steps) + "}"))
                    .starts_with("\"steps\": expected a whole number from 1 to 1000000, got "))
        << steps;
  }
}

TEST(OrderJsonTest, ReadsASpeed) {
  const auto speed = [](const char* body) {
    return std::get<emulator::SetSpeed>(std::get<emulator::Order>(ReadSpeedOrder(body))).speed;
  };
  EXPECT_EQ(speed(R"({"speed": 0})"), 0);
  EXPECT_EQ(speed(R"({"speed": 0.001})"), 0.001);
  EXPECT_EQ(speed(R"({"speed": 1000})"), 1000);
}

TEST(OrderJsonTest, RefusesASpeedOutOfRange) {
  for (const char* speed : {"-1", "0.0009", "1001", "true", "null"}) {
    EXPECT_TRUE(Refusal(ReadSpeedOrder("{\"speed\": " + std::string(speed) + "}"))
                    .starts_with("\"speed\": expected 0 (as fast as possible) or 0.001 to 1000"))
        << speed;
  }
  EXPECT_NE(Refusal(ReadSpeedOrder("{}")), "");
}

TEST(OrderJsonTest, NamesTheNearestOfAnUnknownKey) {
  EXPECT_EQ(Refusal(ReadCraneOrder(R"({"lowr": 1})")),
            R"(unknown key "lowr"; did you mean 'lower'? (valid: lower, raise, attach, release))");
}

TEST(OrderJsonTest, RefusesNoKey) {
  EXPECT_EQ(Refusal(ReadCraneOrder("{}")),
            R"(expected exactly one of "lower", "raise", "attach", "release", got 0)");
}

TEST(OrderJsonTest, RefusesTwoKeys) {
  EXPECT_EQ(Refusal(ReadCraneOrder(R"({"lower": 1, "attach": true})")),
            R"(expected exactly one of "lower", "raise", "attach", "release", got 2)");
}

TEST(OrderJsonTest, RefusesALengthThatIsNoNumber) {
  EXPECT_EQ(Refusal(ReadCraneOrder(R"({"lower": "1"})")),
            R"("lower": expected metres, at most 10 either way, got "1")");
}

TEST(OrderJsonTest, RefusesALengthBeyondTheLimit) {
  EXPECT_EQ(LoweredBy(ReadCraneOrder(R"({"lower": -10})")), -10);
  EXPECT_EQ(Refusal(ReadCraneOrder(R"({"raise": 10.5})")),
            R"("raise": expected metres, at most 10 either way, got 10.5)");
}

TEST(OrderJsonTest, RefusesANumberThatNoDoubleHolds) {
  EXPECT_EQ(Refusal(ReadCraneOrder(R"({"lower": 1e999})")),
            "the body holds a number too large for a double");
}

TEST(OrderJsonTest, RefusesNaNWhichIsNoJson) {
  EXPECT_EQ(Refusal(ReadCraneOrder(R"({"lower": NaN})")), "the body is not JSON, see byte 11");
}

TEST(OrderJsonTest, RefusesAttachFalse) {
  EXPECT_EQ(Refusal(ReadCraneOrder(R"({"attach": false})")),
            R"("attach": expected true, got false)");
}

TEST(OrderJsonTest, RefusesAClampThatIsNoBool) {
  EXPECT_EQ(Refusal(ReadClampOrder(R"({"on": 1})")), R"("on": expected true or false, got 1)");
}

TEST(OrderJsonTest, RefusesWhatIsNoObject) {
  EXPECT_EQ(Refusal(ReadClampOrder("[true]")), "the body: expected a JSON object, got an array");
}

TEST(OrderJsonTest, RefusesAnEmptyBodyWhereAKeyIsNeeded) {
  EXPECT_EQ(Refusal(ReadCraneOrder("")), "the body is not JSON, see byte 1");
}

// As deep as a body may be long, in every order, on a stack too small for any recursion over it.
TEST(OrderJsonTest, SurvivesDeepNesting) {
  struct Reading {
    OrderReading (*read)(std::string_view body);
    std::vector<const char*> keys;
  };
  const Reading readings[] = {{ReadCraneOrder, {"lower", "attach"}},
                              {ReadClampOrder, {"on"}},
                              {ReadResetOrder, {"pose"}},
                              {ReadPushOrder, {"body", "force", "seconds"}},
                              {ReadDragOrder, {"body", "at", "to", "seconds", "release"}},
                              {ReadPauseOrder, {"on"}},
                              {ReadStepOrder, {"steps"}},
                              {ReadSpeedOrder, {"speed"}},
                              {ReadRemoteOrder, {"press", "sticks", "set", "on", "seconds"}}};
  OnASmallStack([&] {
    constexpr std::size_t kDeep = 32'000;
    for (const Reading& reading : readings) {
      EXPECT_NE(Refusal(reading.read(std::string(2 * kDeep, '['))), "");
      for (const char* key : reading.keys) {
        const std::string body = "{\"" + std::string{key} + "\":" + std::string(kDeep, '[') +
                                 std::string(kDeep, ']') + "}";
        EXPECT_NE(Refusal(reading.read(body)), "") << key;
      }
    }
  });
}

TEST(OrderJsonTest, SurvivesBytesThatAreNoText) {
  EXPECT_NE(Refusal(ReadCraneOrder("{\"\xff\xfe\": 1}")), "");
  EXPECT_NE(Refusal(ReadCraneOrder(std::string_view{"\0\0", 2})), "");
}

}  // namespace
}  // namespace understudy::server
