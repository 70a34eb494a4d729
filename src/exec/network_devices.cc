#include "exec/network_devices.h"

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <thread>

#include <arpa/inet.h>
#include <linux/veth.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include "exec/namespace_refusal.h"
#include "exec/netlink.h"

namespace understudy::exec {
namespace {

ifreq RequestFor(const std::string& interface) {
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  return request;
}

sockaddr Ipv4(const char* text) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  ::inet_pton(AF_INET, text, &address.sin_addr);
  sockaddr generic{};
  static_assert(sizeof(generic) == sizeof(address));
  std::memcpy(&generic, &address, sizeof(generic));
  return generic;
}

// Whether the kernel sends through an interface of this thread's network: before, its queueing
// discipline is "noop", which drops everything.
bool Sends(const std::string& interface) {
  NetlinkRequest request(RTM_GETLINK, 0, ifinfomsg{});
  request.Add(IFLA_IFNAME, interface);
  const NetlinkAnswer answer = request.Send();
  if (answer.header.nlmsg_type != RTM_NEWLINK) return true;  // not to be known
  const char* next = reinterpret_cast<const char*>(&answer.rest) + NLMSG_ALIGN(sizeof(ifinfomsg));
  const char* const end = reinterpret_cast<const char*>(&answer) + answer.size;
  while (next + sizeof(rtattr) <= end) {
    rtattr attribute;
    std::memcpy(&attribute, next, sizeof(attribute));
    if (attribute.rta_len < sizeof(attribute) || next + attribute.rta_len > end) break;
    if (attribute.rta_type == IFLA_QDISC) {
      const std::string_view name(next + RTA_LENGTH(0), attribute.rta_len - RTA_LENGTH(0));
      return !name.starts_with("noop");
    }
    next += RTA_ALIGN(attribute.rta_len);
  }
  return true;
}

}  // namespace

NetworkDevices::NetworkDevices() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (!socket_.valid()) RefuseNetwork("opening a socket", errno);
}

void NetworkDevices::AddFlags(const std::string& interface, int flags) const {
  ifreq request = RequestFor(interface);
  if (::ioctl(socket_.get(), SIOCGIFFLAGS, &request) != 0) {
    RefuseNetwork("reading the flags of " + interface, errno);
  }
  request.ifr_flags = static_cast<decltype(request.ifr_flags)>(request.ifr_flags | flags);
  if (::ioctl(socket_.get(), SIOCSIFFLAGS, &request) != 0) {
    RefuseNetwork("raising " + interface, errno);
  }
}

void NetworkDevices::SetAddress(const std::string& interface, const std::string& address,
                                const std::string& mask) const {
  ifreq request = RequestFor(interface);
  request.ifr_addr = Ipv4(address.c_str());
  bool set = ::ioctl(socket_.get(), SIOCSIFADDR, &request) == 0;
  request.ifr_netmask = Ipv4(mask.c_str());
  set = set && ::ioctl(socket_.get(), SIOCSIFNETMASK, &request) == 0;
  if (!set) RefuseNetwork("giving " + interface + " the address " + address, errno);
}

void NetworkDevices::RouteMulticast(const std::string& interface) const {
  std::string device = interface;
  rtentry route{};
  route.rt_dst = Ipv4("224.0.0.0");
  route.rt_genmask = Ipv4("240.0.0.0");
  route.rt_flags = RTF_UP;
  route.rt_dev = device.data();
  if (::ioctl(socket_.get(), SIOCADDRT, &route) != 0) {
    RefuseNetwork("adding the multicast route", errno);
  }
}

void LayCable(const std::string& interface, int other_network) {
  NetlinkRequest request(RTM_NEWLINK, NLM_F_CREATE | NLM_F_EXCL | NLM_F_ACK, ifinfomsg{});
  request.Add(IFLA_IFNAME, interface);
  const std::uint32_t info = request.Open(IFLA_LINKINFO);
  request.Add(IFLA_INFO_KIND, "veth");
  const std::uint32_t data = request.Open(IFLA_INFO_DATA);
  const std::uint32_t peer = request.Open(VETH_INFO_PEER);
  request.AddHeader(ifinfomsg{});  // a veth's peer has one of its own before its attributes
  request.Add(IFLA_IFNAME, interface);
  request.Add(IFLA_NET_NS_FD, &other_network, sizeof(other_network));
  request.Close(peer);
  request.Close(data);
  request.Close(info);
  if (const int error = request.Send().Error(); error != 0) {
    RefuseNetwork("making a veth pair", error);
  }
}

void AwaitCable(const std::string& interface) {
  constexpr int kTries = 2000;  // *assumed*, a hundred times what it takes
  for (int i = 0; i < kTries && !Sends(interface); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace understudy::exec
