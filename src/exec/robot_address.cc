#include "exec/robot_address.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <netinet/if_ether.h>
#include <poll.h>
#include <sys/socket.h>

#include "base/errors.h"
#include "base/unique_fd.h"
#include "exec/netlink.h"
#include "exec/private_network.h"

namespace understudy::exec {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kRenewal(20);          // thrice in the lifetime
constexpr milliseconds kListening(300);  // *assumed*: a machine on the cable answers within 1 ms
constexpr std::uint8_t kPrefix = 24;     // as in 192.168.123.161/24

in_addr Address() {
  in_addr address{};
  ::inet_pton(AF_INET, kRobotAddress, &address);
  return address;
}

// Returns the interface of this computer that has the address, "" for none.
std::string HeldBy() {
  ifaddrs* head = nullptr;
  if (::getifaddrs(&head) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(head, &freeifaddrs);
  for (const ifaddrs* one = head; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in own;
    std::memcpy(&own, one->ifa_addr, sizeof(own));
    if (own.sin_addr.s_addr == Address().s_addr) return one->ifa_name;
  }
  return {};
}

[[noreturn]] void Refuse(const std::string& interface, const std::string& why) {
  throw BusError(interface + " cannot have the robot's address " + kRobotAddress + ": " + why);
}

[[noreturn]] void RefuseBy(const std::string& interface, int error) {
  const bool rights = error == EPERM || error == EACCES;
  Refuse(interface, std::strerror(error) +
                        std::string(rights ? "; start as root, or with the rights CAP_NET_ADMIN "
                                             "and CAP_NET_RAW"
                                           : ""));
}

std::string Hardware(const std::uint8_t (&address)[ETH_ALEN]) {
  std::array<char, 3 * ETH_ALEN> text;
  std::snprintf(text.data(), text.size(), "%02x:%02x:%02x:%02x:%02x:%02x", address[0], address[1],
                address[2], address[3], address[4], address[5]);
  return text.data();
}

// The question of RFC 5227 for who has the address, from nobody's.
ether_arp Question(const UniqueFd& socket) {
  sockaddr_ll own{};
  socklen_t size = sizeof(own);
  ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&own), &size);
  ether_arp question{};
  question.arp_hrd = htons(ARPHRD_ETHER);
  question.arp_pro = htons(ETH_P_IP);
  question.arp_hln = ETH_ALEN;
  question.arp_pln = sizeof(in_addr);
  question.arp_op = htons(ARPOP_REQUEST);
  std::memcpy(question.arp_sha, own.sll_addr, ETH_ALEN);
  const in_addr address = Address();
  std::memcpy(question.arp_tpa, &address, sizeof(address));
  return question;
}

// Returns the hardware address of who on the cable answers to the robot's; nullopt for nobody.
std::optional<std::string> OwnerOnCable(const std::string& interface, unsigned index) {
  const UniqueFd socket(::socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_ARP)));
  if (!socket.valid()) RefuseBy(interface, errno);
  sockaddr_ll all{};
  all.sll_family = AF_PACKET;
  all.sll_protocol = htons(ETH_P_ARP);
  all.sll_ifindex = static_cast<int>(index);
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&all), sizeof(all)) != 0) {
    RefuseBy(interface, errno);
  }
  all.sll_halen = ETH_ALEN;
  std::memset(all.sll_addr, 0xFF, ETH_ALEN);
  const ether_arp question = Question(socket);
  if (::sendto(socket.get(), &question, sizeof(question), 0,
               reinterpret_cast<const sockaddr*>(&all), sizeof(all)) < 0) {
    RefuseBy(interface, errno);
  }
  const in_addr address = Address();
  const Clock::time_point end = Clock::now() + kListening;
  while (true) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now()).count();
    pollfd readable{.fd = socket.get(), .events = POLLIN, .revents = 0};
    if (left <= 0 || ::poll(&readable, 1, static_cast<int>(left)) == 0) return std::nullopt;
    ether_arp heard{};
    if (::recv(socket.get(), &heard, sizeof(heard), MSG_DONTWAIT) <
        static_cast<ssize_t>(sizeof(heard))) {
      continue;
    }
    if (std::memcmp(heard.arp_spa, &address, sizeof(address)) == 0) return Hardware(heard.arp_sha);
  }
}

// Returns 0 or an errno.
int Ask(std::uint16_t type, int flags, unsigned index) {
  const ifaddrmsg header{.ifa_family = AF_INET,
                         .ifa_prefixlen = kPrefix,
                         .ifa_flags = 0,
                         .ifa_scope = RT_SCOPE_UNIVERSE,
                         .ifa_index = index};
  NetlinkRequest request(type, flags | NLM_F_ACK, header);
  const in_addr address = Address();
  request.Add(IFA_LOCAL, &address, sizeof(address));
  request.Add(IFA_ADDRESS, &address, sizeof(address));
  const in_addr broadcast{address.s_addr | htonl((1U << (32 - kPrefix)) - 1)};
  request.Add(IFA_BROADCAST, &broadcast, sizeof(broadcast));
  const ifa_cacheinfo lifetime{
      .ifa_prefered = kAddressLifetime, .ifa_valid = kAddressLifetime, .cstamp = 0, .tstamp = 0};
  request.Add(IFA_CACHEINFO, &lifetime, sizeof(lifetime));
  return request.Send().Error();
}

void Renew(const std::stop_token& stop, unsigned index) {
  std::mutex mutex;
  std::condition_variable_any ended;
  std::unique_lock lock(mutex);
  while (!ended.wait_for(lock, stop, kRenewal, [&] { return stop.stop_requested(); })) {
    Ask(RTM_NEWADDR, NLM_F_CREATE | NLM_F_REPLACE, index);
  }
}

}  // namespace

RobotAddress::RobotAddress(const std::string& interface)
    : index_(::if_nametoindex(interface.c_str())) {
  if (index_ == 0) RefuseBy(interface, errno);
  if (interface == "lo") Refuse(interface, "no cable leads out of it");
  if (const std::string holder = HeldBy(); !holder.empty()) {
    Refuse(interface, holder +
                          " has it already: leave --as-robot out, or take it off; what a killed "
                          "run left goes within a minute");
  }
  if (const auto owner = OwnerOnCable(interface, index_)) {
    Refuse(interface, *owner + " on its cable answers to it: take the real robot off the cable");
  }
  if (const int error = Ask(RTM_NEWADDR, NLM_F_CREATE | NLM_F_EXCL, index_); error != 0) {
    RefuseBy(interface, error);
  }
  renewal_ = std::jthread([index = index_](const std::stop_token& stop) { Renew(stop, index); });
}

RobotAddress::~RobotAddress() {
  renewal_.request_stop();
  renewal_.join();
  Ask(RTM_DELADDR, 0, index_);
}

}  // namespace understudy::exec
