// Whether the interface is fit for DDS.
#include <bit>
#include <cstring>

#include <arpa/inet.h>

#include "base/nearest_word.h"
#include "doctor/findings.h"

namespace understudy::doctor {
namespace {

// The robot's network and the motion computer's address in it (docs/dev/sources.md#addresses).
constexpr std::uint32_t kRobotNetwork = 0xC0A87B00, kRobotMask = 0xFFFFFF00, kRobot = 0xC0A87BA1;

std::string Dotted(const Address& address) {
  in_addr raw{.s_addr = htonl(address.address)};
  char text[INET_ADDRSTRLEN] = "";
  ::inet_ntop(AF_INET, &raw, text, sizeof text);
  return fmt::format("{}/{}", text, std::popcount(address.mask));
}

Finding Interface(const Measurements& seen) {
  const std::string& name = seen.question.interface;
  if (!seen.link) {
    const std::string near = NearestWord(name, seen.interfaces);
    return Wrong(NoInterface(seen), (near.empty() ? "" : "did you mean '" + near + "'? ") +
                                        "choose one with --interface: " + Listed(seen.interfaces));
  }
  if (!seen.link->up) return Wrong(name + " is down", "as root: ip link set " + name + " up");
  if (!seen.link->running) {
    return Wrong(name + " is up and has no carrier",
                 "plug its cable in, and switch on what is at the other end");
  }
  return Ok(name + " is up" + (seen.link->loopback ? ", and leads to this machine only" : ""));
}

Finding Addresses(const Measurements& seen) {
  const std::string& name = seen.question.interface;
  if (!seen.link) return NotSeen(NoInterface(seen));
  std::vector<Address> own;
  for (const Address& one : seen.addresses) {
    if (one.interface == name) own.push_back(one);
  }
  const std::string add = "as root: ip address add 192.168.123.99/24 dev " + name;
  if (own.empty()) return Wrong(name + " has no IPv4 address, which DDS needs", add);
  for (const Address& one : own) {
    for (const Address& other : seen.addresses) {
      const std::uint32_t mask = one.mask & other.mask;
      if (other.interface == name || (one.address & mask) != (other.address & mask)) continue;
      return Wrong(fmt::format("{} ({}) and {} ({}) are in one network: what is for the robot may "
                               "leave by the other",
                               name, Dotted(one), other.interface, Dotted(other)),
                   "switch " + other.interface + " off, or give it an address of another network");
    }
  }
  if (seen.link->loopback) return Ok(Dotted(own.front()));
  const auto robots = std::ranges::find_if(
      own, [](const Address& one) { return (one.address & kRobotMask) == kRobotNetwork; });
  if (robots == own.end()) {
    return Warning(Dotted(own.front()) + " is not in 192.168.123.0/24, a robot's network",
                   "for a real robot, " + add);
  }
  if (robots->address == kRobot) {
    return Warning(Dotted(*robots) +
                       " is the robot's own address: right for a machine that plays "
                       "one, and for no other",
                   "beside a real robot take another, such as 192.168.123.99/24");
  }
  return Ok(Dotted(*robots) + " is in a robot's network");
}

Finding MulticastFlag(const Measurements& seen) {
  const std::string& name = seen.question.interface;
  if (!seen.link) return NotSeen(NoInterface(seen));
  if (seen.link->multicast) return Ok(name + " has it");
  const std::string on = "as root: ip link set " + name + " multicast on";
  if (seen.link->loopback) {
    return Warning(name + " has none: about nine programs fit into a domain",
                   on + "; or use understudy exec");
  }
  return Wrong(name + " has none: DDS finds no program of another machine", on);
}

Finding MulticastRoute(const Measurements& seen) {
  if (!seen.link || !seen.multicast_route) return NotSeen("the kernel did not tell");
  const std::string& name = seen.question.interface;
  if (*seen.multicast_route == name) return Ok("leads to " + name);
  const std::string where =
      seen.multicast_route->empty() ? "leads nowhere" : "leads to " + *seen.multicast_route;
  return Warning(
      where + ": multicast of programs that name no interface does not reach " + name,
      "name " + name + " to every program; or as root: ip route add 224.0.0.0/4 dev " + name);
}

Finding MulticastHere(const Measurements& seen) {
  if (!seen.self_multicast) return NotSeen("no socket could be made for it");
  const DatagramCount& tally = *seen.self_multicast;
  if (tally.returned == tally.sent && tally.sent > 0) {
    return With(Ok(Counts(tally) + " from 239.255.0.1 to ourselves"), FiguresOf(tally));
  }
  std::string text = Counts(tally) + " from 239.255.0.1 to ourselves";
  if (tally.error != 0) text += fmt::format(" ({})", std::strerror(tally.error));
  return With(Wrong(std::move(text), kOwnFirewall), FiguresOf(tally));
}

constexpr Check kNetworkChecks[] = {
    {"interface", "is it there, up, and is something at the other end", Interface},
    {"address", "IPv4 addresses: none, two in one network, in the robot's or not", Addresses},
    {"multicast", "the interface's flag, without which DDS finds nobody elsewhere", MulticastFlag},
    {"multicast route", "where multicast goes that names no interface", MulticastRoute},
    {"multicast here", "datagrams to the group of DDS, and back to ourselves", MulticastHere},
};

}  // namespace

std::span<const Check> NetworkChecks() { return kNetworkChecks; }

}  // namespace understudy::doctor
