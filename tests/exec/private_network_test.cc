#include "exec/private_network.h"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <ifaddrs.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <net/if.h>
#include <netinet/in.h>
#include <netinet/ip_icmp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include "exec/capabilities.h"
#include "exec/child_process.h"
#include "forked.h"
#include "tests/support/temporary_folder.h"

namespace understudy::exec {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::understudy::test::Forked;
using ::understudy::test::InFork;
using ::understudy::test::Pipe;
using ::understudy::test::ReachesEnd;
using ::understudy::test::ReadLine;
using ::understudy::test::WriteLine;

constexpr uid_t kNobody = 65534;
constexpr std::uint16_t kPort = 7400;  // of DDS discovery on domain 0

void Check(bool held, const char* what) {
  if (!held) throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
}

// With what rights the network is entered. A test run by an ordinary user has that user's in all.
enum class Rights { kAsStarted, kOrdinaryUser, kRootOfAContainer };

// For ::testing::PrintToString.
void PrintTo(Rights rights, std::ostream* out) {
  *out << (rights == Rights::kAsStarted      ? "AsStarted"
           : rights == Rights::kOrdinaryUser ? "OrdinaryUser"
                                             : "RootOfAContainer");
}

void Take(Rights rights) {
  if (rights == Rights::kAsStarted || ::geteuid() != 0) return;
  if (rights == Rights::kOrdinaryUser) {
    Check(::setgroups(0, nullptr) == 0, "setgroups");
    Check(::setresgid(kNobody, kNobody, kNobody) == 0, "setresgid");
    Check(::setresuid(kNobody, kNobody, kNobody) == 0, "setresuid");
    // A change of user closes /proc/self to the process; an exec, as after a login, opens it again.
    Check(::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0) == 0, "dumpable");
    return;
  }
  constexpr std::uint64_t kTaken = 1ULL << CAP_SYS_ADMIN | 1ULL << CAP_NET_ADMIN;
  Capabilities few = Capabilities::OfThisThread();
  few.effective &= ~kTaken;
  few.permitted &= ~kTaken;
  few.inheritable &= ~kTaken;
  few.bounding &= ~kTaken;
  Check(few.Apply(), "giving up capabilities");
}

sockaddr_in Address(const char* ip, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  ::inet_pton(AF_INET, ip, &address.sin_addr);
  return address;
}

const sockaddr* Generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

// Receives what is sent to the DDS discovery group; names no interface, as many programs do.
class GroupSocket {
 public:
  GroupSocket() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in any = Address("0.0.0.0", kPort);
    Check(::bind(socket_.get(), Generic(any), sizeof(any)) == 0, "bind");
    ip_mreq group{};
    group.imr_multiaddr = group_.sin_addr;
    Check(::setsockopt(socket_.get(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof(group)) == 0,
          "join 239.255.0.1");
  }
  void Send(const std::string& text) {
    Check(::sendto(socket_.get(), text.data(), text.size(), 0, Generic(group_), sizeof(group_)) ==
              static_cast<ssize_t>(text.size()),
          "send");
  }
  // The oldest datagram; "nothing" if none comes within 5 s.
  std::string Receive() {
    pollfd wanted{.fd = socket_.get(), .events = POLLIN, .revents = 0};
    if (::poll(&wanted, 1, 5000) != 1) return "nothing";
    char text[64];
    const ssize_t got = ::recv(socket_.get(), text, sizeof(text), 0);
    Check(got >= 0, "receive");
    return {text, static_cast<std::size_t>(got)};
  }

 private:
  sockaddr_in group_ = Address("239.255.0.1", kPort);
  UniqueFd socket_;
};

class PrivateNetworkTest : public ::testing::TestWithParam<Rights> {
 protected:
  // What `body` returns in a private network.
  static std::string Inside(const std::function<std::string()>& body) {
    return InFork([&] {
      Take(GetParam());
      EnterPrivateNetwork();
      return body();
    });
  }

