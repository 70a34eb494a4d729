// Sets up the network interfaces of a new network namespace.
#pragma once

#include <string>

#include "base/unique_fd.h"

namespace understudy::exec {

// The interfaces of the network namespace in which it was made. They stay those when the process
// moves on to another one. Needs CAP_NET_ADMIN there. All functions throw BusError with the step
// that failed and the kernel's reason.
class NetworkDevices {
 public:
  NetworkDevices();

  // Sets `flags` (IFF_UP, IFF_MULTICAST) beside those that are set. The kernel gives lo its address
  // 127.0.0.1/8 when it comes up.
  void AddFlags(const std::string& interface, int flags) const;

  // Gives an interface its IPv4 address and network mask, both as text: "192.168.123.99",
  // "255.255.255.0".
  void SetAddress(const std::string& interface, const std::string& address,
                  const std::string& mask) const;

  // Adds the route 224.0.0.0/4 for programs that name no interface: joining a group and sending to
  // it use the routes. The interface has to be up.
  void RouteMulticast(const std::string& interface) const;

 private:
  UniqueFd socket_;
};

// Joins two networks by a virtual Ethernet cable (veth(4)), both of whose ends are called
// `interface`: one in the network of the calling thread, one in that of the descriptor
// `other_network`. Both ends are down and without address. Throws BusError, as above.
void LayCable(const std::string& interface, int other_network);

// Waits until the kernel sends through the end of a cable that is in the network of the calling
// thread: it begins a little after both ends are up, and drops what it is given before. Returns
// after 2 s in any case.
void AwaitCable(const std::string& interface);

}  // namespace understudy::exec
