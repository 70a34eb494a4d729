// Datagrams beside DDS, on the group of its discovery: they tell what the network lets pass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <netinet/in.h>

#include "base/unique_fd.h"
#include "doctor/measurements.h"

namespace understudy::doctor {

// The group of discovery (DDSI-RTPS 2.2, section 9.6.1.4), 239.255.0.1, in the host's byte order.
inline constexpr std::uint32_t kDiscoveryGroup = 0xEFFF0001;

// Returns a port among those of the domain, which firewalls pass or not with them: that of the
// discovery of participant 60, to which Cyclone never gets.
std::uint16_t ProbePort(int domain);

enum class DatagramKind : std::uint8_t {
  kAskOne = 1,      // to one echo, which answers to both
  kAskAll = 2,      // to the group, which answers to the sender
  kAnswerOne = 3,   // to kAskOne, to its sender
  kAnswerAll = 4,   // to kAskAll, to its sender
  kAnswerGroup = 5  // to kAskOne, to the group
};

struct Datagram {
  DatagramKind kind = DatagramKind::kAskOne;
  std::uint32_t session = 0;  // of who asks
  std::uint32_t number = 0;
  std::string name{};  // of who answers, cut to 32 bytes

  friend bool operator==(const Datagram&, const Datagram&) = default;
};

// All have one length, so that an answer is never longer than what was asked.
inline constexpr std::size_t kDatagramBytes = 52;
std::array<std::byte, kDatagramBytes> Encode(const Datagram& datagram);
// Returns nullopt for what Encode does not make. Control characters in the name are replaced.
std::optional<Datagram> Decode(std::span<const std::byte> bytes);

// Answers all clients on one interface and domain.
class ProbeServer {
 public:
  // `address` is the interface's own, in the host's byte order. Throws BusError if the port cannot
  // be had.
  ProbeServer(const std::string& interface, std::uint32_t address, int domain, std::string name);

  // Answers what has arrived. Never blocks.
  void Answer();
  int fd() const { return socket_.get(); }

 private:
  std::string name_;
  std::uint16_t port_;
  UniqueFd socket_;
};

// Asks the group, and a peer once its address is known.
class ProbeClient {
 public:
  // `address` as above, `session` a number that others do not have. `peer_name` is the name by
  // which the peer may answer. Throws BusError.
  ProbeClient(const std::string& interface, std::uint32_t address, int domain,
              std::uint32_t session, const std::string& peer_name);

  // The peer's address, in the host's byte order; 0 while it is not known. Answers tell it, too.
  void SetPeer(std::uint32_t address) { peer_ = address; }
  std::uint32_t peer() const { return peer_; }

  // Sends one datagram to the group and one to the peer.
  void Ask();
  // Counts what has arrived. Never blocks.
  void Receive();
  // Readable when something has arrived.
  int own_fd() const { return own_.get(); }
  int group_fd() const { return group_.get(); }

  const DatagramCount& self_multicast() const { return self_; }
  const DatagramCount& unicast() const { return unicast_; }
  const DatagramCount& multicast() const { return multicast_; }
  DatagramCount from_peer() const;  // asked as often as unicast() was answered

 private:
  // Counts a number once.
  static void Count(std::uint32_t number, std::vector<bool>* seen, DatagramCount* tally);
  void Send(DatagramKind kind, std::uint32_t to, DatagramCount* tally);
  void Take(int socket);
  void Note(const Datagram& datagram, std::uint32_t from);

  std::uint32_t session_;
  std::string peer_name_;
  std::uint16_t port_;
  UniqueFd own_, group_;
  std::uint32_t peer_ = 0;
  std::uint32_t number_ = 0;
  DatagramCount self_, unicast_, multicast_, from_peer_;
  std::vector<bool> self_seen_, unicast_seen_, multicast_seen_, from_peer_seen_;
};

}  // namespace understudy::doctor
