#include "control/order_json.h"

#include "gtest/gtest.h"

namespace understudy {
namespace {

double LoweredBy(const OrderReading& reading) {
  return std::get<LowerCrane>(std::get<Order>(reading)).by;
}

template <class Kind>
bool Is(const OrderReading& reading) {
  const auto* order = std::get_if<Order>(&reading);
  return order != nullptr && std::holds_alternative<Kind>(*order);
}

// "" when the body was taken.
std::string Refusal(const OrderReading& reading) {
  const auto* why = std::get_if<std::string>(&reading);
  return why == nullptr ? "" : *why;
}

TEST(OrderJsonTest, ReadsEveryCraneOrder) {
  EXPECT_EQ(LoweredBy(ReadCraneOrder(R"({"lower": 0.25})")), 0.25);
  EXPECT_EQ(LoweredBy(ReadCraneOrder(R"({"lower": 1})")), 1);
  EXPECT_EQ(LoweredBy(ReadCraneOrder(R"({"raise": 0.25})")), -0.25);
  EXPECT_TRUE(Is<AttachCrane>(ReadCraneOrder(R"({"attach": true})")));
  EXPECT_TRUE(Is<ReleaseCrane>(ReadCraneOrder(R"({"release": true})")));
}

TEST(OrderJsonTest, ReadsBothClampOrders) {
  EXPECT_TRUE(std::get<ClampBase>(std::get<Order>(ReadClampOrder(R"({"on": true})"))).on);
  EXPECT_FALSE(std::get<ClampBase>(std::get<Order>(ReadClampOrder(R"({"on": false})"))).on);
}

TEST(OrderJsonTest, ReadsAPush) {
  const auto push = std::get<PushBody>(std::get<Order>(
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
  const auto press =
      std::get<PressRemote>(std::get<Order>(ReadRemoteOrder(R"({"press": "l2+b", "seconds": 2})")));
  EXPECT_EQ(press.keys, 0x220);
  EXPECT_EQ(press.seconds, 2);
  EXPECT_TRUE(Is<HoldRemote>(ReadRemoteOrder(R"({"hold": "L2"})")));
  EXPECT_TRUE(Is<ReleaseRemote>(ReadRemoteOrder(R"({"release": "L2"})")));
  EXPECT_TRUE(Is<SwitchRemote>(ReadRemoteOrder(R"({"on": false})")));
  const auto sticks = std::get<MoveSticks>(
      std::get<Order>(ReadRemoteOrder(R"({"sticks": {"ly": 0.5}, "seconds": 3})")));
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
            R"(expected exactly one of "press", "hold", "release", "sticks", "on", got 2)");
}

TEST(OrderJsonTest, ResetTakesAnEmptyObjectOrNothing) {
  EXPECT_TRUE(Is<ResetRobot>(ReadResetOrder("{}")));
  EXPECT_TRUE(Is<ResetRobot>(ReadResetOrder("")));
}

TEST(OrderJsonTest, ResetRefusesAKey) {
  EXPECT_EQ(Refusal(ReadResetOrder(R"({"hard": true})")),
            R"(unknown key "hard": a reset takes none)");
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

TEST(OrderJsonTest, SurvivesDeepNesting) {
  EXPECT_NE(Refusal(ReadCraneOrder(std::string(60'000, '['))), "");
  EXPECT_NE(Refusal(ReadCraneOrder(R"({"lower":)" + std::string(20'000, '[') +
                                   std::string(20'000, ']') + "}")),
            "");
}

TEST(OrderJsonTest, SurvivesBytesThatAreNoText) {
  EXPECT_NE(Refusal(ReadCraneOrder("{\"\xff\xfe\": 1}")), "");
  EXPECT_NE(Refusal(ReadCraneOrder(std::string_view{"\0\0", 2})), "");
}

}  // namespace
}  // namespace understudy
