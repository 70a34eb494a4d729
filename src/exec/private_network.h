// Private networks for the robot and the program of `understudy exec`.
#pragma once

#include <string>

#include "base/unique_fd.h"
#include "exec/capabilities.h"

namespace understudy::exec {

// Moves this process into a new network namespace. Its only interface is `lo`, up, with multicast
// and a route 224.0.0.0/4, so DDS discovery and all other IPv4 multicast work as on a LAN.
// (Elsewhere `lo` has no multicast flag, and Cyclone DDS discovers only about nine participants by
// unicast.) Children inherit the network; it ends with its last process.
//
// Call it first in the process, with one thread and before any socket is opened: open sockets stay
// in the old network.
//
// With CAP_SYS_ADMIN and CAP_NET_ADMIN only the network changes. Otherwise it also creates a user
// namespace, with these effects:
//   - the effective uid and gid are mapped to themselves: files, ids and $HOME are as before. All
//     other owners show as nobody. Supplementary groups show as nogroup and still open devices.
//   - setgroups, and set-uid programs such as sudo of other owners, no longer work.
//   - the capabilities are the old ones (an ordinary user: none), valid in the namespace only.
//
// In both cases
//   - abstract unix sockets belong to a network: those outside are out of reach. Unix sockets that
//     have a path (X11 and Wayland displays, D-Bus) are reached as before; X11 through ssh is TCP
//     and is not.
//   - /proc/net shows the new network, /sys/class/net still the old one, that of the process that
//     mounted /sys: programs that list interfaces there see NICs that they cannot use.
//   - there is no way out: no internet, no name servers, no real robot.
//   - ping needs no rights, unless /proc/sys is read-only as in some containers.
//
// Throws BusError if there are several threads or the kernel refuses; the line names the setting
// that would allow it. If creating the namespace is refused nothing has changed; after any later
// failure the process has no network and should exit.
void EnterPrivateNetwork();

// The robot's own address on a cable (docs/dev/sources.md#addresses); *assumed* of robots whose
// pages are not public.
inline constexpr char kRobotAddress[] = "192.168.123.161";

// The program's end of a cable to the robot.
struct CableEnd {
  std::string interface {};  // WhyNoInterface() returns ""
  std::string address{};     // "192.168.123.99/24"; WhyNoCableAddress() returns ""
};

// Returns "" if an interface of a private network can have that name: a letter or digit, then up to
// 14 letters, digits, '.', '_', '-'; not `lo`, which every network has, nor `all` or `default`,
// which the kernel keeps. Returns what is wrong with it and what was expected otherwise.
std::string WhyNoInterface(const std::string& name);

// Returns "" for the text of an address that a program can have beside the robot: 192.168.123.N or
// 192.168.123.N/24, N from 1 to 254 and not the robot's. Returns what is wrong with it and what was
// expected otherwise.
std::string WhyNoCableAddress(const std::string& text);

// Two networks, the program's and the robot's, joined by a cable. Both ends of it have the name and
// the mask of `CableEnd` and multicast; the robot's has kRobotAddress. Beside it each network has
// a `lo`, which leads nowhere, as on two computers. The program's network lives as long as this,
// also when the program has ended: with one of the ends the cable would go, and Cyclone waits
// forever for its own last message if its interface has gone (measured, 0.10.2).
//
// Everything that is said of EnterPrivateNetwork() holds for both. In between, the process has more
// rights than before; it lays them down at the robot's end:
//
//   CabledNetwork network(end);                               // at the program's end
//   ChildProcess program(command, variables, -1, &network.rights());
//   network.MoveToRobot();
class CabledNetwork {
 public:
  // Makes both and moves this process to the program's end. Throws BusError if the kernel does not
  // allow it.
  explicit CabledNetwork(const CableEnd& program);

  // The rights that this process had before, for the program.
  const Capabilities& rights() const { return rights_; }

  // Moves this process to the robot's end and gives back the rights that it has beyond rights().
  // Call it once, while there is one thread. Throws BusError.
  void MoveToRobot();

 private:
  Capabilities rights_;
  UniqueFd program_network_;
  UniqueFd robot_network_;
};

}  // namespace understudy::exec
