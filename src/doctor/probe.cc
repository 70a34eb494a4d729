#include "doctor/probe.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include <net/if.h>
#include <sys/socket.h>

#include "base/errors.h"

namespace understudy::doctor {
namespace {

constexpr std::string_view kMagic = "UNDERDOC";
constexpr std::size_t kNameBytes = 32;
constexpr std::size_t kKindAt = 8, kSessionAt = 12, kNumberAt = 16, kNameAt = 20;
static_assert(kNameAt + kNameBytes == kDatagramBytes);

void PutNumber(std::uint32_t number, std::byte* to) {
  const std::uint32_t wire = htonl(number);
  std::memcpy(to, &wire, sizeof wire);
}

std::uint32_t NumberAt(const std::byte* from) {
  std::uint32_t wire = 0;
  std::memcpy(&wire, from, sizeof wire);
  return ntohl(wire);
}

sockaddr_in To(std::uint32_t address, std::uint16_t port) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(address);
  to.sin_port = htons(port);
  return to;
}

void Require(bool held, const std::string& what) {
  if (!held) throw BusError("no probe: " + what + ": " + std::strerror(errno));
}

template <class Value>
bool SetOption(const UniqueFd& socket, int option, const Value& value) {
  return ::setsockopt(socket.get(), IPPROTO_IP, option, &value, sizeof value) == 0;
}

UniqueFd Bound(std::uint32_t address, std::uint16_t port) {
  UniqueFd made(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  Require(made.valid(), "making a socket");
  const int yes = 1;
  if (port != 0) ::setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const sockaddr_in at = To(address, port);
  Require(::bind(made.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0,
          "binding port " + std::to_string(port));
  return made;
}

// `address` is the interface's own: without it the kernel may send another's, as on lo.
ip_mreqn GroupOn(const std::string& interface, std::uint32_t address) {
  ip_mreqn group{};
  group.imr_address.s_addr = htonl(address);
  group.imr_multiaddr.s_addr = htonl(kDiscoveryGroup);
  group.imr_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  return group;
}

void Join(const UniqueFd& socket, const ip_mreqn& group) {
  Require(SetOption(socket, IP_ADD_MEMBERSHIP, group), "joining 239.255.0.1");
  SetOption(socket, IP_MULTICAST_ALL, 0);
}

// Returns 0 or errno.
int SendTo(int socket, const Datagram& datagram, const sockaddr_in& to) {
  const auto bytes = Encode(datagram);
  const ssize_t sent = ::sendto(socket, bytes.data(), bytes.size(), 0,
                                reinterpret_cast<const sockaddr*>(&to), sizeof to);
  return sent < 0 ? errno : 0;
}

// Calls visit(Datagram, sockaddr_in) for what has arrived, 256 at most, and returns the last error
// that the socket told, 0 for none.
template <class Visit>
int ReceiveAll(int socket, Visit&& visit) {
  constexpr int kAtOnce = 256;
  int error = 0;
  for (int i = 0; i < kAtOnce; ++i) {
    std::array<std::byte, kDatagramBytes + 1> bytes;  // one more: a longer one is seen as such
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t got = ::recvfrom(socket, bytes.data(), bytes.size(), 0,
                                   reinterpret_cast<sockaddr*>(&from), &size);
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return error;
    if (got < 0) {
      error = errno;
      continue;
    }
    const auto datagram = Decode(std::span(bytes).first(static_cast<std::size_t>(got)));
    if (datagram) visit(*datagram, from);
  }
  return error;
}

}  // namespace

std::uint16_t ProbePort(int domain) {
  return static_cast<std::uint16_t>(7400 + 250 * domain + 130);
}

std::array<std::byte, kDatagramBytes> Encode(const Datagram& datagram) {
  std::array<std::byte, kDatagramBytes> bytes{};
  std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
  bytes[kKindAt] = static_cast<std::byte>(datagram.kind);
  PutNumber(datagram.session, bytes.data() + kSessionAt);
  PutNumber(datagram.number, bytes.data() + kNumberAt);
  std::memcpy(bytes.data() + kNameAt, datagram.name.data(),
              std::min(datagram.name.size(), kNameBytes));
  return bytes;
}

std::optional<Datagram> Decode(std::span<const std::byte> bytes) {
  if (bytes.size() != kDatagramBytes) return std::nullopt;
  if (std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) return std::nullopt;
  const auto kind = static_cast<std::uint8_t>(bytes[kKindAt]);
  if (kind < static_cast<std::uint8_t>(DatagramKind::kAskOne) ||
      kind > static_cast<std::uint8_t>(DatagramKind::kAnswerGroup)) {
    return std::nullopt;
  }
  const char* const name = reinterpret_cast<const char*>(bytes.data()) + kNameAt;
  Datagram datagram{.kind = static_cast<DatagramKind>(kind),
                    .session = NumberAt(bytes.data() + kSessionAt),
                    .number = NumberAt(bytes.data() + kNumberAt),
                    .name = std::string(name, ::strnlen(name, kNameBytes))};
  for (char& letter : datagram.name) {
    if (std::iscntrl(static_cast<unsigned char>(letter)) != 0) letter = '?';
  }
  return datagram;
}

ProbeServer::ProbeServer(const std::string& interface, std::uint32_t address, int domain,
                         std::string name)
    : name_(std::move(name)), port_(ProbePort(domain)), socket_(Bound(INADDR_ANY, port_)) {
  const ip_mreqn group = GroupOn(interface, address);
  Join(socket_, group);
  Require(SetOption(socket_, IP_MULTICAST_IF, group), "sending to 239.255.0.1");
}

void ProbeServer::Answer() {
  ReceiveAll(socket_.get(), [&](Datagram datagram, const sockaddr_in& from) {
    const bool one = datagram.kind == DatagramKind::kAskOne;
    if (!one && datagram.kind != DatagramKind::kAskAll) return;
    datagram.name = name_;
    datagram.kind = one ? DatagramKind::kAnswerOne : DatagramKind::kAnswerAll;
    SendTo(socket_.get(), datagram, from);
    if (!one) return;
    datagram.kind = DatagramKind::kAnswerGroup;
    SendTo(socket_.get(), datagram, To(kDiscoveryGroup, port_));
  });
}

ProbeClient::ProbeClient(const std::string& interface, std::uint32_t address, int domain,
                         std::uint32_t session, const std::string& peer_name)
    : session_(session),
      peer_name_(peer_name.substr(0, kNameBytes)),
      port_(ProbePort(domain)),
      own_(Bound(address, 0)),
      group_(Bound(kDiscoveryGroup, port_)) {
  const ip_mreqn group = GroupOn(interface, address);
  Join(group_, group);
  Require(SetOption(own_, IP_MULTICAST_IF, group), "sending to 239.255.0.1");
  SetOption(own_, IP_RECVERR, 1);  // reports ICMP errors
}

void ProbeClient::Ask() {
  ++number_;
  Send(DatagramKind::kAskAll, kDiscoveryGroup, &multicast_);
  self_.sent = multicast_.sent;
  self_.error = multicast_.error;
  if (peer_ != 0) Send(DatagramKind::kAskOne, peer_, &unicast_);
}

void ProbeClient::Send(DatagramKind kind, std::uint32_t to, DatagramCount* tally) {
  ++tally->sent;
  const Datagram datagram{.kind = kind, .session = session_, .number = number_};
  int error = SendTo(own_.get(), datagram, To(to, port_));
  if (error == ECONNREFUSED || error == EHOSTUNREACH) {
    unicast_.error = error;  // of an earlier one: the kernel tells it with the next call, and once
    error = SendTo(own_.get(), datagram, To(to, port_));
  }
  if (error != 0) tally->error = error;
}

void ProbeClient::Receive() {
  Take(own_.get());
  Take(group_.get());
}

void ProbeClient::Take(int socket) {
  const int error = ReceiveAll(socket, [&](const Datagram& datagram, const sockaddr_in& from) {
    if (datagram.session == session_) Note(datagram, ntohl(from.sin_addr.s_addr));
  });
  if (error != 0) unicast_.error = error;  // ICMP answers what is sent to one
  // The kernel queues a copy of each error, which keeps the socket readable.
  std::array<std::byte, kDatagramBytes> copy;
  while (::recv(socket, copy.data(), copy.size(), MSG_ERRQUEUE) >= 0) {
  }
}

void ProbeClient::Note(const Datagram& datagram, std::uint32_t from) {
  if (datagram.kind == DatagramKind::kAskAll) return Count(datagram.number, &self_seen_, &self_);
  if (peer_ == 0 && !peer_name_.empty() && datagram.name == peer_name_) peer_ = from;
  if (from != peer_ || peer_ == 0) return;
  switch (datagram.kind) {
    case DatagramKind::kAnswerOne:
      return Count(datagram.number, &unicast_seen_, &unicast_);
    case DatagramKind::kAnswerAll:
      return Count(datagram.number, &multicast_seen_, &multicast_);
    case DatagramKind::kAnswerGroup:
      return Count(datagram.number, &from_peer_seen_, &from_peer_);
    case DatagramKind::kAskOne:
    case DatagramKind::kAskAll:
      return;
  }
}

void ProbeClient::Count(std::uint32_t number, std::vector<bool>* seen, DatagramCount* tally) {
  constexpr std::uint32_t kMost = 1U << 20U;
  if (number > kMost) return;
  if (seen->size() <= number) seen->resize(number + 1);
  if ((*seen)[number]) return;
  (*seen)[number] = true;
  ++tally->returned;
}

DatagramCount ProbeClient::from_peer() const {
  DatagramCount tally = from_peer_;
  tally.sent = std::max(unicast_.returned, from_peer_.returned);
  return tally;
}

}  // namespace understudy::doctor
