// Lists the machine's network interfaces that DDS can use.
#pragma once

#include <string>
#include <vector>

namespace understudy::bus {

struct NetworkInterface {
  std::string name;
  bool up = false;
  bool multicast = false;  // has the MULTICAST flag, which Debian's `lo` does not
  bool ipv4 = false;       // has an IPv4 address, which Cyclone needs
};

// Returns all interfaces in the kernel's order, each name once. Throws BusError if the kernel does
// not list them.
std::vector<NetworkInterface> ListInterfaces();

// Returns the interface of that name. Throws BusError if there is none, it is down or has no IPv4
// address; the error lists all interfaces and the nearest name.
NetworkInterface FindInterface(const std::string& name);

}  // namespace understudy::bus
