#include "exec/private_network.h"

#include <algorithm>
#include <cerrno>
#include <string_view>

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "exec/namespace_refusal.h"
#include "exec/network_devices.h"

namespace understudy::exec {
namespace {

// docs/dev/sources.md#addresses
constexpr char kCableMask[] = "255.255.255.0";
constexpr std::string_view kCablePrefix = "/24";

// unshare(2) moves only the calling thread: other threads would stay in the old network.
void RequireSingleThread() {
  struct stat tasks {};
  if (::stat("/proc/self/task", &tasks) != 0) RefuseNetwork("reading /proc/self/task", errno);
  const auto threads =
      tasks.st_nlink - 2;  // links of a directory: "." and its name, then one per subfolder
  if (threads > 1) {
    throw BusError("no private network: the process already runs " + std::to_string(threads) +
                   " threads, and only a process of one thread can enter one");
  }
}

// Returns 0 or errno.
int WriteWhole(const char* path, const std::string& text) {
  const UniqueFd file(::open(path, O_WRONLY | O_CLOEXEC));
  if (!file.valid()) return errno;
  // The kernel accepts an id map only in one write.
  return ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0
                                                                                            : errno;
}

void MapToItself(const char* path, unsigned int id) {
  const std::string name = std::to_string(id);
  if (const int error = WriteWhole(path, name + " " + name + " 1")) {
    RefuseNetwork(std::string("writing ") + path, error);
  }
}

// The caller reads the ids before unshare: in a namespace without a map they are those of nobody.
void MapOwnIds(uid_t uid, gid_t gid) {
  // user_namespaces(7): without privileges, gid_map can be written only after setgroups is denied.
  if (const int error = WriteWhole("/proc/self/setgroups", "deny")) {
    RefuseNetwork("writing /proc/self/setgroups", error);
  }
  MapToItself("/proc/self/uid_map", uid);
  MapToItself("/proc/self/gid_map", gid);
}

void EnterNetwork() {
  if (::unshare(CLONE_NEWNET) != 0) RefuseNetwork("creating a network namespace", errno);
}

// Enters a new network, with the rights to set it up, and returns the old ones. A new user
// namespace grants every capability. They would override the permissions of the user's files, and
// uid 0 would gain some at exec, which disables the command's parent-death signal (ChildProcess):
// so they have to be given back.
Capabilities EnterNetworkWithRights() {
  RequireSingleThread();
  const Capabilities before = Capabilities::OfThisThread();
  const uid_t uid = ::geteuid();
  const gid_t gid = ::getegid();
  if (before.CanUse(CAP_SYS_ADMIN) && before.CanUse(CAP_NET_ADMIN)) {
    EnterNetwork();
  } else {
    // One call for both namespaces, so that a refusal changes nothing.
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
      RefuseNetwork("creating a user and a network namespace", errno);
    }
    MapOwnIds(uid, gid);
  }
  // Sockets for ping, icmp(7). Where /proc/sys is read-only there are none, and all else works.
  const std::string group = std::to_string(gid);
  WriteWhole("/proc/sys/net/ipv4/ping_group_range", group + " " + group);
  return before;
}

void GiveBackRightsBeyond(const Capabilities& before) {
  if (!before.Apply()) RefuseNetwork("giving the namespace's capabilities back", errno);
}

UniqueFd OpenNetwork() {
  UniqueFd network(::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC));
  if (!network.valid()) RefuseNetwork("opening /proc/self/ns/net", errno);
  return network;
}

void MoveTo(const UniqueFd& network) {
  if (::setns(network.get(), CLONE_NEWNET) != 0) {
    RefuseNetwork("moving to the other end of the cable", errno);
  }
}

void SetUpEnd(const NetworkDevices& devices, const std::string& interface,
              const std::string& address) {
  devices.AddFlags("lo", IFF_UP);
  devices.SetAddress(interface, address, kCableMask);
  devices.AddFlags(interface, IFF_UP | IFF_MULTICAST);
  devices.RouteMulticast(interface);
}

// Without a mask, if there is one.
std::string AddressOf(const std::string& text) {
  return text.ends_with(kCablePrefix) ? text.substr(0, text.size() - kCablePrefix.size()) : text;
}

bool IsLetterOrDigit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

}  // namespace

void EnterPrivateNetwork() {
  const Capabilities before = EnterNetworkWithRights();
  const NetworkDevices devices;
  devices.AddFlags("lo", IFF_UP | IFF_MULTICAST);
  devices.RouteMulticast("lo");
  GiveBackRightsBeyond(before);
}

std::string WhyNoInterface(const std::string& name) {
  if (name == "lo") return "'lo' is in every network; expected the name of another, as in eth0";
  const bool reserved = name == "all" || name == "default";
  const bool good = !name.empty() && name.size() < IFNAMSIZ && IsLetterOrDigit(name[0]) &&
                    std::ranges::all_of(name, [](char c) {
                      return IsLetterOrDigit(c) || c == '.' || c == '_' || c == '-';
                    });
  if (good && !reserved) return "";
  return "'" + name + "' is no name of a network interface; expected a letter or digit and up to " +
         std::to_string(IFNAMSIZ - 2) + " letters, digits, '.', '_' and '-', as in eth0";
}

std::string WhyNoCableAddress(const std::string& text) {
  constexpr std::uint32_t kLastOctet = 0xFF;
  const std::string expected =
      "; expected 192.168.123.N or 192.168.123.N/24, N from 1 to 254 and not 161, as in "
      "192.168.123.99/24";
  const std::string address = AddressOf(text);
  in_addr parsed{}, robot{};
  ::inet_pton(AF_INET, kRobotAddress, &robot);
  if (::inet_pton(AF_INET, address.c_str(), &parsed) != 1) {
    return "'" + text + "' is no IPv4 address" + expected;
  }
  const std::uint32_t number = ntohl(parsed.s_addr), taken = ntohl(robot.s_addr);
  if (number == taken) return "'" + text + "' is the robot's" + expected;
  const std::uint32_t octet = number & kLastOctet;
  if (number >> 8U != taken >> 8U || octet == 0 || octet == kLastOctet) {
    return "'" + text + "' is not in the network of the robot, which is " + kRobotAddress +
           std::string(kCablePrefix) + expected;
  }
  return "";
}

CabledNetwork::CabledNetwork(const CableEnd& program) : rights_(EnterNetworkWithRights()) {
  program_network_ = OpenNetwork();
  const NetworkDevices program_devices;
  EnterNetwork();
  robot_network_ = OpenNetwork();
  const NetworkDevices robot_devices;
  LayCable(program.interface, program_network_.get());
  SetUpEnd(robot_devices, program.interface, kRobotAddress);
  SetUpEnd(program_devices, program.interface, AddressOf(program.address));
  AwaitCable(program.interface);
  MoveTo(program_network_);
  AwaitCable(program.interface);
}

void CabledNetwork::MoveToRobot() {
  MoveTo(robot_network_);
  robot_network_.reset();
  GiveBackRightsBeyond(rights_);
}

}  // namespace understudy::exec
