// Our place on the bus: one DDS domain on one network interface.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "bus/entity.h"
#include "bus/interfaces.h"

namespace understudy::bus {

// Names a participant on the whole network: its DDS GUID.
using ParticipantKey = std::array<std::uint8_t, 16>;

// The last domain whose ports fit into 16 bits (DDSI 2.2, section 9.6.1: 7400 + 250 · domain).
inline constexpr int kLastDomain = 232;

// A domain and the one participant in it. Configured like the vendor's SDK by explicit XML
// (docs/sources.md#dds), so that CYCLONEDDS_URI does not count. Must outlive the readers and
// writers made with it.
//
// Without the MULTICAST flag Cyclone discovers others by unicast, on this machine only, and a
// domain has room for nine programs (measured, Cyclone 0.10.2): see multicast().
class Participant {
 public:
  // Throws BusError when the interface is absent, down or without IPv4 address, when the domain id
  // is outside 0..kLastDomain, when this process has the domain already, and when Cyclone refuses,
  // with Cyclone's own words.
  Participant(const std::string& interface, int domain);

  const std::string& interface() const { return interface_.name; }
  int domain() const { return domain_id_; }
  bool multicast() const { return interface_.multicast; }
  const ParticipantKey& key() const { return key_; }

  std::int32_t handle() const { return participant_.handle(); }

 private:
  NetworkInterface interface_;
  int domain_id_;
  Entity domain_;       // outlives participant_
  Entity participant_;  // the parent of all readers and writers
  ParticipantKey key_{};
};

}  // namespace understudy::bus
