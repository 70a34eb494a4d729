#include "doctor/checks.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <arpa/inet.h>
#include <spdlog/fmt/fmt.h>

#include "base/nearest_word.h"
#include "doctor/echo_topics.h"
#include "doctor/vendor_topics.h"
#include "robot/command_topics.h"

namespace understudy::doctor {
namespace {

// The robot's network and the motion computer's address in it (docs/sources.md#addresses).
constexpr std::uint32_t kRobotNetwork = 0xC0A87B00, kRobotMask = 0xFFFFFF00, kRobot = 0xC0A87BA1;

// *Assumed*, all of them; the periods are those of LowCmd and LowState, 2 ms.
constexpr double kLatePeriod = 2e-3;    // s: what comes later meets the next one
constexpr double kTenPeriods = 20e-3;   // s: robot and program no longer speak of the same instant
constexpr double kDampingAfter = 0.2;   // s: gate.timeout's default, after which the motors damp
constexpr double kLostWrong = 0.01;     // share of messages
constexpr double kLateWaking = 1e-3;    // s: half a period
constexpr std::size_t kMostListed = 4;  // of a kind in one finding

Finding Ok(std::string text) { return {.text = std::move(text)}; }
Finding Warning(std::string text, std::string remedy) {
  return {.verdict = Verdict::kWarning, .text = std::move(text), .remedy = std::move(remedy)};
}
Finding Wrong(std::string text, std::string remedy) {
  return {.verdict = Verdict::kWrong, .text = std::move(text), .remedy = std::move(remedy)};
}
Finding NotSeen(std::string text, std::string remedy = "") {
  return {.verdict = Verdict::kNotSeen, .text = std::move(text), .remedy = std::move(remedy)};
}
Finding With(Finding finding, std::vector<std::pair<std::string_view, double>> figures) {
  finding.figures = std::move(figures);
  return finding;
}

std::string Ms(double seconds) { return fmt::format("{:.2f} ms", seconds * 1e3); }

// "A, B, C, D and 3 more".
std::string Listed(const std::vector<std::string>& items, const char* between = ", ") {
  std::string text;
  for (std::size_t i = 0; i < std::min(items.size(), kMostListed); ++i) {
    text += (i == 0 ? "" : between) + items[i];
  }
  if (items.size() > kMostListed) text += fmt::format(" and {} more", items.size() - kMostListed);
  return text;
}

std::string Dotted(const Address& address) {
  in_addr raw{.s_addr = htonl(address.address)};
  char text[INET_ADDRSTRLEN] = "";
  ::inet_ntop(AF_INET, &raw, text, sizeof text);
  return fmt::format("{}/{}", text, std::popcount(address.mask));
}

bool IsLoopback(const Evidence& seen) { return seen.link && seen.link->loopback; }

std::string NoInterface(const Evidence& seen) {
  return "there is no interface '" + seen.question.interface + "'";
}

// ---- the interface

Finding Interface(const Evidence& seen) {
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
  return Ok(name + " is up" + (seen.link->loopback ? ", and leads to this machine alone" : ""));
}

Finding Addresses(const Evidence& seen) {
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

// ---- multicast

Finding MulticastFlag(const Evidence& seen) {
  const std::string& name = seen.question.interface;
  if (!seen.link) return NotSeen(NoInterface(seen));
  if (seen.link->multicast) return Ok(name + " has it");
  const std::string on = "as root: ip link set " + name + " multicast on";
  if (seen.link->loopback) {
    return Warning(name + " has none: about nine programs have room in a domain",
                   on + "; or use understudy exec");
  }
  return Wrong(name + " has none: DDS finds no program of another machine", on);
}

Finding MulticastRoute(const Evidence& seen) {
  if (!seen.link || !seen.multicast_route) return NotSeen("the kernel did not tell");
  const std::string& name = seen.question.interface;
  if (*seen.multicast_route == name) return Ok("leads to " + name);
  const std::string where =
      seen.multicast_route->empty() ? "leads nowhere" : "leads to " + *seen.multicast_route;
  return Warning(
      where + ": what a program sends that names no interface does not get to " + name,
      "name " + name + " to every program; or as root: ip route add 224.0.0.0/4 dev " + name);
}

std::vector<std::pair<std::string_view, double>> Figures(const Tally& tally) {
  return {{"sent", tally.sent}, {"returned", tally.returned}};
}

std::string Counts(const Tally& tally) {
  return fmt::format("{} of {} came back", tally.returned, tally.sent);
}

constexpr char kOwnFirewall[] =
    "let this machine's firewall pass UDP on this interface, 239.255.0.1 too (nft list ruleset, "
    "iptables -S or ufw status, as root)";

Finding MulticastHere(const Evidence& seen) {
  if (!seen.self_multicast) return NotSeen("no socket could be made for it");
  const Tally& tally = *seen.self_multicast;
  if (tally.returned == tally.sent && tally.sent > 0) {
    return With(Ok(Counts(tally) + " from 239.255.0.1 to ourselves"), Figures(tally));
  }
  std::string text = Counts(tally) + " from 239.255.0.1 to ourselves";
  if (tally.error != 0) text += fmt::format(" ({})", std::strerror(tally.error));
  return With(Wrong(std::move(text), kOwnFirewall), Figures(tally));
}

// ---- the domain

Finding Domain(const Evidence& seen) {
  if (!seen.no_bus.empty()) {
    return Wrong(seen.no_bus, "put right what is wrong above, or choose another --domain");
  }
  const std::string joined =
      fmt::format("joined domain {} on {}", seen.question.domain, seen.question.interface);
  std::vector<std::string> who;
  for (const bus::Neighbour& one : seen.participants) who.push_back(bus::Describe(one));
  const auto count = static_cast<double>(who.size());
  if (who.empty()) return With(Ok(joined + ", alone"), {{"participants", count}});
  return With(Ok(fmt::format("{}, with {}: {}", joined, who.size(), Listed(who))),
              {{"participants", count}});
}

Finding Robots(const Evidence& seen) {
  if (!seen.no_bus.empty()) return NotSeen("there is no DDS");
  std::vector<std::string> speaking, silent;
  for (const Robot& one : seen.robots) (one.speaks ? speaking : silent).push_back(one.who);
  const std::size_t count = speaking.size();
  const std::string told = count == 0
                               ? "no robot speaks"
                               : fmt::format("{} speaks rt/lowstate: {}", count, Listed(speaking));
  const std::vector<std::pair<std::string_view, double>> figures = {
      {"speaking", static_cast<double>(count)}, {"silent", static_cast<double>(silent.size())}};
  const std::optional<int>& wanted = seen.question.robots;
  if (count > 1 && !wanted) {
    return With(Wrong(told + ": a program that hears both obeys neither",
                      "switch all but one off, or move them to other domains"),
                figures);
  }
  if (wanted && std::cmp_not_equal(*wanted, count)) {
    return With(Wrong(fmt::format("{}; expected {}", told, *wanted),
                      std::cmp_less(*wanted, count)
                          ? "switch the others off, or choose another --domain or --interface"
                          : "switch it on, and wait until it has started; then look at the rows "
                            "above"),
                figures);
  }
  if (count == 1 && !wanted) {
    return With(Warning(told + "; a simulated one would not start beside it",
                        "say with --robots 1 that it is wanted, or with --robots 0 that it is not"),
                figures);
  }
  if (!silent.empty()) {
    return With(Warning(told + ", and " + Listed(silent) + " has a silent writer of rt/lowstate",
                        "start a simulated robot before it, or with --set guard.on_stranger=warn"),
                figures);
  }
  return With(Ok(told), figures);
}

Finding RobotStates(const Evidence& seen) {
  const States& states = seen.states;
  if (!seen.no_bus.empty()) return NotSeen("there is no DDS");
  if (states.count < 2) return NotSeen("no robot speaks");
  const std::string text = fmt::format("rt/lowstate at {:.0f} Hz, {} at most between two",
                                       states.rate, Ms(states.longest_pause));
  const std::vector<std::pair<std::string_view, double>> figures = {
      {"rate", states.rate}, {"longest_pause", states.longest_pause}};
  if (states.longest_pause > kTenPeriods) {
    return With(Warning(text,
                        "see wakings, load and dropped of this machine, and the same on the "
                        "robot's"),
                figures);
  }
  return With(Ok(text), figures);
}

// ---- what others read and write

std::string Whose(const bus::Endpoint& endpoint) {
  const bus::Neighbour brief{
      .host = endpoint.who.host, .process = endpoint.who.process, .pid = endpoint.who.pid};
  return endpoint.topic + ": " + bus::Describe(brief) + (endpoint.writes ? " writes" : " reads");
}

bool IsOf(const std::vector<std::string_view>& types, const std::string& type) {
  return std::ranges::find(types, type) != types.end();
}

// The family of the one who writes rt/lowstate, "" if there is none, or if they differ.
std::string_view FamilyHere(const Evidence& seen) {
  std::string_view family;
  for (const bus::Endpoint& one : seen.endpoints) {
    if (one.topic != "rt/lowstate" || !one.writes) continue;
    const std::string_view its = FamilyOf(one.who.type);
    if (!family.empty() && its != family) return "";
    family = its;
  }
  return family;
}

// Whether a participant reads rt/lowstate of that family, too: a robot of this program listens for
// others of both.
bool HearsFamily(const Evidence& seen, const bus::ParticipantKey& who, std::string_view family) {
  return std::ranges::any_of(seen.endpoints, [&](const bus::Endpoint& one) {
    return one.topic == "rt/lowstate" && !one.writes && one.who.participant == who &&
           FamilyOf(one.who.type) == family;
  });
}

// What is wrong with its topic and type; "" if nothing is.
std::string WhyNotType(const Evidence& seen, const bus::Endpoint& one, std::string_view family) {
  const std::vector<std::string_view> types = TypesOf(one.topic);
  if (types.empty()) {
    const bool low = one.writes && one.who.type.ends_with("::LowCmd_") && !IsEchoTopic(one.topic);
    if (!low) return "";
    const std::string near = NearestWord(one.topic, VendorTopics());
    return " a LowCmd_ that no robot reads" + (near.empty() ? "" : "; is " + near + " meant?");
  }
  if (!IsOf(types, one.who.type)) {
    std::string expected;
    for (const std::string_view type : types) {
      expected += (expected.empty() ? "" : " or ") + std::string(type);
    }
    return " " + one.who.type + " instead of " + expected;
  }
  const std::string_view its = FamilyOf(one.who.type);
  const bool deaf =
      one.topic == "rt/lowstate" && !one.writes && !HearsFamily(seen, one.who.participant, family);
  if ((robot::IsBodyCommandTopic(one.topic) || deaf) && !family.empty() && its != family) {
    return fmt::format(" the {} type, and the robot here is of {}", its, family);
  }
  return "";
}

Finding Types(const Evidence& seen) {
  if (!seen.no_bus.empty()) return NotSeen("there is no DDS");
  const std::string_view family = FamilyHere(seen);
  std::vector<std::string> bad;
  std::size_t known = 0;
  for (const bus::Endpoint& one : seen.endpoints) {
    if (!TypesOf(one.topic).empty()) ++known;
    if (const std::string why = WhyNotType(seen, one, family); !why.empty()) {
      bad.push_back(Whose(one) + why);
    }
  }
  const std::vector<std::pair<std::string_view, double>> figures = {
      {"endpoints", static_cast<double>(known)}, {"mismatched", static_cast<double>(bad.size())}};
  if (bad.empty()) {
    return With(
        Ok(fmt::format("{} readers and writers of the vendor's topics, all of its types", known)),
        figures);
  }
  return With(Wrong(Listed(bad, "; "),
                    "build the program with the vendor's IDL, of the robot's family (go or hg)"),
              figures);
}

// Why an endpoint of the vendor's topic and type does not match the vendor's (docs/sources.md#dds);
// "" if it does.
std::string WhyNotQos(const bus::Endpoint& one) {
  if (!one.partitions.empty()) return "partition " + one.partitions;
  if (one.exclusive) return "exclusive ownership";
  if (one.writes) return "";
  if (one.keeps_for_late) return "durability above volatile";
  if (one.has_deadline) return "a deadline";
  if (!one.xcdr1) return "no XCDR1 among its representations";
  return "";
}

Finding Quality(const Evidence& seen) {
  if (!seen.no_bus.empty()) return NotSeen("there is no DDS");
  std::vector<std::string> bad, poor;
  for (const bus::Endpoint& one : seen.endpoints) {
    if (!IsOf(TypesOf(one.topic), one.who.type)) continue;
    if (const std::string why = WhyNotQos(one); !why.empty()) {
      bad.push_back(Whose(one) + " with " + why);
    } else if (one.writes && !one.reliable) {
      poor.push_back(Whose(one) + " as best effort");
    }
  }
  const std::vector<std::pair<std::string_view, double>> figures = {
      {"unmatched", static_cast<double>(bad.size())},
      {"best_effort_writers", static_cast<double>(poor.size())}};
  if (!bad.empty()) {
    return With(Wrong(Listed(bad, "; ") + ": nothing passes between it and the vendor's",
                      "use the vendor's: volatile, shared, no partition, no deadline, XCDR1"),
                figures);
  }
  if (!poor.empty()) {
    return With(Warning(Listed(poor, "; ") + ": no reliable reader, such as ROS 2's, hears it",
                        "make the writer reliable, as the vendor's are"),
                figures);
  }
  return With(Ok("what others ask for matches the vendor's"), figures);
}

// ---- the peer

constexpr char kNoPeer[] = "no peer was named";

std::string EchoThere(const Evidence& seen) {
  return fmt::format("on {}: understudy doctor --echo --domain {} --interface ...",
                     seen.question.peer, seen.question.domain);
}

Finding PeerFound(const Evidence& seen) {
  if (!seen.peer) return NotSeen(kNoPeer, "name one with --peer, once it runs doctor --echo");
  if (seen.peer->found) return Ok(seen.peer->who);
  if (!seen.no_bus.empty()) return NotSeen("there is no DDS");
  return Wrong("DDS does not find '" + seen.question.peer + "'",
               EchoThere(seen) + "; if it runs, the multicast rows tell what is in the way");
}

// `what` was asked of the peer, by datagrams beside DDS.
Finding Datagrams(const Evidence& seen, const Tally& tally, const std::string& remedy) {
  if (seen.peer->no_address) return NotSeen(*seen.peer->no_address, "give --peer an address");
  const auto judged = [&](Finding finding) { return With(std::move(finding), Figures(tally)); };
  if (tally.sent > 0 && tally.returned >= tally.sent) return judged(Ok(Counts(tally)));
  const std::string counts = Counts(tally);
  if (tally.returned > 0) {
    return judged(
        Warning(counts, "find what loses them: a cable, a switch, Wi-Fi, a busy machine"));
  }
  switch (tally.error) {
    case EPERM:
      return judged(Wrong(counts + ": a firewall of this machine forbids to send", kOwnFirewall));
    case ECONNREFUSED:
      return judged(
          Wrong(counts + ": that machine is there, and no echo runs on it", EchoThere(seen)));
    case EHOSTUNREACH:
      return judged(Wrong(counts + ": no machine answers to that address on this network",
                          "check its address, and that it is on the same cable or switch"));
    case ENETUNREACH:
      return judged(
          Wrong(counts + ": no route leads there", "give both machines addresses of one network"));
    default:
      return judged(Wrong(counts, remedy));
  }
}

Finding PeerUnicast(const Evidence& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  return Datagrams(seen, seen.peer->unicast,
                   "a firewall, there or here, drops it, or nothing is there: " + EchoThere(seen));
}

constexpr char kMulticastWay[] =
    "a firewall, or a switch or access point that does not pass multicast (IGMP snooping without a "
    "querier): connect the two directly to tell which";

Finding PeerMulticast(const Evidence& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  return Datagrams(seen, seen.peer->multicast, kMulticastWay);
}

Finding MulticastFromPeer(const Evidence& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  if (seen.peer->unicast.returned == 0) return NotSeen("no datagram comes back from the peer");
  return Datagrams(seen, seen.peer->from_peer, kMulticastWay);
}

// Its rules are for root to read. What it does is for everybody to see.
Finding Firewall(const Evidence& seen) {
  const auto forbidden = [](const Tally& tally) { return tally.error == EPERM; };
  const bool here = seen.self_multicast && forbidden(*seen.self_multicast);
  if (here || (seen.peer && (forbidden(seen.peer->unicast) || forbidden(seen.peer->multicast)))) {
    return Wrong("this machine's forbids to send", kOwnFirewall);
  }
  if (!seen.peer) {
    return NotSeen("its rules are readable as root only", "name a --peer: packets tell");
  }
  const Peer& peer = *seen.peer;
  const auto passes = [](const Tally& tally) { return tally.returned > 0; };
  if (passes(peer.unicast) && passes(peer.multicast) && passes(peer.from_peer)) {
    return Ok("neither this machine's nor the peer's stops what was sent");
  }
  if (peer.found && !peer.no_address && !passes(peer.unicast) && peer.unicast.error == 0) {
    return Wrong("DDS finds the peer, and no datagram comes back from it",
                 std::string("there and here: ") + kOwnFirewall);
  }
  return NotSeen("its rules are readable as root only; the rows above tell what does not pass");
}

Finding RoundTrip(const Evidence& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  const Peer& peer = *seen.peer;
  if (peer.sent == 0) return NotSeen("the peer was not found");
  const int lost = peer.sent - peer.returned;
  const double share = static_cast<double>(lost) / peer.sent;
  const Spread& spread = peer.there_and_back;
  const std::vector<std::pair<std::string_view, double>> figures = {{"sent", peer.sent},
                                                                    {"lost", lost},
                                                                    {"p50", spread.p50},
                                                                    {"p99", spread.p99},
                                                                    {"worst", spread.worst}};
  const std::string sizes = seen.question.hg ? "hg LowCmd and LowState" : "go LowCmd and LowState";
  if (peer.returned == 0) {
    return With(Wrong(fmt::format("{}: none of {} came back", sizes, peer.sent),
                      "see unicast and multicast to the peer; DDS takes ports of its own there"),
                figures);
  }
  const std::string text =
      fmt::format("{} at 500 Hz: {} p50, {} p99, {} worst; lost {} of {} ({:.2g} %)", sizes,
                  Ms(spread.p50), Ms(spread.p99), Ms(spread.worst), lost, peer.sent, share * 100);
  const std::string remedy =
      "use a cable, not Wi-Fi; see wakings, load and dropped, here and there";
  const bool wrong =
      share >= kLostWrong || spread.p99 > kTenPeriods || spread.worst > kDampingAfter;
  if (wrong) return With(Wrong(text, remedy), figures);
  if (lost > 0 || spread.p99 > kLatePeriod) return With(Warning(text, remedy), figures);
  return With(Ok(text), figures);
}

// ---- this machine

Finding Buffers(const Evidence& seen) {
  if (!seen.receive_buffer || !seen.send_buffer) return NotSeen("no socket could be made");
  const std::string text = fmt::format(
      "{} KiB to receive (Cyclone asks for {}), {} KiB to send ({})", *seen.receive_buffer >> 10,
      kCycloneReceive >> 10, *seen.send_buffer >> 10, kCycloneSend >> 10);
  const std::vector<std::pair<std::string_view, double>> figures = {
      {"receive", *seen.receive_buffer}, {"send", *seen.send_buffer}};
  std::string remedy;
  if (*seen.receive_buffer < kCycloneReceive) {
    remedy += fmt::format(" net.core.rmem_max={}", kCycloneReceive);
  }
  if (*seen.send_buffer < kCycloneSend)
    remedy += fmt::format(" net.core.wmem_max={}", kCycloneSend);
  if (remedy.empty()) return With(Ok(text), figures);
  return With(Warning(text, "as root: sysctl -w" + remedy), figures);
}

Finding Dropped(const Evidence& seen) {
  if (!seen.dropped) return NotSeen("the kernel did not tell");
  const DropCounts& counts = *seen.dropped;
  const std::string text = fmt::format(
      "{} damaged, {} dropped on {}; {} found a receive buffer full", counts.interface_errors,
      counts.interface_dropped, seen.question.interface, counts.buffer_full);
  const std::vector<std::pair<std::string_view, double>> figures = {
      {"damaged", static_cast<double>(counts.interface_errors)},
      {"dropped", static_cast<double>(counts.interface_dropped)},
      {"buffer_full", static_cast<double>(counts.buffer_full)}};
  if (counts.buffer_full > 0) {
    return With(Warning(text, "a program reads too slowly, or its buffers are small: see buffers"),
                figures);
  }
  if (counts.interface_errors > 0) {
    return With(Warning(text, "try another cable or port"), figures);
  }
  if (counts.interface_dropped > 0) {
    return With(Warning(text, "see load; ip -s link tells which way they went"), figures);
  }
  return With(Ok(text), figures);
}

Finding Realtime(const Evidence& seen) {
  if (!seen.rights) return NotSeen("not asked for");
  if (seen.rights->fifo) return Ok("SCHED_FIFO is granted");
  return Warning(fmt::format("no SCHED_FIFO: the rtprio limit is {}", seen.rights->priority_limit),
                 "an rtprio limit of 10, or CAP_SYS_NICE (docs/realtime.md)");
}

Finding Memory(const Evidence& seen) {
  if (!seen.rights) return NotSeen("not asked for");
  if (seen.rights->locked) return Ok("may be locked");
  return Warning(fmt::format("may not be locked: the memlock limit is {} KiB",
                             seen.rights->memory_limit >> 10),
                 "an unlimited memlock limit, or CAP_IPC_LOCK (docs/realtime.md)");
}

Finding Governor(const Evidence& seen) {
  if (seen.governors.empty()) return NotSeen("the kernel shows none, as in a virtual machine");
  if (seen.governors == std::vector<std::string>{"performance"}) return Ok("performance");
  return Warning(Listed(seen.governors) + ": cores slow down between two commands",
                 "as root: cpupower frequency-set -g performance");
}

Finding Load(const Evidence& seen) {
  if (!seen.load) return NotSeen("the kernel did not tell");
  const std::string text = fmt::format("{:.1f} on {} cores", *seen.load, seen.cores);
  const std::vector<std::pair<std::string_view, double>> figures = {{"load", *seen.load},
                                                                    {"cores", seen.cores}};
  if (*seen.load <= seen.cores) return With(Ok(text), figures);
  return With(
      Warning(text + ": programs wait for one another", "end what the test does not need (top)"),
      figures);
}

Finding Wakings(const Evidence& seen) {
  const Spread& late = seen.lateness;
  if (late.count == 0) return NotSeen("nothing was measured");
  const std::string text = fmt::format("an ordinary thread woke {} late p50, {} p99, {} worst",
                                       Ms(late.p50), Ms(late.p99), Ms(late.worst));
  const std::vector<std::pair<std::string_view, double>> figures = {
      {"p50", late.p50}, {"p99", late.p99}, {"worst", late.worst}};
  if (late.p99 <= kLateWaking) return With(Ok(text), figures);
  return With(Warning(text, "see load and governor; real-time rights help (docs/realtime.md)"),
              figures);
}

Finding ClockSource(const Evidence& seen) {
  if (seen.clock_source.empty()) return NotSeen("the kernel did not tell");
  constexpr std::string_view kSlow[] = {"hpet", "acpi_pm", "pit", "jiffies", "refined-jiffies"};
  if (std::ranges::find(kSlow, seen.clock_source) == std::end(kSlow)) return Ok(seen.clock_source);
  return Warning(seen.clock_source + ": coarse, or slow to read",
                 "find out in the kernel's log why it is not tsc (dmesg)");
}

Finding ClockSteps(const Evidence& seen) {
  const ClockCourse& clock = seen.clock;
  const std::vector<std::pair<std::string_view, double>> figures = {{"steps", clock.steps},
                                                                    {"largest", clock.largest}};
  if (clock.steps == 0) return With(Ok("the system's clock went evenly"), figures);
  return With(Wrong(fmt::format("the system's clock jumped {} times, by {:+.3f} s at most",
                                clock.steps, clock.largest),
                    "let one daemon alone set it, by slewing (chrony: makestep 1 3)"),
              figures);
}

Finding ClockSynchronised(const Evidence& seen) {
  if (!seen.sync) return NotSeen("the kernel did not tell");
  if (seen.sync->synchronised) {
    return With(Ok("to " + Ms(seen.sync->error)), {{"error", seen.sync->error}});
  }
  if (IsLoopback(seen)) return Ok("it is not, and one machine needs none");
  return Warning("no daemon keeps it: times that two machines write down do not compare",
                 "run chrony or ptp4l with phc2sys, on both machines");
}

Finding ClockApart(const Evidence& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  if (!seen.peer->offset) return NotSeen("no message came back from the peer");
  const ClockOffset& offset = *seen.peer->offset;
  const std::string text =
      fmt::format("the peer's is {:+.2f} ms ahead, to {}", offset.ahead * 1e3, Ms(offset.error));
  const std::vector<std::pair<std::string_view, double>> figures = {{"ahead", offset.ahead},
                                                                    {"error", offset.error}};
  if (std::abs(offset.ahead) - offset.error <= kLatePeriod) return With(Ok(text), figures);
  return With(Warning(text + ": times that the two write down do not compare",
                      "run chrony or ptp4l with phc2sys, on both machines"),
              figures);
}

constexpr Check kChecks[] = {
    {"interface", "is it there, up, and is something at the other end", Interface},
    {"address", "IPv4 addresses: none, two in one network, in the robot's or not", Addresses},
    {"multicast", "the interface's flag, without which DDS finds nobody elsewhere", MulticastFlag},
    {"multicast route", "where multicast goes that names no interface", MulticastRoute},
    {"multicast here", "datagrams to the group of DDS, and back to ourselves", MulticastHere},
    {"domain", "can it be joined, and who is on it", Domain},
    {"robots", "who writes rt/lowstate, and who only could", Robots},
    {"states", "rate and longest pause of rt/lowstate", RobotStates},
    {"types", "are the vendor's topics read and written in the vendor's types", Types},
    {"quality", "does the quality of service of others match the vendor's", Quality},
    {"peer", "does DDS find the echo that was named", PeerFound},
    {"peer unicast", "datagrams to the peer and back", PeerUnicast},
    {"peer multicast", "datagrams to the group of DDS, which the peer answers", PeerMulticast},
    {"from peer", "answers that the peer sends to the group of DDS", MulticastFromPeer},
    {"firewall", "what the datagrams tell of it", Firewall},
    {"round trip", "messages as large, frequent and reliable as LowCmd and LowState", RoundTrip},
    {"buffers", "what a socket gets that asks for as much as Cyclone DDS does", Buffers},
    {"dropped", "packets lost on the interface and before full buffers, in the test", Dropped},
    {"real-time", "may a robot's loop run under SCHED_FIFO", Realtime},
    {"memory", "may its memory be locked", Memory},
    {"governor", "how the cores' frequency is chosen", Governor},
    {"load", "programs that wanted to run in the last minute, for each core", Load},
    {"wakings", "how late a thread wakes that sleeps for 2 ms", Wakings},
    {"clock source", "what the kernel reads time from", ClockSource},
    {"clock steps", "jumps of the system's clock against the monotonic one, in the test",
     ClockSteps},
    {"clock sync", "does a daemon of NTP or PTP keep the system's clock", ClockSynchronised},
    {"clock offset", "how far the peer's system clock is ahead of ours", ClockApart},
};

}  // namespace

std::string_view Word(Verdict verdict) {
  switch (verdict) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kWarning:
      return "warning";
    case Verdict::kWrong:
      return "wrong";
    case Verdict::kNotSeen:
      break;
  }
  return "not seen";
}

std::span<const Check> Checks() { return kChecks; }

Spread SpreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto rank = [&](double share) {
    const auto nth =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(nth, 1) - 1];
  };
  return {.count = values.size(), .p50 = rank(0.5), .p99 = rank(0.99), .worst = values.back()};
}

}  // namespace understudy::doctor
