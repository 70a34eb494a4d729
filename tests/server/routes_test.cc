#include "server/routes.h"

#include <algorithm>

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
  emulator::SnapshotMailbox snapshots_{emulator::Snapshot{}};
  Plane plane_{.identity = {.robot = "g1"}, .board = &board_, .snapshots = &snapshots_};
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

TEST_F(RoutesTest, EveryRequestHasAPathToBePostedTo) {
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    std::string path = "/" + std::string(row.name);
    std::ranges::replace(path, '.', '/');
    EXPECT_EQ(ReplyTo("GET", path).status, 405u) << path;
    EXPECT_EQ(ReplyTo("POST", path, "3").status, 400u) << path;
  }
  const auto lower = std::get<emulator::Request>(Dut("POST", "/crane/lower", R"({"by": 0.5})"));
  EXPECT_EQ(lower.row->name, "crane.lower");
  EXPECT_EQ(lower.number("by"), 0.5);
  EXPECT_EQ(std::get<emulator::Request>(Dut("POST", "/reset")).row->name, "reset");
}

TEST_F(RoutesTest, TellsTheTableOfRequests) {
  const auto table = nlohmann::json::parse(ReplyTo("GET", "/requests").body)["requests"];
  ASSERT_EQ(table.size(), emulator::RequestRows().size());
  const auto lower =
      std::ranges::find(table, "crane.lower", [](const auto& row) { return row["name"]; });
  EXPECT_EQ((*lower)["fields"][0]["key"], "by");
  EXPECT_EQ((*lower)["fields"][0]["unit"], "m");
  EXPECT_EQ((*lower)["fields"][0]["range"], (nlohmann::json{-10, 10}));
}

TEST_F(RoutesTest, TellsServicesWithTheirApis) {
  plane_.services = {{.name = "sport", .rows = {{.id = 1001, .name = "Damp", .does = "brakes"}}}};
  const auto sport = nlohmann::json::parse(ReplyTo("GET", "/services").body)["services"][0];
  EXPECT_EQ(sport["name"], "sport");
  ASSERT_EQ(sport["apis"].size(), 1u);
  EXPECT_EQ(sport["apis"][0]["id"], 1001);
  EXPECT_EQ(sport["apis"][0]["name"], "Damp");
  EXPECT_EQ(sport["apis"][0]["does"], "brakes");
}

TEST_F(RoutesTest, WithoutABusItHasNobody) { EXPECT_EQ(ReplyTo("GET", "/bus").status, 404u); }

