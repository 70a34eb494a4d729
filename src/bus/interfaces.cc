#include "bus/interfaces.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::bus {

std::vector<NetworkInterface> ListInterfaces() {
  ifaddrs* head = nullptr;
  if (getifaddrs(&head) != 0) {
    throw BusError(std::string("cannot list the network interfaces: ") + std::strerror(errno));
  }
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(head, &freeifaddrs);

  std::vector<NetworkInterface> interfaces;
  for (const ifaddrs* address = head; address != nullptr; address = address->ifa_next) {
    auto known = std::ranges::find(interfaces, address->ifa_name, &NetworkInterface::name);
    if (known == interfaces.end()) {
      interfaces.push_back({.name = address->ifa_name,
                            .up = (address->ifa_flags & IFF_UP) != 0,
                            .multicast = (address->ifa_flags & IFF_MULTICAST) != 0});
      known = interfaces.end() - 1;
    }
    if (address->ifa_addr == nullptr || address->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in own;
    std::memcpy(&own, address->ifa_addr, sizeof(own));
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &own.sin_addr, text.data(), text.size());
    known->addresses.emplace_back(text.data());
  }
  return interfaces;
}

NetworkInterface FindCard(const std::string& name) {
  const std::vector<NetworkInterface> interfaces = ListInterfaces();
  const auto found = std::ranges::find(interfaces, name, &NetworkInterface::name);
  if (found == interfaces.end()) {
    std::vector<std::string> names;
    names.reserve(interfaces.size());
    for (const NetworkInterface& interface : interfaces) names.push_back(interface.name);
    throw BusError("no network interface '" + name + "'" + DidYouMean(name, names));
  }
  if (!found->up) throw BusError("network interface \"" + name + "\" is down");
  return *found;
}

NetworkInterface FindInterface(const std::string& name) {
  NetworkInterface found = FindCard(name);
  if (found.addresses.empty()) {
    throw BusError("network interface \"" + name + "\" has no IPv4 address");
  }
  return found;
}

const std::string& DdsAddress(const NetworkInterface& interface) {
  const auto rank = [](const std::string& address) {
    return address == "192.168.123.161" ? 0 : address.starts_with("192.168.123.") ? 1 : 2;
  };
  return *std::ranges::min_element(interface.addresses, {}, rank);
}

}  // namespace understudy::bus
