// What topics there are on the bus.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "bus/participant.h"

namespace understudy::bus {

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
