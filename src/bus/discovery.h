// What DDS discovery tells: topics, and who else writes what only one robot may write.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "bus/participant.h"

namespace understudy::bus {

// A foreign writer. Of its participant's properties, those it does not tell are "": Cyclone's tell
// all of them, other DDS implementations and the vendor's robots may not.
struct Neighbour {
  ParticipantKey writer{};       // GUID of the writer itself
  ParticipantKey participant{};  // GUID of the participant it belongs to
  std::string type{};            // "unitree_go::msg::dds_::LowState_"
  std::string host{};
  std::string process{};
  std::string pid{};
  std::string addresses{};  // comma separated
};

// One line for a log: "process 123 (name) on host (addresses)", as far as known.
std::string Describe(const Neighbour& neighbour);

// Watches DDS discovery for writers of one topic that are not of our own participant, whatever
// their message type.
class NeighbourWatch {
 public:
  // Throws BusError when Cyclone refuses.
  NeighbourWatch(const Participant& participant, std::string topic);

  // The foreign writers there are now, in the order in which they were discovered; empty until
  // discovery has heard of one, which takes some 0.1 s on a quiet network. Never blocks. While
  // nothing changes a call costs about 0.1 µs and does not allocate. The list is valid until the
  // next call.
  const std::vector<Neighbour>& Poll();

 private:
  void Note(const void* publication);

  ParticipantKey ours_;
  std::string topic_;
  Entity publications_;  // reader of DCPSPublication
  Entity participants_;  // reader of DCPSParticipant
  std::vector<Neighbour> neighbours_;
};

// A topic under one type. Names are as on the wire.
struct TopicOnBus {
  std::string topic;  // "rt/lowstate"
  std::string type;   // "unitree_go::msg::dds_::LowState_"

  friend bool operator==(const TopicOnBus&, const TopicOnBus&) = default;
  friend bool operator<(const TopicOnBus& a, const TopicOnBus& b) {
    return std::tie(a.topic, a.type) < std::tie(b.topic, b.type);
  }
};

// Follows DDS discovery.
class EndpointWatch {
 public:
  // Throws BusError when Cyclone refuses.
  explicit EndpointWatch(const Participant& participant);

  // Of the writers of everybody and the readers of our own participant that have come since the
  // last call, the topics; one may come several times. Never blocks.
  std::vector<TopicOnBus> Poll();

 private:
  ParticipantKey ours_;
  Entity writers_;  // reader of DCPSPublication
  Entity readers_;  // reader of DCPSSubscription
};

}  // namespace understudy::bus
