// What passes between this machine and another.
#include <cerrno>

#include "doctor/findings.h"

namespace understudy::doctor {
namespace {

// *Assumed*.
constexpr double kDampingAfter = 0.2;  // s: gate.timeout's default, after which the motors damp
constexpr double kLostWrong = 0.01;    // share of messages

std::string EchoThere(const Measurements& seen) {
  return fmt::format(
      "on {0}: understudy doctor --echo --domain {1} --interface ..., or where it is not installed "
      "examples/python/doctor_echo.py --domain {1} --interface ...",
      seen.question.peer, seen.question.domain);
}

Finding PeerFound(const Measurements& seen) {
  if (!seen.peer) return NotSeen(kNoPeer, "name one with --peer, once it runs doctor --echo");
  if (seen.peer->found) return Ok(seen.peer->who);
  if (!seen.no_bus.empty()) return NotSeen(kNoBus);
  return Wrong("DDS does not find '" + seen.question.peer + "'",
               EchoThere(seen) + "; if it runs, the multicast rows tell what is in the way");
}

// `what` was asked of the peer, by datagrams beside DDS.
Finding Datagrams(const Measurements& seen, const DatagramCount& tally, const std::string& remedy) {
  if (seen.peer->no_address) return NotSeen(*seen.peer->no_address, "give --peer an address");
  const auto judged = [&](Finding finding) { return With(std::move(finding), FiguresOf(tally)); };
  if (tally.sent > 0 && tally.returned >= tally.sent) return judged(Ok(Counts(tally)));
  const std::string counts = Counts(tally);
  if (tally.returned > 0) {
    return judged(
        Warning(counts, "find what loses them: a cable, a switch, Wi-Fi, a busy machine"));
  }
  switch (tally.error) {
    case EPERM:
      return judged(
          Wrong(counts + ": a firewall on this machine forbids it to send", kOwnFirewall));
    case ECONNREFUSED:
      return judged(
          Wrong(counts + ": that machine is there, but no echo runs on it", EchoThere(seen)));
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

Finding PeerUnicast(const Measurements& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  return Datagrams(seen, seen.peer->unicast,
                   "a firewall, there or here, drops it, or nothing is there: " + EchoThere(seen));
}

constexpr char kMulticastWay[] =
    "a firewall, or a switch or access point that does not pass multicast (IGMP snooping without a "
    "querier): connect the two directly to tell which";

Finding PeerMulticast(const Measurements& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  return Datagrams(seen, seen.peer->multicast, kMulticastWay);
}

Finding MulticastFromPeer(const Measurements& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  if (seen.peer->unicast.returned == 0) return NotSeen("no datagram comes back from the peer");
  return Datagrams(seen, seen.peer->from_peer, kMulticastWay);
}

// Its rules are for root to read, by one of several tools. What it does is for everybody to see.
Finding Firewall(const Measurements& seen) {
  const auto forbidden = [](const DatagramCount& tally) { return tally.error == EPERM; };
  const bool here = seen.self_multicast && forbidden(*seen.self_multicast);
  if (here || (seen.peer && (forbidden(seen.peer->unicast) || forbidden(seen.peer->multicast)))) {
    return Wrong("this machine's firewall forbids it to send", kOwnFirewall);
  }
  if (!seen.peer) {
    return NotSeen("firewall rules are not read", "name a --peer: packets to it show what passes");
  }
  const Peer& peer = *seen.peer;
  const auto passes = [](const DatagramCount& tally) { return tally.returned > 0; };
  if (passes(peer.unicast) && passes(peer.multicast) && passes(peer.from_peer)) {
    return Ok("neither this machine's firewall nor the peer's stops what was sent");
  }
  if (peer.found && !peer.no_address && !passes(peer.unicast) && peer.unicast.error == 0) {
    return Wrong("DDS finds the peer, and no datagram comes back from it",
                 std::string("there and here: ") + kOwnFirewall);
  }
  return NotSeen("firewall rules are not read; the rows above tell what does not pass");
}

Finding RoundTrip(const Measurements& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  const Peer& peer = *seen.peer;
  if (peer.sent == 0) return NotSeen("the peer was not found");
  const int lost = peer.sent - peer.returned;
  const double share = static_cast<double>(lost) / peer.sent;
  const Spread& spread = peer.there_and_back;
  const Figures figures = {{"sent", peer.sent},
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

constexpr Check kPeerChecks[] = {
    {"peer", "does DDS find the echo that was named", PeerFound},
    {"peer unicast", "datagrams to the peer and back", PeerUnicast},
    {"peer multicast", "datagrams to the group of DDS, which the peer answers", PeerMulticast},
    {"from peer", "answers that the peer sends to the group of DDS", MulticastFromPeer},
    {"firewall", "what the datagrams show", Firewall},
    {"round trip", "messages as large, frequent and reliable as LowCmd and LowState", RoundTrip},
};

}  // namespace

std::span<const Check> PeerChecks() { return kPeerChecks; }

}  // namespace understudy::doctor
