#include "control/routes.h"

#include "gtest/gtest.h"

namespace understudy {
namespace {

class RoutesTest : public ::testing::Test {
 protected:
  std::variant<HttpReply, Order> Dut(std::string_view method, std::string_view target,
                                     std::string_view body = "") {
    return Route({.method = method, .target = target, .body = body},
                 {.robot = "g1", .version = "", .pid = 0}, board_);
  }
  HttpReply ReplyTo(std::string_view method, std::string_view target, std::string_view body = "") {
    return std::get<HttpReply>(Dut(method, target, body));
  }

  StatusBoard board_;
};

TEST_F(RoutesTest, StatusIsThatOfTheBoard) {
  Status status;
  status.steps = 7;
  board_.Post(status);
  const HttpReply reply = ReplyTo("GET", "/status");
  EXPECT_EQ(reply.status, 200u);
  EXPECT_EQ(nlohmann::json::parse(reply.body)["steps"], 7);
  EXPECT_EQ(nlohmann::json::parse(reply.body)["robot"], "g1");
}

TEST_F(RoutesTest, LeavesAQueryAside) { EXPECT_EQ(ReplyTo("GET", "/status?x=1").status, 200u); }

TEST_F(RoutesTest, OrdersArePosted) {
  EXPECT_TRUE(std::holds_alternative<Order>(Dut("POST", "/crane", R"({"lower": 1})")));
  EXPECT_TRUE(std::holds_alternative<Order>(Dut("POST", "/clamp", R"({"on": true})")));
  EXPECT_TRUE(std::holds_alternative<Order>(Dut("POST", "/reset", "{}")));
}

TEST_F(RoutesTest, ABodyThatCannotBeReadIs400) {
  const HttpReply reply = ReplyTo("POST", "/crane", "{");
  EXPECT_EQ(reply.status, 400u);
  EXPECT_EQ(reply.body, "{\"error\":\"the body is not JSON, see byte 2\"}\n");
}

TEST_F(RoutesTest, AnUnknownPathIs404WithTheNearest) {
  const HttpReply reply = ReplyTo("GET", "/statsu");
  EXPECT_EQ(reply.status, 404u);
  EXPECT_EQ(reply.body,
            "{\"error\":\"no path /statsu; did you mean '/status'? (valid: /status, /crane, "
            "/clamp, /reset, /push, /remote)\"}\n");
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

TEST_F(RoutesTest, ARefusalOfTheRobotIs409) {
  EXPECT_EQ(AnswerReply("not now").status, 409u);
  EXPECT_EQ(AnswerReply("not now").body, "{\"error\":\"not now\"}\n");
  EXPECT_EQ(AnswerReply("").status, 200u);
  EXPECT_EQ(AnswerReply("").body, "{\"ok\":true}\n");
}

}  // namespace
}  // namespace understudy
