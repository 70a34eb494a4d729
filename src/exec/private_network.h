// Moves this process into a private network for the robot and the program of `understudy exec`.
#pragma once

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
//   - setgroups, and set-uid programs such as sudo or ping of other owners, no longer work.
//   - the capabilities are those of before (an ordinary user: none), valid in the namespace only.
//
// In both cases
//   - abstract unix sockets belong to a network: those outside are out of reach. Unix sockets that
//     have a path (X11 and Wayland displays, D-Bus) are reached as before; X11 through ssh is TCP
//     and is not.
//   - /proc/net shows the new network, /sys/class/net still the old one, that of the process that
//     mounted /sys: programs that list interfaces there see NICs that they cannot use.
//   - there is no way out: no internet, no name servers, no real robot.
//
// Throws BusError if there are several threads or the kernel refuses; the line names the setting
// that would allow it. If creating the namespace is refused nothing has changed; after any later
// failure the process has no network and should exit.
void EnterPrivateNetwork();

}  // namespace understudy::exec
