// Joins one DDS domain on one network interface.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bus/entity.h"
#include "bus/interfaces.h"
#include "bus/traffic.h"

namespace understudy::bus {

// The DDS GUID of a participant, unique on the network.
using ParticipantKey = std::array<std::uint8_t, 16>;

// Returns whose a writer is that matches the reader, by its handle; nullopt if it no longer does.
std::optional<ParticipantKey> ParticipantOf(const Entity& reader, std::uint64_t writer);

// The last domain whose ports fit into 16 bits (DDSI-RTPS 2.2, section 9.6.1: 7400 + 250 · domain).
inline constexpr int kLastDomain = 232;

// Owns a domain of Cyclone's. Its destructor takes no longer than 5 s: a thread of Cyclone 0.10.2
// that receives ends by a packet to itself, and where a firewall drops it, Cyclone waits for ever.
// Such a domain then ends with the process.
class Domain {
 public:
  Domain(Entity domain, std::uint32_t number) : domain_(std::move(domain)), number_(number) {}
  ~Domain();
  Domain(Domain&&) noexcept = default;
  Domain& operator=(Domain&&) noexcept = default;

  std::uint32_t number() const { return number_; }

 private:
  Entity domain_;
  std::uint32_t number_;
};

// A domain and our participant in it. Configured by explicit XML like the vendor's SDK
// (docs/dev/sources.md#dds), so CYCLONEDDS_URI has no effect. Must outlive its readers and writers.
//
// It takes well-known ports, as Cyclone by itself does only where there is no multicast: clients
// that are set up without multicast and with `Peers` ask at these.
//
// On an interface without the MULTICAST flag (see multicast()) Cyclone discovers by unicast, on
// this machine only, and a domain has room for nine programs (measured, Cyclone 0.10.2).
class Participant {
 public:
  // `announcement` is what AnnouncementWatch tells others of this participant (DDS user data), and
  // `partition` that of DDS for its topics; "" is none. A process may have any number in one
  // domain. Throws BusError if FindInterface does, if the domain is outside 0..kLastDomain, if
  // limits leave too few descriptors or too little memory, and, with Cyclone's message, if Cyclone
  // refuses.
  Participant(const std::string& interface, int domain, const std::string& announcement = "",
              const std::string& partition = "");

  const std::string& interface() const { return interface_.name; }
  int domain() const { return domain_id_; }
  bool multicast() const { return interface_.multicast; }
  const ParticipantKey& key() const { return key_; }
  const std::string& announcement() const { return announcement_; }
  const std::string& partition() const { return partition_; }

  // The counts of all its readers and writers.
  Traffic& traffic() const { return *traffic_; }

  std::int32_t handle() const { return participant_.handle(); }
  // The parents of writers and readers.
  std::int32_t publisher() const { return publisher_ ? publisher_->handle() : handle(); }
  std::int32_t subscriber() const { return subscriber_ ? subscriber_->handle() : handle(); }

 private:
  NetworkInterface interface_;
  int domain_id_;
  std::string announcement_, partition_;
  std::unique_ptr<Traffic> traffic_ = std::make_unique<Traffic>();
  Domain domain_;  // outlives participant_
  Entity participant_;
  std::optional<Entity> publisher_, subscriber_;  // in a partition
  ParticipantKey key_{};
};

}  // namespace understudy::bus