TEST_F(RoutesTest, ABodyThatCannotBeReadIs400) {
  const auto why = [&](std::string_view body) {
    const HttpReply reply = ReplyTo("POST", "/crane/lower", body);
    EXPECT_EQ(reply.status, 400u);
    return nlohmann::json::parse(reply.body)["error"].get<std::string>();
  };
  EXPECT_EQ(why("{"), "the body is not JSON, see byte 2");
  EXPECT_EQ(why(R"({"by": NaN})"), "the body is not JSON, see byte 8");
  EXPECT_EQ(why(R"({"by": 1e999})"), "the body holds a number too large for a double");
  EXPECT_EQ(why("[true]"), "the body: expected a JSON object, got an array");
  EXPECT_EQ(why(""), "by: missing; expected a number from -10 to 10 m");
  EXPECT_NE(why("{\"\xff\xfe\": 1}"), "");
  EXPECT_NE(why(std::string_view{"\0\0", 2}), "");
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

TEST_F(RoutesTest, ASnapshotHasThePartsThatAreAskedFor) {
  EXPECT_EQ(std::get<FromSnapshot>(Dut("GET", "/snapshot")).parts, emulator::kAllSnapshotParts);
  EXPECT_EQ(std::get<FromSnapshot>(Dut("GET", "/snapshot?parts=qpos,com")).parts,
            emulator::kPartPositions | emulator::kPartCom);
  EXPECT_EQ(std::get<FromSnapshot>(Dut("GET", "/snapshot?x=1&parts=qpos%2Ccom")).parts,
            emulator::kPartPositions | emulator::kPartCom);
}

TEST_F(RoutesTest, APartThatIsNoneIs400WithTheNearest) {
  const HttpReply reply = ReplyTo("GET", "/snapshot?parts=qpos,motor");
  EXPECT_EQ(reply.status, 400u);
  EXPECT_THAT(reply.body, HasSubstr("a snapshot has no motor; did you mean 'motors'?"));
}

TEST_F(RoutesTest, AWebSocketIsOneOnlyWhenAskedToBe) {
  EXPECT_EQ(ReplyTo("GET", "/snapshots").status, 426u);
  EXPECT_TRUE(std::holds_alternative<TakeRequests>(
      Route({.method = "GET", .target = "/requests", .upgrade = true}, plane_)));
  const auto routed =
      Route({.method = "GET", .target = "/snapshots?hz=24.5&parts=com", .upgrade = true}, plane_);
  EXPECT_EQ(std::get<WatchSnapshots>(routed).hz, 24.5);
  EXPECT_EQ(std::get<WatchSnapshots>(routed).parts, emulator::kPartCom);
}

TEST_F(RoutesTest, ARateOutOfRangeIs400) {
  for (const char* hz : {"0", "241", "-1", "nan", "inf", "fast", "", "1e999", "60x"}) {
    EXPECT_EQ(ReplyTo("GET", "/snapshots?hz=" + std::string{hz}).status, 400u) << hz;
  }
}

TEST_F(RoutesTest, WhatIsNotThereIs404) {
  EXPECT_EQ(ReplyTo("GET", "/scene").status, 404u);
  EXPECT_EQ(ReplyTo("GET", "/scene/mesh/0").status, 404u);
  EXPECT_EQ(ReplyTo("GET", "/panel").status, 404u);
  EXPECT_EQ(ReplyTo("GET", "/").status, 404u);
  plane_.snapshots = nullptr;
  for (const char* target : {"/snapshot", "/metrics"}) {
    EXPECT_EQ(ReplyTo("GET", target).status, 404u) << target;
  }
  const auto snapshots = Route({.method = "GET", .target = "/snapshots", .upgrade = true}, plane_);
  EXPECT_EQ(std::get<HttpReply>(snapshots).status, 404u);
}

TEST_F(RoutesTest, TellsWhatHappenedOrSendsItAsItComes) {
  EXPECT_EQ(ReplyTo("GET", "/events").body, "{\"events\":[]}\n");
  const auto events = Route({.method = "GET", .target = "/events", .upgrade = true}, plane_);
  EXPECT_TRUE(std::holds_alternative<WatchEvents>(events));
}

TEST_F(RoutesTest, WhatHappenedIsToldAtOnceAndCounted) {
  emulator::EventRing ring;
  plane_.events = EventHistory(&ring);
  ring.Add(emulator::EventKind::kRemote, 0, {}, "L2");
  const auto told = nlohmann::json::parse(ReplyTo("GET", "/events").body)["events"];
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0]["kind"], "remote");
  ring.Add(emulator::EventKind::kRemote, 0, {}, "");
  const auto metrics = std::get<FromSnapshot>(Dut("GET", "/metrics"));
  EXPECT_THAT(metrics.reply(emulator::Snapshot{}, metrics.parts, plane_).body,
              HasSubstr("events_total{kind=\"remote\"} 2\n"));
}

TEST_F(RoutesTest, TellsTheAddressOfThePanel) {
  plane_.url = "http://127.0.0.1:7707/#token=ab";
  plane_.robots = {{.name = "left", .url = plane_.url}, {.name = "right"}};
  EXPECT_EQ(ReplyTo("GET", "/panel").body,
            "{\"url\":\"http://127.0.0.1:7707/#token=ab\",\"robots\":[{\"name\":\"left\","
            "\"url\":\"http://127.0.0.1:7707/#token=ab\"},{\"name\":\"right\",\"url\":\"\"}]}\n");
}

TEST_F(RoutesTest, ARefusalOfTheRobotIs409) {
  EXPECT_EQ(AnswerReply(Error{"not now"}).status, 409u);
  EXPECT_EQ(AnswerReply(Error{"not now"}).body, "{\"error\":\"not now\"}\n");
  EXPECT_EQ(AnswerReply({}).status, 200u);
  EXPECT_EQ(AnswerReply({}).body, "{\"ok\":true}\n");
}

}  // namespace
}  // namespace understudy::server
