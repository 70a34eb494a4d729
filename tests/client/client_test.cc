#include "client/client.h"

#include <fstream>
#include <memory>
#include <thread>

#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "client/listening_socket.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "server/server.h"
#include "tests/support/control.h"

namespace understudy::client {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ClientTest : public ::testing::Test {
 protected:
  test::TemporaryFolder temp_;
  test::ScopedEnv folder_{"UNDERSTUDY_RUNTIME_DIR", temp_.path().string()};
  const std::filesystem::path path_ = temp_.path() / "g1.sock";
};

TEST_F(ClientTest, FindsTheRobotsByName) {
  const ListeningSocket second(temp_.path() / "two.sock");
  const ListeningSocket first(temp_.path() / "one.sock");
  const std::vector<RunningRobot> robots = FindRobots();
  ASSERT_EQ(robots.size(), 2u);
  EXPECT_EQ(robots[0].name, "one");
  EXPECT_EQ(robots[0].socket, temp_.path() / "one.sock");
  EXPECT_EQ(robots[0].pid, ::getpid());
  EXPECT_EQ(robots[1].name, "two");
}

TEST_F(ClientTest, CleansUpAfterDeadRobots) {
  test::LeaveStaleSocket(path_);
  EXPECT_TRUE(FindRobots().empty());
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(ClientTest, PassesOverWhatIsNoSocket) {
  std::ofstream(path_) << "a file";
  std::ofstream(temp_.path() / "notes.txt") << "another";
  EXPECT_TRUE(FindRobots().empty());
  EXPECT_TRUE(std::filesystem::exists(path_));
}

TEST_F(ClientTest, FindsNobodyWhereThereIsNoFolder) {
  const test::ScopedEnv folder("UNDERSTUDY_RUNTIME_DIR", (temp_.path() / "missing").string());
  EXPECT_TRUE(FindRobots().empty());
  EXPECT_FALSE(std::filesystem::exists(temp_.path() / "missing"));
}

TEST_F(ClientTest, DoesNotLookIntoAFolderThatOthersShare) {
  ::chmod(temp_.path().c_str(), 0777);
  EXPECT_THROW(FindRobots(), ControlError);
}

TEST_F(ClientTest, SaysWhenNobodyIsThere) {
  EXPECT_THAT([&] { Call(path_, "GET", "/status", "", test::kBound); },
              ThrowsMessage<ControlError>(HasSubstr("no robot answers at " + path_.string())));
}

TEST_F(ClientTest, SaysWhenTheRobotIsDead) {
  test::LeaveStaleSocket(path_);
  EXPECT_THAT([&] { Call(path_, "GET", "/status", "", test::kBound); },
              ThrowsMessage<ControlError>(HasSubstr("refused")));
}

TEST_F(ClientTest, DoesNotWaitForeverForARobotThatHangs) {
  const ListeningSocket hanging(path_);
  EXPECT_THAT([&] { Call(path_, "GET", "/status", "", milliseconds{30}); },
              ThrowsMessage<ControlError>(HasSubstr("did not answer within 30 ms")));
}

TEST_F(ClientTest, SaysWhenWhatComesBackIsNoHttp) {
  const ListeningSocket listening(path_);
  std::thread other([&] {
    const int fd = ::accept(listening.fd(), nullptr, nullptr);
    [[maybe_unused]] const ssize_t sent = ::send(fd, "SSH-2.0\r\n\r\n", 11, MSG_NOSIGNAL);
    ::close(fd);
  });
  EXPECT_THAT([&] { Call(path_, "GET", "/status", "", test::kBound); },
              ThrowsMessage<ControlError>(HasSubstr("broke off")));
  other.join();
}

TEST_F(ClientTest, AsksAgainAndAgainOnOneConnection) {
  emulator::StatusBoard board;
  emulator::Inbox inbox;
  int drained = 0;
  const test::Ticking robot(&inbox, [&](const emulator::Request&) {
    return ++drained < 3 ? emulator::Answer{} : Error{"enough"};
  });
  const server::ControlServer server(
      path_, {.identity = {.robot = "g1"}, .board = &board, .inbox = &inbox}, {.connections = 1});
  ControlConnection connection(path_, test::kBound);
  EXPECT_EQ(connection.Ask("POST", "/clamp", R"({"on": true})", test::kBound).status, 200u);
  EXPECT_EQ(connection.Ask("POST", "/clamp", "{", test::kBound).status, 400u);
  EXPECT_EQ(connection.Ask("POST", "/clamp", R"({"on": true})", test::kBound).status, 200u);
  EXPECT_THAT(connection.Ask("POST", "/clamp", R"({"on": true})", test::kBound, true).body,
              HasSubstr("enough"));
}

TEST_F(ClientTest, SaysWhenTheRobotWentMeanwhile) {
  emulator::StatusBoard board;
  emulator::Inbox inbox;
  auto server = std::make_unique<server::ControlServer>(
      path_, server::Plane{.identity = {.robot = "g1"}, .board = &board, .inbox = &inbox});
  ControlConnection connection(path_, test::kBound);
  EXPECT_EQ(connection.Ask("GET", "/status", "", test::kBound).status, 200u);
  server.reset();
  EXPECT_THAT([&] { connection.Ask("GET", "/status", "", test::kBound); },
              ThrowsMessage<ControlError>(HasSubstr("broke off")));
}

TEST_F(ClientTest, RefusesAPathTooLong) {
  EXPECT_THROW(Call(std::string(200, 'x'), "GET", "/status", "", test::kBound), ControlError);
}

}  // namespace
}  // namespace understudy::client
