// The machine's network interfaces, as far as DDS cares.
#pragma once

#include <string>
#include <vector>

namespace understudy::bus {

struct NetworkInterface {
  std::string name;
  bool up = false;
  bool multicast = false;  // has the MULTICAST flag; Debian's `lo` has not
  bool ipv4 = false;       // has an IPv4 address, which Cyclone needs
};

// In the kernel's order, each name once. Throws BusError when the kernel does not tell.
std::vector<NetworkInterface> ListInterfaces();

// The interface of that name, fit to be used: up and with an IPv4 address. Throws BusError that
// names what is wrong, the interfaces there are and the nearest of them.
NetworkInterface FindInterface(const std::string& name);

}  // namespace understudy::bus
