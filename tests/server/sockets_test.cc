// The server's TCP socket and its WebSockets, and clients that misbehave on both.
#include <fstream>
#include <future>
#include <list>
#include <thread>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "client/client.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "server/server.h"
#include "tests/support/control.h"

namespace understudy::server {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::string_view kUpgrade =
    "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

class SocketsTest : public ::testing::Test {
 protected:
  SocketsTest() {
    std::ofstream(temp_.path() / "index.html") << "<html>";
    Start();
  }
  void Start(const ServerLimits& limits = {}) {
    dut_.reset();
    dut_.emplace(path_,
                 Plane{.identity = {.robot = "g1"},
                       .board = &board_,
                       .inbox = &inbox_,
                       .snapshots = &snapshots_,
                       .files = StaticFiles(temp_.path())},
                 limits, &panel_);
  }
  std::string token() const { return dut_->url().substr(dut_->url().find('=') + 1); }
  std::string HostLine() const { return "Host: " + panel_.host() + "\r\n"; }
  // The reply to a request on the TCP socket: its first line and the rest, without the blank line.
  std::string Ask(const std::string& first, const std::string& fields) const {
    const auto client = test::RawSocket::ToPort(panel_.port());
    client->Send(first + " HTTP/1.1\r\nConnection: close\r\n" + fields + "\r\n");
    return client->ReceiveAll();
  }
  // A WebSocket on the TCP socket, once it is open.
  std::unique_ptr<test::RawSocket> Open(const std::string& target) const {
    auto client = test::RawSocket::ToPort(panel_.port());
    client->Send("GET " + target + " HTTP/1.1\r\n" + HostLine() + std::string{kUpgrade});
    EXPECT_THAT(client->Receive("\r\n\r\n"), StartsWith("HTTP/1.1 101"));
    return client;
  }
  client::ControlStream Watch(const std::string& target) const {
    return client::ControlStream(path_, target, test::kBound);
  }
  bool StillServes() const {
    return client::Call(path_, "GET", "/status", "", test::kBound).status == 200;
  }

