#include "network_fixture.h"

#include <cerrno>
#include <cstring>
#include <set>
#include <stdexcept>

#include <arpa/inet.h>
#include <grp.h>
#include <ifaddrs.h>
#include <linux/capability.h>
#include <net/if.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "exec/capabilities.h"

namespace understudy::exec {
namespace {

constexpr uid_t kNobody = 65534;

}  // namespace

void Check(bool held, const char* what) {
  if (!held) throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
}

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

}  // namespace understudy::exec
