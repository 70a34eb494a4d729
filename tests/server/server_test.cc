#include "server/server.h"

#include <list>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "base/errors.h"
#include "client/client.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/control.h"
#include "tests/support/requests.h"

namespace understudy::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr std::string_view kStatusRequest = "GET /status HTTP/1.1\r\nHost: x\r\n\r\n";

std::string Post(const std::string& path, const std::string& body) {
  return "POST " + path + " HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Length: " +
         std::to_string(body.size()) + "\r\n\r\n" + body;
}

class ControlServerTest : public ::testing::Test {
 protected:
  void Start(const ServerLimits& limits = {}) { dut_.emplace(path_, ThePlane(), limits); }
  Plane ThePlane() { return {.identity = {.robot = "g1"}, .board = &board_, .inbox = &inbox_}; }
  client::ControlReply Ask(const std::string& method, const std::string& path,
                           const std::string& body = "") const {
    return client::Call(path_, method, path, body, test::kBound);
  }
  // What comes back on a connection of its own until the server hangs up.
  std::string Tell(std::string_view bytes) const {
    const test::RawSocket client(path_);
    client.Send(bytes);
    return client.ReceiveAll();
  }

  test::TemporaryFolder temp_;
  const std::filesystem::path path_ = temp_.path() / "g1.sock";
  emulator::StatusBoard board_;
  emulator::Inbox inbox_;
  std::optional<ControlServer> dut_;
};

TEST_F(ControlServerTest, TellsTheStatus) {
  Start();
  emulator::Status status;
  status.steps = 12;
  board_.Post(status);
  const client::ControlReply reply = Ask("GET", "/status");
  EXPECT_EQ(reply.status, 200u);
  const auto told = nlohmann::json::parse(reply.body);
  EXPECT_EQ(told["steps"], 12);
  EXPECT_EQ(told["robot"], "g1");
  EXPECT_EQ(told["pid"], ::getpid());
}

