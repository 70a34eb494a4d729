// Moves this process into a network of its own, where robot and program of `understudy exec` meet
// on domain 0.
#pragma once

namespace understudy::exec {

// Moves this process into a new network namespace whose only interface is `lo`, up, with multicast
// and a route 224.0.0.0/4 through it: DDS discovery and every other IPv4 multicast works as on a
// LAN of one machine. (Outside, lo has no multicast flag, and Cyclone DDS finds only about ten
// participants by unicast.) Children inherit the network; it ends with its last process.
//
// Call it first in the process: with one thread (more: BusError), before any socket is opened,
// since open sockets stay on the old network.
//
// With CAP_SYS_ADMIN and CAP_NET_ADMIN nothing but the network changes. Without, a user namespace
// comes with it, and then
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
// Throws BusError, in one line that names the setting which helps, where the kernel forbids it. If
// creating the namespace is refused nothing has changed; after any later failure the process is
// without a network and can only end.
void EnterPrivateNetwork();

}  // namespace understudy::exec
