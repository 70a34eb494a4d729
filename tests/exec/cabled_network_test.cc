// Tests two private networks that a cable joins: its ends, what goes over it, whose rights they
// have.
#include <cstdint>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/ip_icmp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "exec/capabilities.h"
#include "exec/child_process.h"
#include "exec/private_network.h"
#include "forked.h"
#include "network_fixture.h"

namespace understudy::exec {
namespace {

using ::testing::HasSubstr;
using ::understudy::test::Forked;
using ::understudy::test::InFork;
using ::understudy::test::Pipe;
using ::understudy::test::ReachesEnd;
using ::understudy::test::ReadLine;
using ::understudy::test::WriteLine;

TEST_P(PrivateNetworkTest, HasACardOfTheWantedNameAndAddressAtTheProgramsEndOfACable) {
  EXPECT_EQ(OnCable(&Interfaces), "2: eth0 192.168.123.99/24 up multicast;lo 127.0.0.1/8 up;");
}

TEST_P(PrivateNetworkTest, HasTheRobotsAddressAtTheOtherEndOfACable) {
  Pipe told;
  OnCable([] { return std::string(); },
          [&](const std::function<void()>& go) {
            WriteLine(told.in.get(), Interfaces());
            go();
          });
  EXPECT_EQ(ReadLine(told.out.get()), "2: eth0 192.168.123.161/24 up multicast;lo 127.0.0.1/8 up;");
}

TEST_P(PrivateNetworkTest, CarriesMulticastOverACableForProgramsThatNameNoInterface) {
  EXPECT_EQ(OnCable(
                [] {
                  GroupSocket socket;
                  socket.Send("hello");
                  const std::string own = socket.Receive();
                  return own + ", " + socket.Receive();
                },
                [](const std::function<void()>& go) {
                  GroupSocket socket;
                  go();
                  socket.Send("robot heard " + socket.Receive());
                }),
            "hello, robot heard hello");
}

// An echo request as ping(8) sends it without rights, and what comes back.
std::string Ping(const char* address) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM, IPPROTO_ICMP));
  Check(socket.valid(), "socket for ping");
  const sockaddr_in to = Address(address, 0);
  icmphdr request{};
  request.type = ICMP_ECHO;
  Check(::sendto(socket.get(), &request, sizeof(request), 0, Generic(to), sizeof(to)) ==
            sizeof(request),
        "sending an echo request");
  pollfd wanted{.fd = socket.get(), .events = POLLIN, .revents = 0};
  if (::poll(&wanted, 1, 5000) != 1) return "no answer";
  icmphdr answer{};
  Check(::recv(socket.get(), &answer, sizeof(answer), 0) == sizeof(answer), "receive");
  return answer.type == ICMP_ECHOREPLY ? "answers" : "another message";
}

TEST_P(PrivateNetworkTest, LetsTheRobotAnswerAPingWithoutRights) {
  EXPECT_EQ(OnCable([] { return Ping(kRobotAddress); }), "answers");
}

TEST_P(PrivateNetworkTest, LeavesNeitherEndOfACableARightThatWasNotThere) {
  const auto told = [](const Capabilities& some) {
    return std::to_string(some.effective) + " " + std::to_string(some.permitted) + " " +
           std::to_string(some.inheritable) + " " + std::to_string(some.bounding);
  };
  const std::string before = InFork([&] {
    Take(GetParam());
    return told(Capabilities::OfThisThread());
  });
  Pipe robot;
  const std::string program =
      OnCable([&] { return told(Capabilities::OfThisThread()); },
              [&](const std::function<void()>& go) {
                WriteLine(robot.in.get(), told(Capabilities::OfThisThread()));
                go();
              });
  EXPECT_EQ(program, before);
  EXPECT_EQ(ReadLine(robot.out.get()), before);
}

TEST_P(PrivateNetworkTest, GivesACommandOnACableItsRightsAndADeathWithUs) {
  Pipe pipe;
  Forked parent([&] {
    Take(GetParam());
    Check(::dup2(pipe.in.get(), 9) == 9, "descriptor 9");
    pipe.in.reset();
    CabledNetwork network({.interface = "eth0", .address = "192.168.123.99"});
    ChildProcess child(
        {"sh", "-c", "trap '' TERM; grep CapEff /proc/self/status >&9; exec sleep 60"}, {}, -1, -1,
        &network.rights());
    network.MoveToRobot();
    ::close(9);
    child.Release();
    return std::to_string(child.Wait());
  });
  pipe.in.reset();
  const std::string rights = ReadLine(pipe.out.get());
  if (GetParam() == Rights::kOrdinaryUser) {
    EXPECT_EQ(rights, "CapEff:\t0000000000000000");
  }
  parent.Kill();
  EXPECT_TRUE(ReachesEnd(pipe.out.get()));
}

TEST_P(PrivateNetworkTest, KeepsTheRobotsEndOfACableWhenTheProgramHasEnded) {
  EXPECT_EQ(InFork([] {
              Take(GetParam());
              CabledNetwork network({.interface = "eth0", .address = "192.168.123.99"});
              Forked program([] { return std::string(); });
              network.MoveToRobot();
              program.Result();
              ::usleep(200'000);  // the kernel takes apart what nobody holds some time later
              return Interfaces();
            }),
            "2: eth0 192.168.123.161/24 up multicast;lo 127.0.0.1/8 up;");
}

TEST(CableEndTest, HasANameThatALinuxInterfaceCanHave) {
  for (const char* name : {"eth0", "enp3s0", "wlx00c0caa1b2c3", "br-lan", "eth0.100", "a_b", "0"}) {
    EXPECT_EQ(WhyNoInterface(name), "") << name;
  }
  for (const char* name : {"", "abcdefghijklmnop", "a/b", "a b", "a:1", "eth%d", ".", "..", "-e",
                           "a\"b", "a<b", "\xc3\xa9th0", "all", "default"}) {
    EXPECT_THAT(WhyNoInterface(name), HasSubstr("expected a letter or digit")) << name;
  }
  EXPECT_THAT(WhyNoInterface("lo"), HasSubstr("'lo' is in every network"));
}

TEST(CableEndTest, HasAnAddressBesideTheRobots) {
  for (const char* address :
       {"192.168.123.99/24", "192.168.123.99", "192.168.123.1", "192.168.123.254/24"}) {
    EXPECT_EQ(WhyNoCableAddress(address), "") << address;
  }
  for (const char* address : {"192.168.123.161", "192.168.123.161/24"}) {
    EXPECT_THAT(WhyNoCableAddress(address), HasSubstr("is the robot's; expected 192.168.123.N"));
  }
  for (const char* address :
       {"10.0.0.1/24", "192.168.124.99", "192.168.123.0", "192.168.123.255"}) {
    EXPECT_THAT(WhyNoCableAddress(address), HasSubstr("is not in the network of the robot"))
        << address;
  }
  for (const char* address : {"", "/24", "192.168.123", "192.168.123.256", "192.168.123.99/16",
                              "192.168.123.99/24/24", "192.168.123.99 ", "fe80::1", "robot"}) {
    EXPECT_THAT(WhyNoCableAddress(address), HasSubstr("is no IPv4 address")) << address;
  }
}

}  // namespace
}  // namespace understudy::exec
