#include "server/routes.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::server {
namespace {

using ::testing::HasSubstr;

class RoutesTest : public ::testing::Test {
 protected:
  Routed Dut(std::string_view method, std::string_view target, std::string_view body = "") {
    return Route({.method = method, .target = target, .body = body}, plane_);
  }
  HttpReply ReplyTo(std::string_view method, std::string_view target, std::string_view body = "") {
    return std::get<HttpReply>(Dut(method, target, body));
  }

  emulator::StatusBoard board_;
  emulator::FrameBoard frames_{emulator::Frame{}};
  Plane plane_{.identity = {.robot = "g1"}, .board = &board_, .frames = &frames_};
};

TEST_F(RoutesTest, StatusIsThatOfTheBoard) {
  emulator::Status status;
  status.steps = 7;
  board_.Post(status);
  const HttpReply reply = ReplyTo("GET", "/status");
  EXPECT_EQ(reply.status, 200u);
  EXPECT_EQ(nlohmann::json::parse(reply.body)["steps"], 7);
  EXPECT_EQ(nlohmann::json::parse(reply.body)["robot"], "g1");
}

TEST_F(RoutesTest, LeavesAQueryAside) { EXPECT_EQ(ReplyTo("GET", "/status?x=1").status, 200u); }

TEST_F(RoutesTest, OrdersArePosted) {
  EXPECT_TRUE(std::holds_alternative<emulator::Order>(Dut("POST", "/crane", R"({"lower": 1})")));
  EXPECT_TRUE(std::holds_alternative<emulator::Order>(Dut("POST", "/clamp", R"({"on": true})")));
  EXPECT_TRUE(std::holds_alternative<emulator::Order>(Dut("POST", "/reset", "{}")));
  EXPECT_TRUE(std::holds_alternative<emulator::Order>(Dut("POST", "/pause", R"({"on": true})")));
  EXPECT_TRUE(std::holds_alternative<emulator::Order>(Dut("POST", "/step", "{}")));
  EXPECT_TRUE(std::holds_alternative<emulator::Order>(Dut("POST", "/speed", R"({"speed": 2})")));
  EXPECT_TRUE(
      std::holds_alternative<emulator::Order>(Dut("POST", "/drag", R"({"release": true})")));
}

TEST_F(RoutesTest, ABodyThatCannotBeReadIs400) {
  const HttpReply reply = ReplyTo("POST", "/crane", "{");
  EXPECT_EQ(reply.status, 400u);
  EXPECT_EQ(reply.body, "{\"error\":\"the body is not JSON, see byte 2\"}\n");
}

TEST_F(RoutesTest, AnUnknownPathIs404WithTheNearest) {
  const HttpReply reply = ReplyTo("GET", "/statsu");
  EXPECT_EQ(reply.status, 404u);
  EXPECT_THAT(reply.body, HasSubstr("no path /statsu; did you mean '/status'? (valid: /status, "));
}

TEST_F(RoutesTest, AWrongMethodIs405AndNamesTheRightOne) {
  const HttpReply reply = ReplyTo("GET", "/reset");
  EXPECT_EQ(reply.status, 405u);
  EXPECT_EQ(reply.allow, "POST");
  EXPECT_EQ(reply.body, "{\"error\":\"/reset takes POST, not GET\"}\n");
}

TEST_F(RoutesTest, SurvivesAPathThatIsNoText) {
  EXPECT_EQ(ReplyTo("GET", "/\xff\xc3").status, 404u);
  EXPECT_EQ(ReplyTo("GET", "").status, 404u);
  EXPECT_EQ(ReplyTo("GET", std::string(8000, 'x')).status, 404u);
}

TEST_F(RoutesTest, AFrameHasThePartsThatAreAskedFor) {
  EXPECT_EQ(std::get<FromFrame>(Dut("GET", "/frame")).parts, emulator::kAllFrameParts);
  EXPECT_EQ(std::get<FromFrame>(Dut("GET", "/frame?parts=qpos,com")).parts,
            emulator::kPartPositions | emulator::kPartCom);
  EXPECT_EQ(std::get<FromFrame>(Dut("GET", "/frame?x=1&parts=qpos%2Ccom")).parts,
            emulator::kPartPositions | emulator::kPartCom);
}

TEST_F(RoutesTest, APartThatIsNoneIs400WithTheNearest) {
  const HttpReply reply = ReplyTo("GET", "/frame?parts=qpos,motor");
  EXPECT_EQ(reply.status, 400u);
  EXPECT_THAT(reply.body, HasSubstr("a frame has no motor; did you mean 'motors'?"));
}

TEST_F(RoutesTest, AWebSocketIsOneOnlyWhenAskedToBe) {
  EXPECT_EQ(ReplyTo("GET", "/frames").status, 426u);
  EXPECT_EQ(ReplyTo("GET", "/orders").status, 426u);
  const auto routed =
      Route({.method = "GET", .target = "/frames?hz=24.5&parts=com", .upgrade = true}, plane_);
  EXPECT_EQ(std::get<WatchFrames>(routed).hz, 24.5);
  EXPECT_EQ(std::get<WatchFrames>(routed).parts, emulator::kPartCom);
}

TEST_F(RoutesTest, ARateOutOfRangeIs400) {
  for (const char* hz : {"0", "241", "-1", "nan", "inf", "fast", "", "1e999", "60x"}) {
    EXPECT_EQ(ReplyTo("GET", "/frames?hz=" + std::string{hz}).status, 400u) << hz;
  }
}

TEST_F(RoutesTest, WhatIsNotThereIs404) {
  EXPECT_EQ(ReplyTo("GET", "/scene").status, 404u);
  EXPECT_EQ(ReplyTo("GET", "/scene/mesh/0").status, 404u);
  EXPECT_EQ(ReplyTo("GET", "/panel").status, 404u);
  EXPECT_EQ(ReplyTo("GET", "/").status, 404u);
  plane_.frames = nullptr;
  for (const char* target : {"/frame", "/refusals", "/metrics"}) {
    EXPECT_EQ(ReplyTo("GET", target).status, 404u) << target;
  }
  const auto frames = Route({.method = "GET", .target = "/frames", .upgrade = true}, plane_);
  EXPECT_EQ(std::get<HttpReply>(frames).status, 404u);
}

TEST_F(RoutesTest, TellsTheAddressOfThePanel) {
  plane_.url = "http://127.0.0.1:7707/#token=ab";
  EXPECT_EQ(ReplyTo("GET", "/panel").body, "{\"url\":\"http://127.0.0.1:7707/#token=ab\"}\n");
}

TEST_F(RoutesTest, ARefusalOfTheRobotIs409) {
  EXPECT_EQ(AnswerReply("not now").status, 409u);
  EXPECT_EQ(AnswerReply("not now").body, "{\"error\":\"not now\"}\n");
  EXPECT_EQ(AnswerReply("").status, 200u);
  EXPECT_EQ(AnswerReply("").body, "{\"ok\":true}\n");
}

}  // namespace
}  // namespace understudy::server