  test::TemporaryFolder temp_;
  const std::filesystem::path path_ = temp_.path() / "g1.sock";
  emulator::StatusBoard board_;
  emulator::Inbox inbox_;
  emulator::SnapshotMailbox snapshots_{emulator::Snapshot{}};
  const PanelSocket panel_{"127.0.0.1", 0};
  std::optional<ControlServer> dut_;
};

TEST_F(SocketsTest, TellsItsAddressWithTheTokenAtTheUnixSocketOnly) {
  const client::ControlReply reply = client::Call(path_, "GET", "/panel", "", test::kBound);
  EXPECT_EQ(json::parse(reply.body)["url"], dut_->url());
  EXPECT_THAT(dut_->url(), StartsWith("http://" + panel_.host() + "/#token="));
  EXPECT_THAT(Ask("GET /panel", HostLine()), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(Ask("GET /panel", HostLine() + "Authorization: Bearer " + token() + "\r\n"),
              HasSubstr(token()));
}

TEST_F(SocketsTest, TheSameRoutesAreOnTcp) {
  EXPECT_THAT(Ask("GET /status", HostLine()), HasSubstr("\"robot\":\"g1\""));
  EXPECT_THAT(Ask("GET /", HostLine()), HasSubstr("<html>"));
  EXPECT_THAT(Ask("GET /nothing", HostLine()), StartsWith("HTTP/1.1 404"));
}

TEST_F(SocketsTest, AHeadOfAPublicRouteNeedsNoToken) {
  for (const char* route : {"HEAD /", "HEAD /status", "HEAD /requests"}) {
    const std::string reply = Ask(route, HostLine());
    EXPECT_THAT(reply, StartsWith("HTTP/1.1 200")) << route;
    EXPECT_TRUE(reply.ends_with("\r\n\r\n")) << route << ": it has a body";
  }
  EXPECT_THAT(Ask("HEAD /panel", HostLine()), StartsWith("HTTP/1.1 401"));
}

TEST_F(SocketsTest, RefusesAWriteWithoutTheToken) {
  const test::Ticking ticking(&inbox_, [](const emulator::Request&) { return emulator::Answer{}; });
  EXPECT_THAT(Ask("POST /reset", HostLine()), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(Ask("POST /reset", HostLine() + "Authorization: Bearer 0123\r\n"),
              StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(Ask("POST /reset", HostLine() + "Authorization: Bearer " + token() + "\r\n"),
              StartsWith("HTTP/1.1 200"));
}

TEST_F(SocketsTest, RefusesAPageThatIsNotItsOwn) {
  EXPECT_THAT(Ask("GET /status", "Host: evil.example\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(Ask("GET /status", ""), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(Ask("GET /status", HostLine() + HostLine()), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(Ask("GET /status", HostLine() + "Host: evil.example\r\n"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(Ask("GET /status", HostLine() + "Origin: http://evil.example\r\n"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(Ask("GET /snapshots", HostLine() + "Origin: null\r\n" + std::string{kUpgrade}),
              StartsWith("HTTP/1.1 403"));
}

TEST_F(SocketsTest, ASnapshotIsFilledInByTheTick) {
  const test::Showing tick(&snapshots_);
  const client::ControlReply reply =
      client::Call(path_, "GET", "/snapshot?parts=com", "", test::kBound);
  EXPECT_EQ(reply.status, 200u);
  EXPECT_EQ(json::parse(reply.body)["step"], 1);
  EXPECT_EQ(json::parse(reply.body).size(), 5u);
}

TEST_F(SocketsTest, ASnapshotThatDoesNotComeIs503AndALaterOneIsServed) {
  Start({.patience = std::chrono::milliseconds{20}});
  EXPECT_EQ(client::Call(path_, "GET", "/snapshot", "", test::kBound).status, 503u);
  const test::Showing tick(&snapshots_);
  EXPECT_TRUE(test::Eventually(
      [&] { return client::Call(path_, "GET", "/snapshot", "", test::kBound).status == 200; }));
}

TEST_F(SocketsTest, SnapshotsComeOnAWebSocketOneAfterTheOther) {
  const test::Showing tick(&snapshots_);
  client::ControlStream stream = Watch("/snapshots?hz=240&parts=com");
  std::int64_t last = 0;
  for (int i = 0; i < 5; ++i) {
    const std::int64_t step = json::parse(stream.Next())["step"];
    EXPECT_GT(step, last);
    last = step;
  }
}

TEST_F(SocketsTest, AWatcherGetsNoMoreSnapshotsThanItAskedFor) {
  const test::Showing tick(&snapshots_);
  client::ControlStream slow = Watch("/snapshots?hz=1");
  slow.Next();
  client::ControlStream quick = Watch("/snapshots?hz=240");
  for (int i = 0; i < 20; ++i) quick.Next();  // nothing is filled in for the slow one meanwhile
  const std::int64_t quickest = json::parse(quick.Next())["step"];
  EXPECT_LE(quickest, 60);
}

TEST_F(SocketsTest, AnyNumberWatchAtOnce) {
  const test::Showing tick(&snapshots_);
  std::list<client::ControlStream> watchers;
  for (int i = 0; i < 20; ++i) watchers.push_back(Watch("/snapshots?hz=60"));
  for (client::ControlStream& watcher : watchers)
    EXPECT_THAT(watcher.Next(), StartsWith("{\"step\":"));
}

TEST_F(SocketsTest, WhoWatchesOnTcpNeedsNoToken) {
  const test::Showing tick(&snapshots_);
  EXPECT_THAT(Open("/snapshots?parts=com")->Receive("}"), HasSubstr("\"com\":["));
}

TEST_F(SocketsTest, SaysWhyAWebSocketIsRefused) {
  try {
    Watch("/snapshots?parts=motor");
    FAIL();
  } catch (const ControlError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'motors'?"));
  }
}

TEST_F(SocketsTest, RequestsOnAWebSocketAreAnsweredInTheirTurn) {
  const test::Ticking ticking(&inbox_, [](const emulator::Request& request) {
    return request.row->name == "reset" ? emulator::Answer{Error{"not now"}} : emulator::Answer{};
  });
  client::ControlStream stream = Watch("/requests");
  stream.Send(R"({"crane.lower": {"by": 0.1}, "id": 1})");
  stream.Send(R"({"id": "two", "reset": {}})");
  stream.Send(R"({"clamp": {"on": 3}})");
  EXPECT_EQ(stream.Next(), R"({"id":1,"status":200,"ok":true})");
  EXPECT_EQ(stream.Next(), R"({"id":"two","status":409,"error":"not now"})");
  EXPECT_EQ(stream.Next(),
            R"({"id":null,"status":400,"error":"on: expected true or false, got 3"})");
}

TEST_F(SocketsTest, AStepThatIsWaitedForHoldsUpNoOtherRequestOfItsWebSocket) {
  std::promise<emulator::Reply> waiting;
  const std::jthread tick([&](const std::stop_token& stop) {
    for (; !stop.stop_requested(); std::this_thread::sleep_for(std::chrono::milliseconds{1})) {
      inbox_.Drain([&](emulator::Request* request, emulator::Reply* reply) {
        if (!request->waits()) return std::optional(emulator::Answer{});
        waiting.set_value(std::move(*reply));
        return std::optional<emulator::Answer>{};
      });
    }
  });
  client::ControlStream stream = Watch("/requests");
  stream.Send(R"({"step": {"steps": 1000}, "id": 1})");
  stream.Send(R"({"clamp": {"on": true}, "id": 2})");
  stream.Send(R"({"clamp": {"on": 5}, "id": 3})");
  EXPECT_EQ(stream.Next(), R"({"id":2,"status":200,"ok":true})");
  EXPECT_THAT(stream.Next(), StartsWith(R"({"id":3,"status":400,)"));
  waiting.get_future().get().Give({});
  EXPECT_EQ(stream.Next(), R"({"id":1,"status":200,"ok":true})");
}

TEST_F(SocketsTest, WhatIsNoRequestIsAnsweredWithTheReason) {
  client::ControlStream stream = Watch("/requests");
  const std::string deep(30'000, '[');
  for (const std::string& message :
       {std::string{"x"}, std::string{}, std::string{"[]"}, std::string{"{}"}, deep,
        "{\"push\": " + deep + "}", "{\"push\": {}, \"id\": " + deep + "}",
        std::string{R"({"id": 1})"}, std::string{R"({"pause": {}, "resume": {}})"}}) {
    stream.Send(message);
    EXPECT_EQ(json::parse(stream.Next())["status"], 400) << message.substr(0, 40);
  }
  stream.Send(R"({"statsu": {}})");
  EXPECT_THAT(stream.Next(), HasSubstr("no request"));
}

TEST_F(SocketsTest, RequestsOnTcpNeedTheToken) {
  for (const std::string target : {"/requests", "/requests?token=0"}) {
    const auto client = test::RawSocket::ToPort(panel_.port());
    client->Send("GET " + target + " HTTP/1.1\r\n" + HostLine() + std::string{kUpgrade});
    EXPECT_THAT(client->Receive("\r\n\r\n"), StartsWith("HTTP/1.1 401")) << target;
  }
  Open("/requests?token=" + token());
}

// A client with the token of a panel on a network must not write any file of its user.
TEST_F(SocketsTest, OnTcpARecordingHasAPlainNameOnly) {
  const test::Ticking ticking(&inbox_, [](const emulator::Request&) { return emulator::Answer{}; });
  client::ControlStream here = Watch("/requests");
  for (const std::string file : {"/etc/x.mcap", "../x.mcap", "a/x.mcap", ".x.mcap", "x.txt"}) {
    const std::string body = R"({"file": ")" + file + R"("})";
    const std::string request = R"({"record.start": )" + body + "}";
    const auto there = Open("/requests?token=" + token());
    // A text, masked by zeros.
    there->Send("\x81" + std::string(1, static_cast<char>(0x80 | request.size())) +
                std::string(4, '\0') + request);
    EXPECT_THAT(there->Receive("}"), HasSubstr("403")) << file;
    const std::string length = "Content-Length: " + std::to_string(body.size()) + "\r\n";
    const auto post = test::RawSocket::ToPort(panel_.port());
    post->Send("POST /record/start HTTP/1.1\r\nConnection: close\r\n" + HostLine() +
               "Authorization: Bearer " + token() + "\r\n" + length + "\r\n" + body);
    EXPECT_THAT(post->ReceiveAll(), StartsWith("HTTP/1.1 403")) << file;
    here.Send(request);
    EXPECT_EQ(json::parse(here.Next())["status"], 200) << file;
  }
}

TEST_F(SocketsTest, ClientsThatSendNothingOrReadNothingDoNotShutOutTheOwner) {
  std::ofstream(temp_.path() / "large.bin") << std::string(15 << 20, 'x');  // beyond all buffers
  const test::Ticking ticking(&inbox_, [](const emulator::Request&) { return emulator::Answer{}; });
  const std::string half = "GET / HTT",
                    large = "GET /panel/large.bin HTTP/1.1\r\n" + HostLine() + "\r\n";
  for (const std::string& sent : {std::string{}, half, large}) {
    Start({.connections = 2, .idle = 10 * test::kBound});
    std::list<std::unique_ptr<test::RawSocket>> strangers;
    for (int i = 0; i < 3; ++i) {
      strangers.push_back(test::RawSocket::ToPort(panel_.port()));
      strangers.back()->Send(sent);
      if (sent == large) strangers.back()->Receive("xx");
    }
    EXPECT_THAT(Ask("POST /reset", HostLine() + "Authorization: Bearer " + token() + "\r\n"),
                StartsWith("HTTP/1.1 200"))
        << sent;
  }
}

// A page on a slow line that loads a recording.
TEST_F(SocketsTest, WhoHasTheTokenMayReadSlowly) {
  std::ofstream(temp_.path() / "large.bin") << std::string(15 << 20, 'x');
  Start({.connections = 1, .idle = 10 * test::kBound});
  const auto owner = test::RawSocket::ToPort(panel_.port());
  owner->Send("GET /panel/large.bin HTTP/1.1\r\nConnection: close\r\n" + HostLine() +
              "Authorization: Bearer " + token() + "\r\n\r\n");
  owner->Receive("xx");
  EXPECT_THAT(Ask("GET /", HostLine()), StartsWith("HTTP/1.1 503"));
}

TEST_F(SocketsTest, HangsUpOnFramesThatAreNone) {
  const test::Showing tick(&snapshots_);
  for (const std::string_view bytes :
       {std::string_view{"\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff", 14},
        std::string_view{"\x81\x05hello", 7},                                      // not masked
        std::string_view{"\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14},  // of 2^63 bytes
        std::string_view{"\x83\x80\0\0\0\0", 6}, std::string_view{"\xc1\x80\0\0\0\0", 6},
        std::string_view{"\x89\xfe\xff\xff\0\0\0\0", 8},     // a ping of 64 kB
        std::string_view{"\x81\x82\0\0\0\0\xff\xfe", 8}}) {  // no UTF-8
    for (const std::string target : {"/snapshots?parts=com", "/requests?token="}) {
      const auto client = Open(target.ends_with('=') ? target + token() : target);
      client->Send(bytes);
      client->ReceiveAll();
    }
  }
  EXPECT_TRUE(StillServes());
}

TEST_F(SocketsTest, AMessageTooLongEndsItsWebSocketAlone) {
  client::ControlStream stream = Watch("/requests");
  EXPECT_THROW(
      {
        stream.Send(std::string(65 * 1024, ' '));
        stream.Next();
      },
      ControlError);
  EXPECT_TRUE(StillServes());
}

TEST_F(SocketsTest, AWatcherThatNeverReadsIsHungUpOnAndDelaysNobody) {
  Start({.silence = std::chrono::milliseconds{300}});
  const test::Showing tick(&snapshots_);
  const auto deaf = Open("/snapshots?hz=240");
  client::ControlStream other = Watch("/snapshots?hz=240");
  for (int i = 0; i < 10; ++i) other.Next();
  // It answers no ping.
  const std::string all = deaf->ReceiveAll();
  EXPECT_THAT(all, HasSubstr("\"step\""));
}

TEST_F(SocketsTest, AWatcherThatReadsStays) {
  Start({.silence = std::chrono::milliseconds{500}});
  const test::Showing tick(&snapshots_);
  client::ControlStream stream = Watch("/snapshots?hz=100");
  for (int i = 0; i < 60; ++i) stream.Next();
}

TEST_F(SocketsTest, OutlivesWatchersThatGoWithoutAWord) {
  const test::Showing tick(&snapshots_);
  for (int i = 0; i < 20; ++i) Open("/snapshots?hz=240")->Close();
  for (int i = 0; i < 20; ++i) Open("/requests?token=" + token())->Close();
  EXPECT_TRUE(StillServes());
}

TEST_F(SocketsTest, EndsWhileItIsWatched) {
  const test::Showing tick(&snapshots_);
  client::ControlStream watched = Watch("/snapshots");
  watched.Next();
  client::ControlStream asking = Watch("/requests");
  asking.Send(R"({"reset": {}})");
  dut_.reset();
  EXPECT_THROW(for (;;) watched.Next(), ControlError);
}

TEST_F(SocketsTest, AFullDoorLeavesTheOtherOpen) {
  Start({.connections = 2});
  const auto one = Open("/events?token=" + token()), two = Open("/events?token=" + token());
  EXPECT_THAT(Ask("GET /status", HostLine()), StartsWith("HTTP/1.1 503"));
  EXPECT_TRUE(StillServes());
}

TEST_F(SocketsTest, KeepsPlacesForTheToken) {
  Start({.connections = 8});
  std::list<std::unique_ptr<test::RawSocket>> strangers;
  for (int i = 0; i < 6; ++i) strangers.push_back(Open("/events"));
  const auto one_more = test::RawSocket::ToPort(panel_.port());
  one_more->Send("GET /events HTTP/1.1\r\n" + HostLine() + std::string{kUpgrade});
  EXPECT_THAT(one_more->Receive("\r\n\r\n"), StartsWith("HTTP/1.1 503"));
  EXPECT_THAT(Ask("GET /", HostLine()), HasSubstr("<html>"));
  const auto owner = Open("/events?token=" + token());
  strangers.pop_front();
  EXPECT_TRUE(test::Eventually([&] {
    const auto next = test::RawSocket::ToPort(panel_.port());
    next->Send("GET /events HTTP/1.1\r\n" + HostLine() + std::string{kUpgrade});
    return next->Receive("\r\n\r\n").starts_with("HTTP/1.1 101");
  }));
}

TEST_F(SocketsTest, OutlivesThousandsOfConnections) {
  for (int i = 0; i < 3000; ++i) test::RawSocket::ToPort(panel_.port())->Send("GET ");
  EXPECT_TRUE(
      test::Eventually([&] { return Ask("GET /status", HostLine()).starts_with("HTTP/1.1 200"); }));
}

TEST_F(SocketsTest, WhoSendsFarTooMuchReadsWhyOnceItIsSent) {
  const auto client = test::RawSocket::ToPort(panel_.port());
  const std::string body(20 << 20, ' ');
  client->Send("POST /push HTTP/1.1\r\n" + HostLine() +
               "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n");
  client->Send(body);
  EXPECT_THAT(client->ReceiveAll(), StartsWith("HTTP/1.1 413"));
}

TEST_F(SocketsTest, AHugeHeaderIs431) {
  EXPECT_THAT(Ask("GET /status", HostLine() + "X: " + std::string(9 * 1024, 'x') + "\r\n"),
              StartsWith("HTTP/1.1 431"));
}

}  // namespace
}  // namespace understudy::server