TEST_F(ControlServerTest, OnlyItsUserMayConnect) {
  Start();
  struct stat found {};
  ASSERT_EQ(::lstat(path_.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 07777, 0600u);
}

TEST_F(ControlServerTest, ItsSocketGoesWithIt) {
  Start();
  dut_.reset();
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(ControlServerTest, ANameInUseIsAnError) {
  Start();
  EXPECT_THROW(ControlServer(path_, ThePlane()), ControlError);
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
}

TEST_F(ControlServerTest, ARequestIsCarriedOutByTheTick) {
  Start();
  std::atomic<double> lowered = 0;
  const test::Ticking ticking(&inbox_, [&](const emulator::Request& request) {
    lowered = request.number("by");
    return emulator::Answer{};
  });
  const client::ControlReply reply = Ask("POST", "/crane/lower", R"({"by": -0.5})");
  EXPECT_EQ(reply.status, 200u);
  EXPECT_EQ(reply.body, "{\"ok\":true}\n");
  EXPECT_EQ(lowered, -0.5);
}

TEST_F(ControlServerTest, ARefusedRequestIs409WithTheReason) {
  Start();
  const test::Ticking ticking(
      &inbox_, [](const emulator::Request&) { return emulator::Answer{Error{"not now"}}; });
  const client::ControlReply reply = Ask("POST", "/reset", "{}");
  EXPECT_EQ(reply.status, 409u);
  EXPECT_EQ(reply.body, "{\"error\":\"not now\"}\n");
}

TEST_F(ControlServerTest, ARequestTheRobotDoesNotComeToIs503AndNotCarriedOutLater) {
  Start({.patience = std::chrono::milliseconds{20}});
  EXPECT_EQ(Ask("POST", "/reset", "{}").status, 503u);
  int carried_out = 0;
  inbox_.Drain([&](emulator::Request*, emulator::Reply*) {
    ++carried_out;
    return emulator::Answer{};
  });
  EXPECT_EQ(carried_out, 0);
}

TEST_F(ControlServerTest, ARequestThatAStalledTickHasTakenIsNotCalledWithdrawn) {
  Start({.patience = std::chrono::milliseconds{20}});
  std::promise<void> taken, leave;
  const std::jthread tick([&] {
    for (bool found = false; !found; std::this_thread::yield()) {
      inbox_.Drain([&](emulator::Request*, emulator::Reply*) {
        found = true;
        taken.set_value();
        leave.get_future().wait_for(test::kBound);
        return emulator::Answer{};
      });
    }
  });
  const test::RawSocket waiting(path_);
  waiting.Send(Post("/reset", "{}"));
  taken.get_future().wait();
  EXPECT_EQ(Ask("POST", "/reset", "{}").status, 503u);  // all patience is over
  leave.set_value();
  EXPECT_THAT(waiting.ReceiveAll(), StartsWith("HTTP/1.1 200"));
}

TEST_F(ControlServerTest, StepsAreAnsweredWhenTheyAreMadeHoweverLongThatTakes) {
  Start({.patience = std::chrono::milliseconds{200}});
  const test::RawSocket waiting(path_);
  waiting.Send(Post("/step", "{}"));
  std::optional<emulator::Reply> kept;
  ASSERT_TRUE(test::Eventually([&] {
    inbox_.Drain(
        [&](emulator::Request*, emulator::Reply* reply) -> std::optional<emulator::Answer> {
          kept = std::move(*reply);
          return std::nullopt;
        });
    return kept.has_value();
  }));
  EXPECT_EQ(Ask("POST", "/reset", "{}").status, 503u);  // all patience is over
  kept->Give({});
  EXPECT_THAT(waiting.ReceiveAll(), StartsWith("HTTP/1.1 200"));
}

TEST_F(ControlServerTest, AFullInboxIs503) {
  Start();
  while (inbox_.Put(test::RequestOf("reset"))) continue;
  const client::ControlReply reply = Ask("POST", "/reset", "{}");
  EXPECT_EQ(reply.status, 503u);
  EXPECT_THAT(reply.body, HasSubstr("too many requests"));
}

TEST_F(ControlServerTest, ARequestThatWaitsDelaysNobody) {
  Start({.patience = test::kBound});
  const test::RawSocket waiting(path_);
  waiting.Send(Post("/reset", "{}"));
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
  ASSERT_TRUE(test::Eventually([&] {
    bool came = false;
    inbox_.Drain([&](emulator::Request*, emulator::Reply*) {
      came = true;
      return emulator::Answer{};
    });
    return came;
  }));
  EXPECT_THAT(waiting.ReceiveAll(), StartsWith("HTTP/1.1 200"));
}

TEST_F(ControlServerTest, AClientThatStallsInItsHeaderDelaysNobody) {
  Start({.idle = 10 * test::kBound});
  const test::RawSocket stalling(path_);
  stalling.Send("GET /status HTT");
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
}

TEST_F(ControlServerTest, AClientThatNeverReadsDelaysNobody) {
  Start({.idle = 10 * test::kBound});
  const test::RawSocket deaf(path_);
  std::string many;
  for (int i = 0; i < 500; ++i) many += kStatusRequest;
  // Replies far beyond what the socket's buffers hold; the requests alone do fit.
  deaf.Send(many);
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
}

TEST_F(ControlServerTest, HangsUpOnAClientThatStalls) {
  Start({.idle = std::chrono::milliseconds{50}});
  EXPECT_EQ(Tell("GET /status HTT"), "");
}

TEST_F(ControlServerTest, HangsUpOnAClientThatIsIdleAfterAReply) {
  Start({.idle = std::chrono::milliseconds{50}});
  EXPECT_THAT(Tell(kStatusRequest), StartsWith("HTTP/1.1 200"));
}

TEST_F(ControlServerTest, OutlivesAClientThatGoesWhileItsRequestWaits) {
  Start({.patience = test::kBound});
  {
    const test::RawSocket client(path_);
    client.Send(Post("/reset", "{}"));
  }
  std::atomic<int> carried_out = 0;
  const test::Ticking ticking(&inbox_, [&](const emulator::Request&) {
    ++carried_out;
    return emulator::Answer{};
  });
  ASSERT_TRUE(test::Eventually([&] { return carried_out == 1; }));
  EXPECT_EQ(Ask("POST", "/reset", "{}").status, 200u);
}

TEST_F(ControlServerTest, OutlivesAClientThatGoesAmidItsRequest) {
  Start();
  {
    const test::RawSocket client(path_);
    client.Send("POST /crane/lower HTTP/1.1\r\nContent-Length: 100\r\n\r\n{");
  }
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
}

TEST_F(ControlServerTest, EndsWhileARequestWaitsWhichMayThenStillBeAnswered) {
  Start({.patience = test::kBound});
  const test::RawSocket client(path_);
  client.Send(Post("/reset", "{}") + "x");
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
  dut_.reset();
  inbox_.Drain([](emulator::Request*, emulator::Reply*) { return emulator::Answer{}; });
}

TEST_F(ControlServerTest, KeepsAConnectionForTheNextRequest) {
  Start();
  const test::RawSocket client(path_);
  for (int i = 0; i < 3; ++i) {
    client.Send(kStatusRequest);
    EXPECT_THAT(client.Receive("}\n"), StartsWith("HTTP/1.1 200"));
  }
}

TEST_F(ControlServerTest, WhatIsNotHttpIs400WithTheReason) {
  Start();
  const std::string reply = Tell("\x16\x03\x01 what is this\r\n\r\n");
  EXPECT_THAT(reply, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(reply, HasSubstr("{\"error\":\"not an HTTP request"));
}

TEST_F(ControlServerTest, ABodyThatIsNotJsonIs400) {
  Start();
  EXPECT_THAT(Tell(Post("/crane/lower", "lower by 1")), StartsWith("HTTP/1.1 400"));
}

TEST_F(ControlServerTest, AnUnknownPathIs404) {
  Start();
  const client::ControlReply reply = Ask("GET", "/stats");
  EXPECT_EQ(reply.status, 404u);
  EXPECT_THAT(reply.body, HasSubstr("/status"));
}

TEST_F(ControlServerTest, AWrongMethodIs405AndNamesTheRightOne) {
  Start();
  const std::string reply = Tell("DELETE /reset HTTP/1.1\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(reply, StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(reply, HasSubstr("Allow: POST\r\n"));
}

TEST_F(ControlServerTest, AHeadIsAnsweredAsAGetWithoutItsBody) {
  Start();
  const std::string replies = Tell(
      "HEAD /status HTTP/1.1\r\nHost: x\r\n\r\nHEAD /reset HTTP/1.1\r\nHost: x\r\n"
      "Connection: close\r\n\r\n");
  EXPECT_THAT(replies, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(replies, HasSubstr("HTTP/1.1 405"));
  EXPECT_THAT(replies, Not(HasSubstr("Content-Length: 0\r\n")));
  EXPECT_THAT(replies, Not(HasSubstr("{")));
}

TEST_F(ControlServerTest, ABodyTooLargeIs413) {
  Start();
  const client::ControlReply reply = Ask("POST", "/crane/lower", std::string(64 * 1024 + 1, ' '));
  EXPECT_EQ(reply.status, 413u);
  EXPECT_THAT(reply.body, HasSubstr("65536 bytes"));
}

TEST_F(ControlServerTest, TheLargestBodyIsRead) {
  Start();
  EXPECT_EQ(Ask("POST", "/crane/lower", std::string(64 * 1024, ' ')).status, 400u);
}

TEST_F(ControlServerTest, AnUnendingBodyIs413) {
  Start();
  std::string request = "POST /crane/lower HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (int i = 0; i < 80; ++i) request += "400\r\n" + std::string(1024, ' ') + "\r\n";
  EXPECT_THAT(Tell(request), StartsWith("HTTP/1.1 413"));
}

TEST_F(ControlServerTest, HangsUpOnAClientThatNeverEndsWhatWasRefused) {
  Start({.idle = std::chrono::milliseconds{50}});
  const test::RawSocket client(path_);
  client.Send(Post("/crane/lower", std::string(64 * 1024 + 1, ' ')));
  EXPECT_THAT(client.ReceiveAll(), StartsWith("HTTP/1.1 413"));
  // Our side is still open: it is the server who goes.
  EXPECT_TRUE(test::Eventually([&] { return !client.Sends("more"); }));
}

TEST_F(ControlServerTest, AHeaderTooLargeIs431) {
  Start();
  EXPECT_THAT(Tell("GET /status HTTP/1.1\r\nX: " + std::string(9 * 1024, 'x') + "\r\n\r\n"),
              StartsWith("HTTP/1.1 431"));
}

TEST_F(ControlServerTest, AHeaderWithoutEndIs431) {
  Start();
  EXPECT_THAT(Tell("GET /status HTTP/1.1\r\nX: " + std::string(100 * 1024, 'x')),
              StartsWith("HTTP/1.1 431"));
}

TEST_F(ControlServerTest, TurnsAwayOneClientTooManyAndTakesTheNextOnceThereIsRoom) {
  Start({.connections = 2, .patience = test::kBound});
  std::list<test::RawSocket> clients;
  std::list<emulator::Reply> kept;  // of clients that wait for the robot
  for (std::size_t i = 1; i <= 2; ++i) {
    clients.emplace_back(path_).Send(Post("/reset", "{}"));
    ASSERT_TRUE(test::Eventually([&] {
      inbox_.Drain(
          [&](emulator::Request*, emulator::Reply* reply) -> std::optional<emulator::Answer> {
            kept.push_back(std::move(*reply));
            return std::nullopt;
          });
      return kept.size() == i;
    }));
  }
  EXPECT_THAT(Tell(""), StartsWith("HTTP/1.1 503"));
  kept.front().Give({});
  EXPECT_THAT(clients.front().ReceiveAll(), StartsWith("HTTP/1.1 200"));
  EXPECT_TRUE(test::Eventually([&] { return Ask("GET", "/status").status == 200; }));
  kept.back().Give({});
  EXPECT_THAT(clients.back().ReceiveAll(), StartsWith("HTTP/1.1 200")) << "it kept its place";
}

TEST_F(ControlServerTest, OfClientsThatAskNothingTheOneThatWasSilentLongestGivesWay) {
  Start({.connections = 2, .idle = 10 * test::kBound});
  const test::RawSocket first(path_), second(path_);
  for (const test::RawSocket* client : {&first, &second, &first}) {
    client->Send(kStatusRequest);
    ASSERT_THAT(client->Receive("}\n"), StartsWith("HTTP/1.1 200"));
  }
  EXPECT_EQ(Ask("GET", "/status").status, 200u);
  EXPECT_EQ(second.ReceiveAll(), "");
  first.Send(kStatusRequest);
  EXPECT_THAT(first.Receive("}\n"), StartsWith("HTTP/1.1 200"));
}

}  // namespace
}  // namespace understudy::server
