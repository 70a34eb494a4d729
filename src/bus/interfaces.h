// Lists the machine's network interfaces that DDS can use.
#pragma once

#include <string>
#include <vector>

namespace understudy::bus {

struct NetworkInterface {
  std::string name;
  bool up = false;
  bool multicast = false;                // has the MULTICAST flag, which Debian's `lo` does not
  std::vector<std::string> addresses{};  // IPv4, in the kernel's order; Cyclone needs one
};

// Returns the address of those that DDS uses: the robot's own, 192.168.123.161, or else the first
// in its network, 192.168.123.0/24, or else the first. There must be one.
const std::string& DdsAddress(const NetworkInterface& interface);

// Returns all interfaces in the kernel's order, each name once. Throws BusError if the kernel does
// not list them.
std::vector<NetworkInterface> ListInterfaces();

// Returns the interface of that name. Throws BusError if there is none or it is down; the error
// lists all interfaces and the nearest name.
NetworkInterface FindCard(const std::string& name);

// The same, which has an IPv4 address, too.
NetworkInterface FindInterface(const std::string& name);

}  // namespace understudy::bus
