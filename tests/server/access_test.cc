#include "server/access.h"

#include "gtest/gtest.h"

namespace understudy::server {
namespace {

class AccessTest : public ::testing::Test {
 protected:
  // Of the refusal, or 200.
  unsigned Dut(HttpRequest request) const {
    if (request.method.empty()) request.method = "GET";
    if (request.target.empty()) request.target = "/status";
    const auto refusal = RefusalOf(request, access_);
    return refusal ? refusal->status : 200;
  }
  unsigned OfHost(std::string_view host) const {
    return Dut({.method = "GET", .target = "/status", .host = host});
  }

  AccessRules access_{.token = "0123456789abcdef0123456789abcdef", .address = "127.0.0.1"};
};

TEST_F(AccessTest, ATokenIs128BitsOfChance) {
  const std::string token = RandomToken();
  EXPECT_EQ(token.size(), 32u);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(token, RandomToken());
}

TEST_F(AccessTest, TakesTheNamesOfThisMachine) {
  for (const char* host : {"localhost:7707", "localhost", "LOCALHOST:1", "127.0.0.1:7707",
                           "127.1.2.3", "[::1]:7707", "[::1]"}) {
    EXPECT_EQ(OfHost(host), 200u) << host;
  }
}

TEST_F(AccessTest, RefusesEveryOtherHost) {
  for (const char* host : {"", "evil.example:7707", "localhost.evil.example", "127.evil.example",
                           "127.0.0.1.evil.example", "10.0.0.1:7707", "[", "[]", ":", "[::2]",
                           "localhost:7707 x", "localhost:x", "user@localhost", "localhost:7707:1",
                           "localhost:123456", "[::1]x", "[::1]:7707/"}) {
    EXPECT_EQ(OfHost(host), 403u) << host;
  }
}

TEST_F(AccessTest, BoundToEveryAddressTakesAnyAddressAndStillNoName) {
  access_.address = "0.0.0.0";
  EXPECT_EQ(OfHost("192.168.1.7:7707"), 200u);
  EXPECT_EQ(OfHost("evil.example:7707"), 403u);
}

TEST_F(AccessTest, BoundToOneTakesThatOne) {
  access_.address = "192.168.1.7";
  EXPECT_EQ(OfHost("192.168.1.7:7707"), 200u);
  EXPECT_EQ(OfHost("192.168.1.8:7707"), 403u);
}

TEST_F(AccessTest, RefusesTheOriginOfAnotherPage) {
  HttpRequest request{.method = "GET", .target = "/status", .host = "localhost:7707"};
  request.origin = "http://localhost:7707";
  EXPECT_EQ(Dut(request), 200u);
  for (const char* origin : {"http://evil.example", "null", "https://localhost:7707",
                             "http://localhost:3000", "http://127.0.0.1:7707"}) {
    request.origin = origin;
    EXPECT_EQ(Dut(request), 403u) << origin;
  }
}

TEST_F(AccessTest, RefusesAWriteWithoutTheToken) {
  HttpRequest request{.method = "POST", .target = "/push", .host = "localhost"};
  for (const char* authorization :
       {"", "Bearer", "Bearer ", "Bearer 0123", "Basic 0123456789abcdef0123456789abcdef",
        "Bearer 0123456789abcdef0123456789abcdee", "Bearer 0123456789abcdef0123456789abcdef0"}) {
    request.authorization = authorization;
    EXPECT_EQ(Dut(request), 401u) << authorization;
  }
  request.authorization = "Bearer 0123456789abcdef0123456789abcdef";
  EXPECT_EQ(Dut(request), 200u);
}

TEST_F(AccessTest, TheTableOfRequestsIsOpenAndMakingThemIsNot) {
  HttpRequest request{.method = "GET", .target = "/requests", .host = "localhost"};
  EXPECT_EQ(Dut(request), 200u);
  request.upgrade = true;
  EXPECT_EQ(Dut(request), 401u);
}

TEST_F(AccessTest, ATokenInTheAddressIsForWebSocketsOnly) {
  HttpRequest request{.method = "GET",
                      .target = "/panel?token=0123456789abcdef0123456789abcdef",
                      .host = "localhost"};
  EXPECT_EQ(Dut(request), 401u);
  request.target = "/requests?token=0123456789abcdef0123456789abcdef";
  request.upgrade = true;
  EXPECT_EQ(Dut(request), 200u);
  request.target = "/requests?token=x";
  EXPECT_EQ(Dut(request), 401u);
  request.method = "POST";
  request.upgrade = false;
  request.target = "/reset?token=0123456789abcdef0123456789abcdef";
  EXPECT_EQ(Dut(request), 401u);
}

TEST_F(AccessTest, DoesNotTellTheTokenToWhoHasItNot) {
  EXPECT_EQ(Dut({.method = "GET", .target = "/panel?x", .host = "localhost"}), 401u);
  EXPECT_EQ(Dut({.method = "GET", .target = "/cameras/front", .host = "localhost"}), 401u);
  EXPECT_EQ(Dut({.method = "GET", .target = "/lidar/cloud", .host = "localhost"}), 401u);
}

TEST_F(AccessTest, LooksAtNothingButTheLengthOfAnEmptyToken) {
  access_.token = "";
  EXPECT_EQ(
      Dut({.method = "POST", .target = "/reset", .host = "localhost", .authorization = "Bearer "}),
      401u);
}

}  // namespace
}  // namespace understudy::server
