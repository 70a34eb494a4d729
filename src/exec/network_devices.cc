#include "exec/network_devices.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <thread>

#include <arpa/inet.h>
#include <linux/rtnetlink.h>
#include <linux/veth.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include "exec/namespace_refusal.h"

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

struct Answer {
  nlmsghdr header;
  union {
    nlmsgerr error;  // with NLMSG_ERROR
    ifinfomsg link;  // with RTM_NEWLINK; attributes follow
    std::byte rest[8192];
  };
  std::size_t size;  // of what was received
};

// A message of rtnetlink(7) about an interface; its attributes are added one by one.
class LinkRequest {
 public:
  LinkRequest(std::uint16_t type, int flags) {
    header_.nlmsg_len = NLMSG_LENGTH(sizeof(ifinfomsg));
    header_.nlmsg_type = type;
    header_.nlmsg_flags = static_cast<std::uint16_t>(NLM_F_REQUEST | flags);
  }

  void Add(std::uint16_t type, const void* value, std::size_t size) {
    const std::uint32_t begin = Open(type);
    std::memcpy(At(header_.nlmsg_len), value, size);
    header_.nlmsg_len += static_cast<std::uint32_t>(size);
    Close(begin);
    header_.nlmsg_len = NLMSG_ALIGN(header_.nlmsg_len);
  }
  void Add(std::uint16_t type, const std::string& text) {
    Add(type, text.c_str(), text.size() + 1);
  }

  // What is added until Close(), which takes the result, is part of this attribute.
  std::uint32_t Open(std::uint16_t type) {
    const std::uint32_t begin = header_.nlmsg_len;
    const rtattr attribute{.rta_len = 0, .rta_type = type};
    std::memcpy(At(begin), &attribute, sizeof(attribute));
    header_.nlmsg_len += static_cast<std::uint32_t>(RTA_LENGTH(0));
    return begin;
  }
  void Close(std::uint32_t begin) {
    const auto size = static_cast<std::uint16_t>(header_.nlmsg_len - begin);
    std::memcpy(At(begin + offsetof(rtattr, rta_len)), &size, sizeof(size));
  }

  // The attributes of a veth's peer stand behind a header of its own, here all zeros.
  void AddHeader() { header_.nlmsg_len += static_cast<std::uint32_t>(sizeof(ifinfomsg)); }

  // Returns the kernel's answer: an NLMSG_ERROR with 0, a header with what was asked for, or an
  // NLMSG_ERROR with the negative errno, also if it cannot be asked.
  Answer Send() {
    Answer answer{};
    answer.header.nlmsg_type = NLMSG_ERROR;
    const UniqueFd socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
    std::memcpy(bytes_.data(), &header_, sizeof(header_));
    ssize_t got = -1;
    if (socket.valid() && ::send(socket.get(), bytes_.data(), header_.nlmsg_len, 0) >= 0) {
      do {
        got = ::recv(socket.get(), &answer, offsetof(Answer, size), 0);
      } while (got < 0 && errno == EINTR);
    }
    if (got < 0) answer.error.error = -errno;
    answer.size = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    return answer;
  }

 private:
  std::byte* At(std::size_t offset) { return bytes_.data() + offset; }

  nlmsghdr header_{};
  std::array<std::byte, 256> bytes_{};  // twice what a cable takes
};

// Whether the kernel sends through an interface of this thread's network: before, its queueing
// discipline is "noop", which drops everything.
bool Sends(const std::string& interface) {
  LinkRequest request(RTM_GETLINK, 0);
  request.Add(IFLA_IFNAME, interface);
  const Answer answer = request.Send();
  if (answer.header.nlmsg_type != RTM_NEWLINK) return true;  // not to be known
  const char* next = reinterpret_cast<const char*>(&answer.link) + NLMSG_ALIGN(sizeof(ifinfomsg));
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
  LinkRequest request(RTM_NEWLINK, NLM_F_CREATE | NLM_F_EXCL | NLM_F_ACK);
  request.Add(IFLA_IFNAME, interface);
  const std::uint32_t info = request.Open(IFLA_LINKINFO);
  request.Add(IFLA_INFO_KIND, "veth");
  const std::uint32_t data = request.Open(IFLA_INFO_DATA);
  const std::uint32_t peer = request.Open(VETH_INFO_PEER);
  request.AddHeader();
  request.Add(IFLA_IFNAME, interface);
  request.Add(IFLA_NET_NS_FD, &other_network, sizeof(other_network));
  request.Close(peer);
  request.Close(data);
  request.Close(info);
  const Answer answer = request.Send();
  if (answer.header.nlmsg_type != NLMSG_ERROR) RefuseNetwork("making a veth pair", EPROTO);
  if (answer.error.error != 0) RefuseNetwork("making a veth pair", -answer.error.error);
}

void AwaitCable(const std::string& interface) {
  constexpr int kTries = 2000;  // *assumed*, a hundred times what it takes
  for (int i = 0; i < kTries && !Sends(interface); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace understudy::exec
