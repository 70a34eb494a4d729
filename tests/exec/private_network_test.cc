// Tests a private network: its loopback, what it hides, whose rights it has.
#include "exec/private_network.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "exec/capabilities.h"
#include "exec/child_process.h"
#include "forked.h"
#include "network_fixture.h"
#include "tests/support/temporary_folder.h"

namespace understudy::exec {
namespace {

using ::understudy::test::Forked;
using ::understudy::test::InFork;
using ::understudy::test::Pipe;
using ::understudy::test::ReachesEnd;
using ::understudy::test::ReadLine;
using ::understudy::test::WriteLine;

INSTANTIATE_TEST_SUITE_P(, PrivateNetworkTest,
                         ::testing::Values(Rights::kAsStarted, Rights::kOrdinaryUser,
                                           Rights::kRootOfAContainer),
                         ::testing::PrintToStringParamName());

TEST_P(PrivateNetworkTest, HasNoInterfaceButLo) {
  EXPECT_EQ(Inside([] {
              std::string names;
              struct if_nameindex* all = ::if_nameindex();
              for (auto* entry = all; entry->if_index != 0; ++entry) {
                names += std::string(entry->if_name) + ";";
              }
              ::if_freenameindex(all);
              return names;
            }),
            "lo;");
}

TEST_P(PrivateNetworkTest, HasLoUpWithMulticastAndItsAddress) {
  EXPECT_EQ(Inside([] {
              const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM, 0));
              ifreq request{};
              std::strcpy(request.ifr_name, "lo");
              Check(::ioctl(socket.get(), SIOCGIFFLAGS, &request) == 0, "flags");
              constexpr int kWanted = IFF_UP | IFF_RUNNING | IFF_MULTICAST | IFF_LOOPBACK;
              const bool flags = (request.ifr_flags & kWanted) == kWanted;
              Check(::ioctl(socket.get(), SIOCGIFADDR, &request) == 0, "address");
              sockaddr_in address{};
              std::memcpy(&address, &request.ifr_addr, sizeof(address));
              return std::string(flags ? "up " : "down ") + ::inet_ntoa(address.sin_addr);
            }),
            "up 127.0.0.1");
}

TEST_P(PrivateNetworkTest, LoopsMulticastBackToProgramsThatNameNoInterface) {
  EXPECT_EQ(Inside([] {
              GroupSocket socket;
              socket.Send("hello");
              return socket.Receive();
            }),
            "hello");
}

TEST_P(PrivateNetworkTest, LeavesTheUserWhoHeIs) {
  EXPECT_EQ(InFork([] {
              Take(GetParam());
              const uid_t uid = ::getuid();
              const gid_t gid = ::getgid();
              EnterPrivateNetwork();
              const bool same = ::getuid() == uid && ::geteuid() == uid && ::getgid() == gid &&
                                ::getegid() == gid;
              return std::string(same ? "same" : "changed");
            }),
            "same");
}

TEST_P(PrivateNetworkTest, GivesNoRightThatWasNotThere) {
  EXPECT_EQ(InFork([] {
              Take(GetParam());
              const Capabilities before = Capabilities::OfThisThread();
              EnterPrivateNetwork();
              const Capabilities after = Capabilities::OfThisThread();
              const bool same =
                  after.effective == before.effective && after.permitted == before.permitted &&
                  after.inheritable == before.inheritable && after.bounding == before.bounding;
              return std::string(same ? "same" : "changed");
            }),
            "same");
}

TEST_P(PrivateNetworkTest, IsDeafToAnotherOne) {
  Pipe to_listener;
  Pipe from_listener;
  Forked listener([&] {
    Take(GetParam());
    EnterPrivateNetwork();
    GroupSocket socket;
    WriteLine(from_listener.in.get(), "listening");
    ReadLine(to_listener.out.get());
    socket.Send("own");  // what a hearing neighbour got before this would come first
    return socket.Receive();
  });
  from_listener.in.reset();
  ASSERT_EQ(ReadLine(from_listener.out.get()), "listening");
  EXPECT_EQ(Inside([] {
              GroupSocket socket;
              socket.Send("foreign");
              return socket.Receive();
            }),
            "foreign");
  WriteLine(to_listener.in.get(), "go on");
  EXPECT_EQ(listener.Result(), "own");
}

TEST_P(PrivateNetworkTest, DoesNotReachTheMachinesLoopback) {
  const UniqueFd outside(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in address = Address("127.0.0.1", 0);
  ASSERT_EQ(::bind(outside.get(), Generic(address), sizeof(address)), 0);
  socklen_t size = sizeof(address);
  ASSERT_EQ(::getsockname(outside.get(), reinterpret_cast<sockaddr*>(&address), &size), 0);
  EXPECT_EQ(Inside([&] {
              const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM, 0));
              Check(::connect(socket.get(), Generic(address), sizeof(address)) == 0, "connect");
              Check(::send(socket.get(), "x", 1, 0) == 1, "send");
              pollfd wanted{.fd = socket.get(), .events = POLLIN, .revents = 0};
              ::poll(&wanted, 1, 5000);  // the refusal comes back as an error of the socket
              char letter = 0;
              ::recv(socket.get(), &letter, 1, MSG_DONTWAIT);
              return std::string(std::strerror(errno));
            }),
            "Connection refused");
}

// A unix socket that listens; `name` begins with a zero byte for an abstract one.
std::string ConnectFromInside(const std::string& name,
                              std::string (*inside)(const std::function<std::string()>&)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, name.data(), name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  const UniqueFd server(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  Check(::bind(server.get(), generic, size) == 0 && ::listen(server.get(), 1) == 0, "listen");
  return inside([&] {
    const UniqueFd client(::socket(AF_UNIX, SOCK_STREAM, 0));
    const bool reached = ::connect(client.get(), generic, size) == 0;
    return std::string(reached ? "reached" : std::strerror(errno));
  });
}

TEST_P(PrivateNetworkTest, HidesAbstractUnixSockets) {
  EXPECT_EQ(
      ConnectFromInside(std::string(1, '\0') + "understudy" + std::to_string(::getpid()), &Inside),
      "Connection refused");
}

TEST_P(PrivateNetworkTest, ReachesUnixSocketsByPath) {
  const test::TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  const mode_t before = ::umask(0);  // connecting takes the right to write
  EXPECT_EQ(ConnectFromInside((folder.path() / "socket").string(), &Inside), "reached");
  ::umask(before);
}

TEST_P(PrivateNetworkTest, IsPassedOnToACommandThatDiesWithUs) {
  Pipe pipe;
  Forked parent([&] {
    Take(GetParam());
    EnterPrivateNetwork();
    Check(::dup2(pipe.in.get(), 9) == 9, "descriptor 9");
    pipe.in.reset();
    ChildProcess child({"sh", "-c", "trap '' TERM; grep -c : /proc/net/dev >&9; exec sleep 60"});
    ::close(9);
    child.Release();
    return std::to_string(child.Wait());
  });
  pipe.in.reset();
  EXPECT_EQ(ReadLine(pipe.out.get()), "1");
  parent.Kill();
  EXPECT_TRUE(ReachesEnd(pipe.out.get()));
}

}  // namespace
}  // namespace understudy::exec
