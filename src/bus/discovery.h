// Watches DDS discovery: which topics there are, and who else writes a topic.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "bus/participant.h"

namespace understudy::bus {

// A writer of another participant. A property that its participant does not announce is "": Cyclone
// announces all of them, other DDS implementations and the vendor's robots may not.
struct Neighbour {
  ParticipantKey writer{};       // GUID of the writer itself
  ParticipantKey participant{};  // GUID of the participant it belongs to
  std::string type{};            // "unitree_go::msg::dds_::LowState_"
  std::string host{};
  std::string process{};
  std::string pid{};
  std::string addresses{};  // comma separated
};

// Returns one line for a log: "process 123 (name) on host (addresses)", without what is unknown.
std::string Describe(const Neighbour& neighbour);

// Watches for writers of one topic in other participants, of any message type.
class NeighbourWatch {
 public:
  // Throws BusError if Cyclone refuses.
  NeighbourWatch(const Participant& participant, std::string topic);

  // Returns the current foreign writers in the order of their discovery, which takes some 0.1 s on
  // a quiet network; empty before. Never blocks. While nothing changes a call takes about 0.1 µs
  // and does not allocate. The list is valid until the next call.
  const std::vector<Neighbour>& Poll();

 private:
  void Note(const void* publication);

  ParticipantKey ours_;
  std::string topic_;
  Entity publications_;  // reader of DCPSPublication
  Entity participants_;  // reader of DCPSParticipant
  std::vector<Neighbour> neighbours_;
};

// A topic and its type, named as on the wire.
struct TopicOnBus {
  std::string topic;  // "rt/lowstate"
  std::string type;   // "unitree_go::msg::dds_::LowState_"

  friend bool operator==(const TopicOnBus&, const TopicOnBus&) = default;
  friend bool operator<(const TopicOnBus& a, const TopicOnBus& b) {
    return std::tie(a.topic, a.type) < std::tie(b.topic, b.type);
  }
};

// Watches for topics.
class EndpointWatch {
 public:
  // Throws BusError when Cyclone refuses.
  explicit EndpointWatch(const Participant& participant);

  // Returns the topics of the endpoints discovered since the last call: writers of all participants
  // and readers of our own. A topic may appear several times. Never blocks.
  std::vector<TopicOnBus> Poll();

 private:
  ParticipantKey ours_;
  Entity writers_;  // reader of DCPSPublication
  Entity readers_;  // reader of DCPSSubscription
};

}  // namespace understudy::bus
