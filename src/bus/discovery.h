// Watches DDS discovery: which topics there are, and who else writes a topic.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "bus/participant.h"
#include "bus/reader.h"

struct dds_topic_descriptor;

namespace understudy::bus {

// A writer of another participant. Texts are cut to 128 bytes, their control characters replaced,
// for they come from anywhere and go into logs. A property that its participant does not announce
// is "": Cyclone announces all of them, other DDS implementations and the vendor's robots may not.
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

// Watches for writers of one topic in other participants, of any message type, in the partition of
// ours.
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
  std::string partitions_;
  std::string topic_;
  Entity publications_;  // reader of DCPSPublication
  Entity participants_;  // reader of DCPSParticipant
  std::vector<Neighbour> neighbours_;
};

// A participant that announces itself.
struct Announcement {
  ParticipantKey participant{};
  std::string text{};  // as its maker was given it, 256 bytes at most; anybody may write anything
  Neighbour who{};     // without writer and type
};

// Watches for announcements of other participants.
class AnnouncementWatch {
 public:
  // Throws BusError if Cyclone refuses.
  explicit AnnouncementWatch(const Participant& participant);

  // Returns the announcements of the participants that are there now, 64 at most, in the order of
  // their discovery. Never blocks. The list is valid until the next call.
  const std::vector<Announcement>& Poll();

 private:
  ParticipantKey ours_;
  Entity participants_;  // reader of DCPSParticipant
  std::vector<Announcement> announcements_;
};

// A writer of a topic that our reader of the topic does not match.
struct Mismatch {
  std::string topic{};
  std::string why{};  // "type X", "partition \"a\"", "ownership"
  Neighbour writer{};
};

// Returns what an event has room for: "TOPIC by process 12 (NAME): WHY".
std::string Describe(const Mismatch& mismatch);

// Watches for writers of other participants from which our readers receive nothing, since their
// type or quality of service is another. If ours is in a partition, only writers in it count: the
// others are those of its neighbours.
class MismatchWatch {
 public:
  // `readers` must outlive the watch, which any thread may poll. Throws BusError if Cyclone
  // refuses.
  MismatchWatch(const Participant& participant, std::vector<const ReaderCore*> readers);

  // Returns the new ones, each once, 32 in all, since the network is untrusted. A writer has 0.5 s
  // to be matched after it was discovered and its reader was opened. Never blocks.
  std::vector<Mismatch> Poll(std::chrono::nanoseconds now);

 private:
  struct Suspect {
    const ReaderCore* reader;
    Mismatch found;
    std::chrono::nanoseconds since;
  };

  void Suspicious(const void* publication, std::chrono::nanoseconds now);

  ParticipantKey ours_;
  std::string partitions_;
  std::vector<const ReaderCore*> readers_;
  Entity publications_;  // reader of DCPSPublication
  Entity participants_;  // reader of DCPSParticipant
  std::vector<Suspect> suspects_;
  std::size_t told_ = 0;
};

// A reader or writer, and of its quality of service what decides whether it is matched.
struct Endpoint {
  std::string topic{};
  bool ours = false;    // of the participant that looks
  bool writes = false;  // else it reads
  bool reliable = false;
  bool keeps_for_late = false;  // durability is more than VOLATILE
  bool exclusive = false;       // ownership
  bool has_deadline = false;
  bool xcdr1 = true;  // is among its data representations
  // A hash of its type's minimal definition, in which names of members count, as XTypes has it; ""
  // where it tells none that is compared (foreign_types.h), as ours do here: see DefinitionOf.
  std::string definition{};
  std::string partitions{};  // quoted; "" is the one that everybody is in by default
  Neighbour who{};           // `writer` is the endpoint's GUID, also of a reader's
};

// Returns Endpoint::definition of a type; "" if it was compiled without.
std::string DefinitionOf(const dds_topic_descriptor& type);

// Returns why nothing passes from that writer to that reader of the same topic, as far as they tell
// of themselves: "type X, not Y", or the policy that keeps them apart; "" if something does. Types
// of one name differ in their definition only if both tell it.
std::string WhyNotMatched(const Endpoint& writer, const Endpoint& reader);

enum class SurveyOf : std::uint8_t { kOthers, kAll };

// Watches for everything that participants read and write, but for discovery's own topics.
class EndpointSurvey {
 public:
  // Throws BusError if Cyclone refuses.
  explicit EndpointSurvey(const Participant& participant, SurveyOf whose = SurveyOf::kOthers);

  // Takes note of what has come and gone. Never blocks.
  void Poll();
  // As of the last Poll, each in the order of discovery: 1024 endpoints and 256 participants at
  // most, of which the latter have neither `writer` nor `type`.
  const std::vector<Endpoint>& endpoints() const { return endpoints_; }
  const std::vector<Neighbour>& participants() const { return others_; }

 private:
  void Note(const void* endpoint, bool there, bool writes);

  ParticipantKey ours_;
  SurveyOf whose_;
  Entity writers_;       // reader of DCPSPublication
  Entity readers_;       // reader of DCPSSubscription
  Entity participants_;  // reader of DCPSParticipant
  std::vector<Endpoint> endpoints_;
  std::vector<Neighbour> others_;
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
