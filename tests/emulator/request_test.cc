#include "emulator/request.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

#include <pthread.h>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "robot/start_pose.h"
#include "tests/support/requests.h"

namespace understudy::emulator {
namespace {

using nlohmann::json;
using test::RequestOf;
using ::testing::StartsWith;

// "" where the request is taken.
std::string Refusal(std::string_view name, const char* values) {
  return ReadRequest(name, json::parse(values)).why();
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

TEST(RequestTableTest, HasNamesOfItsOwnAndFieldsThatFit) {
  std::set<std::string_view> names;
  for (const RequestRow& row : RequestRows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.does.empty()) << row.name;
    EXPECT_FALSE(row.example.empty()) << row.name;
    EXPECT_NE(row.carry_out, nullptr) << row.name;
    EXPECT_LE(row.fields.size(), kMostFields) << row.name;
    int name_fields = 0, json_fields = 0;
    std::set<std::string_view> keys;
    for (const Field& field : row.fields) {
      EXPECT_TRUE(keys.insert(field.key).second) << row.name << "." << field.key;
      EXPECT_FALSE(field.does.empty()) << row.name << "." << field.key;
      if (field.type == &types::kBody || field.type == &types::kName) ++name_fields;
      if (field.type == &types::kJson) ++json_fields;
    }
    EXPECT_LE(name_fields, 1) << row.name;  // a request has room for one name and one JSON
    EXPECT_LE(json_fields, 1) << row.name;
  }
}

TEST(RequestTest, ReadsTheCranes) {
  EXPECT_EQ(RequestOf("crane.lower", {{"by", 0.25}}).number("by"), 0.25);
  EXPECT_EQ(RequestOf("crane.raise", {{"by", 1}}).number("by"), 1);
  EXPECT_EQ(RequestOf("crane.attach").row->name, "crane.attach");
  EXPECT_EQ(RequestOf("crane.release").row->name, "crane.release");
}

TEST(RequestTest, ReadsBothClamps) {
  EXPECT_TRUE(RequestOf("clamp", {{"on", true}}).on("on"));
  EXPECT_FALSE(RequestOf("clamp", {{"on", false}}).on("on"));
  EXPECT_TRUE(RequestOf("clamp", {{"on", "on"}}).on("on"));
  EXPECT_FALSE(RequestOf("clamp", {{"on", "off"}}).on("on"));
}

TEST(RequestTest, TakesItsFirstValueAlone) {
  EXPECT_TRUE(RequestOf("clamp", "on").on("on"));
  EXPECT_EQ(RequestOf("crane.lower", 0.25).number("by"), 0.25);
  EXPECT_EQ(RequestOf("remote.press", "A").number("keys"), 0x100);
  EXPECT_EQ(Refusal("remote.sticks", "0.5"), "expected an object of its values, got 0.5");
  EXPECT_EQ(Refusal("pause", "true"), "expected an object of its values, got true");
}

TEST(RequestTest, ReadsAPushByForceOrImpulse) {
  const Request force =
      RequestOf("push", {{"body", "trunk"}, {"force", {1, -2, 3.5}}, {"for", 0.25}});
  EXPECT_EQ(force.name(), "trunk");
  EXPECT_EQ(force.vector("force"), Eigen::Vector3d(1, -2, 3.5));
  EXPECT_EQ(force.number("for"), 0.25);
  const Request impulse = RequestOf("push", {{"impulse", {0, 5, 0}}});
  EXPECT_EQ(impulse.name(), "");
  EXPECT_EQ(impulse.vector("impulse"), Eigen::Vector3d(0, 5, 0));
  EXPECT_EQ(impulse.number("for"), 0.1);
}

TEST(RequestTest, ReadsACallOfAService) {
  const Request call = RequestOf(
      "service.call", {{"service", "sport"}, {"api", 1008}, {"parameter", R"({"x":0.3})"}});
  EXPECT_EQ(call.name(), "sport");
  EXPECT_EQ(call.number("api"), 1008);
  EXPECT_EQ(call.json(), R"({"x":0.3})");
  EXPECT_EQ(RequestOf("service.call", {{"service", "sport"}, {"api", 1008}}).json(), "");
  EXPECT_EQ(Refusal("service.call", R"({"service": "sport", "api": 1, "parameter": "{"})"),
            R"(parameter: expected JSON as text of at most 255 bytes, got "{")");
}

TEST(RequestTest, ReadsWhatIsAskedOfTheRemote) {
  const Request press = RequestOf("remote.press", {{"keys", "l2+b"}, {"for", 2}});
  EXPECT_EQ(press.number("keys"), 0x220);
  EXPECT_EQ(press.number("for"), 2);
  EXPECT_EQ(RequestOf("remote.press", "L2").number("for"), 0.1);
  EXPECT_EQ(RequestOf("remote.hold", "L2").number("keys"), 0x20);
  EXPECT_EQ(RequestOf("remote.release", "L2").number("keys"), 0x20);
  const Request sticks = RequestOf("remote.sticks", {{"ly", 0.5}, {"for", 3}});
  EXPECT_EQ(sticks.number("ly"), 0.5);
  EXPECT_FALSE(sticks.has("lx"));
  EXPECT_EQ(sticks.number("for"), 3);
}

TEST(RequestTest, RefusesKeysAndSticksThatAreNone) {
  EXPECT_EQ(Refusal("remote.press", R"({"keys": "L3"})"),
            R"(keys: expected keys of the remote controller, as in L2+B, got "L3")");
  EXPECT_NE(Refusal("remote.press", R"({"keys": ""})"), "");
  EXPECT_EQ(Refusal("remote.sticks", R"({"ly": 2})"), "ly: expected a number from -1 to 1, got 2");
  EXPECT_EQ(Refusal("remote.sticks", "{}"), "expected at least one of lx, ly, rx, ry");
}

TEST(RequestTest, RefusesATimeForWhatLastsUntilAnotherRequest) {
  EXPECT_EQ(Refusal("remote.hold", R"({"keys": "A", "for": 1})"),
            R"(unknown key "for"; valid: keys)");
  EXPECT_NE(Refusal("remote.release", R"({"keys": "A", "for": 1})"), "");
  EXPECT_EQ(Refusal("remote.off", R"({"for": 1})"), R"(unknown key "for"; it takes none)");
}

TEST(RequestTest, ReadsTheWholeRemoteAtOnce) {
  const Request set =
      RequestOf("remote.set", {{"keys", "L2+B"}, {"lx", -0.5}, {"ry", 1}, {"for", 0.5}});
  EXPECT_EQ(set.number("keys"), 0x220);
  EXPECT_EQ(set.number("lx"), -0.5);
  EXPECT_EQ(set.number("ly"), 0);
  EXPECT_EQ(set.number("ry"), 1);
  EXPECT_EQ(set.number("for"), 0.5);
}

TEST(RequestTest, ReadsARemoteOnWhichNothingIsHeld) {
  EXPECT_EQ(RequestOf("remote.set", {{"for", 1}}).number("keys"), 0);
  EXPECT_EQ(RequestOf("remote.set", {{"keys", ""}, {"for", 1}}).number("keys"), 0);
}

TEST(RequestTest, ResetsToThePosesThatARobotCanStartIn) {
  const auto pose = [](const char* word) {
    return static_cast<robot::StartPose>(RequestOf("reset", {{"pose", word}}).number("pose"));
  };
  EXPECT_EQ(pose("lying"), robot::StartPose::kLying);
  EXPECT_EQ(pose("standing"), robot::StartPose::kStanding);
  EXPECT_EQ(pose("hanging"), robot::StartPose::kHanging);
  EXPECT_EQ(pose("clamped"), robot::StartPose::kClamped);
  EXPECT_FALSE(RequestOf("reset", json::object()).has("pose"));
  EXPECT_FALSE(RequestOf("reset").has("pose"));
}

TEST(RequestTest, ReadsADrag) {
  const Request drag =
      RequestOf("drag", {{"body", "trunk"}, {"at", {0, 0.1, 0}}, {"to", {1, 2, 3}}, {"for", 2}});
  EXPECT_EQ(drag.name(), "trunk");
  EXPECT_EQ(drag.vector("at"), Eigen::Vector3d(0, 0.1, 0));
  EXPECT_EQ(drag.vector("to"), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(drag.number("for"), 2);
}

TEST(RequestTest, ADragHoldsTheBodysOriginForHalfASecondUnlessToldOtherwise) {
  const Request drag = RequestOf("drag", {{"body", "trunk"}, {"to", {1, 2, 3}}});
  EXPECT_EQ(drag.vector("at"), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(drag.number("for"), 0.5);
}

TEST(RequestTest, LetsGoOfOneBodyOrOfAll) {
  EXPECT_EQ(RequestOf("let_go", {{"body", "trunk"}}).name(), "trunk");
  EXPECT_FALSE(RequestOf("let_go").has("body"));
}

TEST(RequestTest, RefusesADragThatIsNone) {
  EXPECT_EQ(Refusal("drag", R"({"to": [1, 2, 3]})"), "body: missing; expected the name of a body");
  EXPECT_EQ(Refusal("drag", R"({"body": 3, "to": [1, 2, 3]})"),
            "body: expected the name of a body, got 3");
  EXPECT_NE(Refusal("drag", R"({"body": "", "to": [1, 2, 3]})"), "");
  EXPECT_EQ(ReadRequest("drag", {{"body", std::string(64, 'x')}, {"to", {1, 2, 3}}}).why(),
            "body: expected the name of a body, got \"" + std::string(39, 'x') + "...");
  EXPECT_EQ(Refusal("drag", R"({"body": "trunk"})"),
            "to: missing; expected three numbers from -1000000 to 1000000 m");
  EXPECT_EQ(Refusal("drag", R"({"body": "trunk", "to": [1, 2, 1e7]})"),
            "to: expected three numbers from -1000000 to 1000000 m, got 1e+07");
  EXPECT_EQ(Refusal("drag", R"({"body": "trunk", "at": [11, 0, 0], "to": [1, 2, 3]})"),
            "at: expected three numbers from -10 to 10 m, got 11");
  EXPECT_EQ(Refusal("drag", R"({"body": "trunk", "to": [1, 2, 3], "for": 61})"),
            "for: expected a number from 0.0001 to 60 s, got 61");
  EXPECT_EQ(Refusal("drag", R"({"body": "trunk", "to": [1, 2, 3], "for": 0})"),
            "for: expected a number from 0.0001 to 60 s, got 0");
}

TEST(RequestTest, ReadsSteps) {
  EXPECT_EQ(RequestOf("step", {{"steps", 250}}).number("steps"), 250);
  EXPECT_EQ(RequestOf("step").number("steps"), 1);
  EXPECT_TRUE(RequestOf("step").on("wait"));
}

TEST(RequestTest, RefusesStepsThatAreNoNumberOfSteps) {
  for (const char* steps : {"0", "-1", "1.5", "1000001", "\"10\"", "1e300"}) {
    EXPECT_THAT(Refusal("step", ("{\"steps\": " + std::string(steps) + "}").c_str()),
                StartsWith("steps: expected a whole number from 1 to 1000000, got "))
        << steps;
  }
}

TEST(RequestTest, ReadsASpeed) {
  EXPECT_EQ(RequestOf("speed", {{"speed", 0.001}}).number("speed"), 0.001);
  EXPECT_EQ(RequestOf("speed", {{"speed", 1000}}).number("speed"), 1000);
  EXPECT_EQ(RequestOf("speed", {{"speed", "max"}}).number("speed"), 0);
  EXPECT_EQ(ValuesOf(RequestOf("speed", {{"speed", "max"}})).dump(), R"({"speed":"max"})");
}

TEST(RequestTest, SpeedZeroIsNotAsFastAsPossible) {
  EXPECT_EQ(Refusal("speed", R"({"speed": 0})"),
            "speed: expected a number from 0.001 to 1000, or max, got 0; to stand still use pause");
}

TEST(RequestTest, RefusesASpeedOutOfRange) {
  for (const char* speed : {"-1", "0.0009", "1001", "true", "null"}) {
    EXPECT_THAT(Refusal("speed", ("{\"speed\": " + std::string(speed) + "}").c_str()),
                StartsWith("speed: expected a number from 0.001 to 1000, or max, got"))
        << speed;
  }
  EXPECT_NE(Refusal("speed", "{}"), "");
}

TEST(RequestTest, NamesTheNearestOfAnUnknownNameOrKey) {
  EXPECT_THAT(Refusal("crane.lowr", "{}"),
              StartsWith("no request \"crane.lowr\"; did you mean 'crane.lower'?"));
  EXPECT_EQ(Refusal("crane.lower", R"({"bx": 1})"),
            R"(unknown key "bx"; did you mean 'by'? (valid: by))");
}

TEST(RequestTest, RefusesALengthThatIsMissingNoNumberOrBeyondTheLimit) {
  EXPECT_EQ(Refusal("crane.lower", "{}"), "by: missing; expected a number from -10 to 10 m");
  EXPECT_EQ(Refusal("crane.lower", R"({"by": "1"})"),
            R"(by: expected a number from -10 to 10 m, got "1")");
  EXPECT_EQ(RequestOf("crane.lower", -10).number("by"), -10);
  EXPECT_EQ(Refusal("crane.raise", R"({"by": 10.5})"),
            "by: expected a number from -10 to 10 m, got 10.5");
}

TEST(RequestTest, TellsWhatIsMissingUnknownOrOutOfRange) {
  const std::tuple<const char*, const char*, const char*> rows[] = {
      {"push", "{}", "expected either force or impulse"},
      {"push", R"({"force": [1, 2, 3], "impulse": [1, 2, 3]})", "expected either force or impulse"},
      {"push", R"({"force": [1, 2]})",
       "force: expected three numbers from -1000000 to 1000000 N, got an array"},
      {"push", R"({"force": [1, 2, "x"]})",
       R"(force: expected three numbers from -1000000 to 1000000 N, got "x")"},
      {"push", R"({"force": [1, 2, 3], "for": 0})",
       "for: expected a number from 0.0001 to 1000000 s, got 0"},
      {"remote.set", R"({"keys": "A"})",
       "for: missing; expected a number from 0.0001 to 1000000 s"},
      {"remote.set", R"({"keys": "L3", "for": 1})",
       R"(keys: expected keys of the remote controller, as in L2+B, got "L3")"},
      {"remote.set", R"({"lz": 0, "for": 1})",
       R"(unknown key "lz"; did you mean 'lx'? (valid: keys, lx, ly, rx, ry, for, press))"},
      {"remote.set", R"({"lx": 1.5, "for": 1})", "lx: expected a number from -1 to 1, got 1.5"},
      {"reset", R"({"pose": "standin"})",
       "pose: expected one of lying, standing, hanging, clamped, got \"standin\"; did you "
       "mean 'standing'?"},
      {"reset", R"({"pose": 1})", "pose: expected one of lying, standing, hanging, clamped, got 1"},
      {"reset", R"({"hard": true})", R"(unknown key "hard"; valid: pose, all)"},
      {"clamp", R"({"on": 1})", "on: expected true or false, got 1"},
      {"clamp", "{}", "on: missing; expected true or false"},
      {"clamp", R"({"on": "yes"})", "on: expected true or false, got \"yes\""},
      {"clamp", "[true]", "on: expected true or false, got an array"},
  };
  for (const auto& [name, values, why] : rows) EXPECT_EQ(Refusal(name, values), why);
}

// As deep as a body may be long, in every request, on a stack too small for any recursion over it.
TEST(RequestTest, SurvivesDeepNesting) {
  OnASmallStack([&] {
    constexpr std::size_t kDeep = 32'000;
    const std::string deep = std::string(kDeep, '[') + std::string(kDeep, ']');
    for (const RequestRow& row : RequestRows()) {
      EXPECT_FALSE(ReadRequest(row, json::parse(deep))) << row.name;
      for (const Field& field : row.fields) {
        EXPECT_FALSE(
            ReadRequest(row, json::parse("{\"" + std::string(field.key) + "\":" + deep + "}")))
            << row.name << "." << field.key;
      }
    }
  });
}

TEST(RequestTest, SurvivesBytesThatAreNoText) {
  EXPECT_THAT(ReadRequest("\xff\xfe").why(), StartsWith("no request "));
  EXPECT_FALSE(ReadRequest("reset", {{"\xff", 1}}));
  EXPECT_FALSE(ReadRequest("reset", {{"pose", "\xff"}}));
}

TEST(RequestTest, SaysWhatWasAskedAndGivesItsValuesBack) {
  const Request push =
      RequestOf("push", {{"body", "base"}, {"force", {0, -50, 0.125}}, {"for", 0.1}});
  EXPECT_EQ(Describe(push), "push base 0 -50 0.125 N for 0.1 s");
  EXPECT_EQ(ValuesOf(push).dump(), R"({"body":"base","force":[0.0,-50.0,0.125],"for":0.1})");
  EXPECT_EQ(Describe(RequestOf("reset", "standing")), "reset standing");
  EXPECT_EQ(ValuesOf(RequestOf("reset", "standing")).dump(), R"({"pose":"standing"})");
  EXPECT_EQ(Describe(RequestOf("drag", {{"body", "foot"}, {"to", {1, 2, 3}}})),
            "drag foot 1 2 3 m");
  EXPECT_EQ(Describe(RequestOf("let_go")), "let_go");
  EXPECT_EQ(Describe(RequestOf("let_go", "foot")), "let_go foot");
  EXPECT_EQ(Describe(RequestOf("step", 5)), "step 5");
  EXPECT_EQ(Describe(RequestOf("crane.raise", 0.25)), "crane.raise 0.25 m");
  EXPECT_EQ(Describe(RequestOf("clamp", "on")), "clamp on");
  EXPECT_EQ(Describe(RequestOf("remote.press", "B+L2")), "remote.press L2+B");
}

TEST(RequestTest, MeansTheFirstRobotOfItsWorldUnlessToldOtherwise) {
  EXPECT_EQ(RequestOf("clamp", "on").robot, 0U);
  const Request second = RequestOf("clamp", {{"on", true}, {"robot", 1}});
  EXPECT_EQ(second.robot, 1U);
  EXPECT_EQ(Describe(second), "clamp on robot 1");
  EXPECT_EQ(ReadRequest("clamp", ValuesOf(second))->robot, 1U);
  for (const json& none : {json(-1), json(0.5), json(256), json("g1")}) {
    EXPECT_THAT(ReadRequest("clamp", {{"on", true}, {"robot", none}}).why(),
                StartsWith("robot: expected a whole number from 0 to 255, got"));
  }
}

TEST(RequestTest, KeepsNamesThatAreTooLongOut) {
  EXPECT_TRUE(ReadRequest("let_go", std::string(63, 'x')));
  EXPECT_FALSE(ReadRequest("let_go", std::string(64, 'x')));
}

}  // namespace
}  // namespace understudy::emulator