  // What `program` returns at the program's end of a cable. At the other end `robot` does what it
  // does; its argument lets the program begin.
  static std::string OnCable(
      const std::function<std::string()>& program,
      const std::function<void(const std::function<void()>&)>& robot = [](const auto& go) {
        go();
      }) {
    return InFork([&] {
      Take(GetParam());
      CabledNetwork network({.interface = "eth0", .address = "192.168.123.99/24"});
      Pipe ready;
      Forked other([&] {
        Check(network.rights().Apply(), "rights");
        ReadLine(ready.out.get());
        return program();
      });
      network.MoveToRobot();
      robot([&] { WriteLine(ready.in.get(), "go"); });
      return other.Result();
    });
  }
};

// All interfaces of this network, each with its IPv4 address and what of kWanted it has:
// "eth0 192.168.123.99/24 up multicast;".
std::string Interfaces() {
  ifaddrs* all = nullptr;
  Check(::getifaddrs(&all) == 0, "getifaddrs");
  std::set<std::string> told;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    std::string text = one->ifa_name;
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in address{}, mask{};
    std::memcpy(&address, one->ifa_addr, sizeof(address));
    std::memcpy(&mask, one->ifa_netmask, sizeof(mask));
    text += std::string(" ") + ::inet_ntoa(address.sin_addr);
    text += std::string("/") + std::to_string(__builtin_popcount(mask.sin_addr.s_addr));
    if ((one->ifa_flags & IFF_UP) != 0) text += " up";
    if ((one->ifa_flags & IFF_MULTICAST) != 0) text += " multicast";
    told.insert(text + ";");
  }
  ::freeifaddrs(all);
  std::string text;
  for (const std::string& line : told) text += line;
  // Those without an address would hide.
  std::size_t count = 0;
  struct if_nameindex* names = ::if_nameindex();
  for (auto* entry = names; entry->if_index != 0; ++entry) ++count;
  ::if_freenameindex(names);
  return std::to_string(count) + ": " + text;
}

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

// As a container's system call filter does it, root or not.
void Forbid(std::uint32_t call, std::uint32_t error) {
  sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{.len = 4, .filter = rules};
  Check(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0, "no_new_privs");
  Check(::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0, "seccomp");
}

void ForbidUnshare() { Forbid(SYS_unshare, EPERM); }

TEST(PrivateNetworkRefusalTest, SpeaksOfTheContainerUnderASystemCallFilter) {
  EXPECT_THAT(InFork([] {
                ForbidUnshare();
                EnterPrivateNetwork();
                return std::string("entered");
              }),
              AllOf(HasSubstr("Operation not permitted"), HasSubstr("docker run --cap-add"),
                    HasSubstr("--network host")));
}

TEST(PrivateNetworkRefusalTest, SpeaksOfTheContainerForACableToo) {
  EXPECT_THAT(InFork([] {
                ForbidUnshare();
                const CabledNetwork network({.interface = "eth0", .address = "192.168.123.99"});
                return std::string("entered");
              }),
              AllOf(HasSubstr("Operation not permitted"), HasSubstr("docker run --cap-add")));
}

TEST(PrivateNetworkRefusalTest, SaysWhatToDoWhereTheKernelMakesNoCable) {
  EXPECT_THAT(InFork([] {
                Forbid(SYS_sendto, EOPNOTSUPP);  // what is sent to rtnetlink
                const CabledNetwork network({.interface = "eth0", .address = "192.168.123.99"});
                return std::string("entered");
              }),
              AllOf(HasSubstr("making a veth pair failed: Operation not supported"),
                    HasSubstr("modprobe veth"), HasSubstr("leave --interface-name out")));
}

TEST(PrivateNetworkRefusalTest, PassesOnWhatTheKernelSaysOfACable) {
  EXPECT_THAT(InFork([] {
                const CabledNetwork network({.interface = "lo", .address = "192.168.123.99"});
                return std::string("entered");
              }),
              HasSubstr("making a veth pair failed: File exists"));
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

TEST(PrivateNetworkRefusalTest, RefusesASecondThread) {
  EXPECT_THAT(InFork([] {
                Pipe pipe;
                std::thread other([&] { ReadLine(pipe.out.get()); });
                std::string result = "entered";
                try {
                  EnterPrivateNetwork();
                } catch (const std::exception& error) {
                  result = error.what();
                }
                pipe.in.reset();
                other.join();
                return result;
              }),
              HasSubstr("already runs"));
}

}  // namespace
}  // namespace understudy::exec
