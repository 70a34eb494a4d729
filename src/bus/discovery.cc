#include "bus/discovery.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/ddsi_typelib.h>
#include <dds/ddsrt/heap.h>

#include "base/printed.h"
#include "bus/foreign_types.h"

namespace understudy::bus {
namespace {

constexpr std::size_t kPeersAtOnce = 16;

constexpr std::size_t kMostAnnouncements = 64;     // *assumed*, as the figures below
constexpr std::size_t kLongestAnnouncement = 256;  // bytes
constexpr std::size_t kLongestText = 128;          // bytes
constexpr std::size_t kMostSuspects = 64, kMostTold = 32;
constexpr std::size_t kMostEndpoints = 1024, kMostParticipants = 256;
constexpr std::chrono::milliseconds kPatience(500);  // several times the duration of discovery

// Reads one of Cyclone's own topics.
Entity Watch(const Participant& participant, dds_entity_t topic, const std::string& what) {
  return {dds_create_reader(participant.handle(), topic, nullptr, nullptr), "watch the " + what};
}

// What a stranger has announced, as a short text.
std::string Shown(const char* text) {
  return Printable({text, std::min(std::strlen(text), kLongestText)});
}

std::string Property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value)) return "";
  std::string text = Shown(value);
  dds_free(value);
  return text;
}

void Introduce(const dds_qos_t* qos, Neighbour* neighbour) {
  neighbour->host = Property(qos, "__Hostname");
  neighbour->process = Property(qos, "__ProcessName");
  neighbour->pid = Property(qos, "__Pid");
  neighbour->addresses = Property(qos, "__NetworkAddresses");
}

// Adds the properties that the neighbour's participant announces.
void Introduce(dds_entity_t participants, Neighbour* neighbour) {
  dds_builtintopic_participant_t key{};
  std::ranges::copy(neighbour->participant, key.key.v);
  const dds_instance_handle_t instance = dds_lookup_instance(participants, &key);
  if (instance == DDS_HANDLE_NIL) return;
  void* sample = nullptr;
  dds_sample_info_t info{};
  if (dds_read_instance(participants, &sample, &info, 1, 1, instance) != 1) return;
  if (info.valid_data) {
    Introduce(static_cast<const dds_builtintopic_participant_t*>(sample)->qos, neighbour);
  }
  dds_return_loan(participants, &sample, 1);
}

// Prefix of the types of discovery's built-in topics, which our participant reads too.
constexpr std::string_view kBuiltin = "org::eclipse::cyclonedds::builtin::";

// Calls visit(sample, whether it is there) for what a reader of a built-in topic has new. Of what
// has gone only the key is set.
template <typename Visit>
void ForEachChange(dds_entity_t reader, Visit&& visit) {
  int taken = 0;
  do {
    std::array<void*, kPeersAtOnce> samples{};
    std::array<dds_sample_info_t, kPeersAtOnce> infos;
    taken = dds_take(reader, samples.data(), infos.data(), kPeersAtOnce, kPeersAtOnce);
    for (std::size_t i = 0; std::cmp_less(i, taken); ++i) {
      visit(samples[i], infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE && infos[i].valid_data);
    }
    if (taken > 0) dds_return_loan(reader, samples.data(), taken);
  } while (std::cmp_equal(taken, kPeersAtOnce));
}

std::string Quoted(const std::string& partition) {
  return partition.empty() ? "" : "\"" + partition + "\"";
}

// The partitions of a writer, quoted; "" if it is in the one that everybody is in by default.
std::string Partitions(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!dds_qget_partition(qos, &count, &names)) return "";
  std::string text;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string name = Shown(names[i]);
    if (!name.empty()) text += (text.empty() ? "\"" : ", \"") + name + "\"";
    dds_free(names[i]);
  }
  dds_free(names);
  return text;
}

// Why our readers, which have `type` and `ours` as Partitions has it, do not match that writer, as
// far as it tells; else "".
std::string WhyNot(const dds_builtintopic_endpoint_t& writer, const std::string& type,
                   const std::string& ours) {
  if (type != writer.type_name) {
    return "type " + Shown(writer.type_name);
  }
  const std::string partitions = Partitions(writer.qos);
  return partitions == ours ? "" : "partition " + partitions;
}

}  // namespace

std::string Describe(const Neighbour& neighbour) {
  std::string text = neighbour.pid.empty() ? "a participant" : "process " + neighbour.pid;
  if (!neighbour.process.empty()) text += " (" + neighbour.process + ")";
  if (!neighbour.host.empty()) text += " on " + neighbour.host;
  if (!neighbour.addresses.empty()) text += " (" + neighbour.addresses + ")";
  return text;
}

NeighbourWatch::NeighbourWatch(const Participant& participant, std::string topic)
    : ours_(participant.key()),
      partitions_(Quoted(participant.partition())),
      topic_(std::move(topic)),
      publications_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, "writers of " + topic_)),
      participants_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, "participants")) {}

const std::vector<Neighbour>& NeighbourWatch::Poll() {
  ForEachChange(publications_.handle(), [&](const void* sample, bool there) {
    if (there) return Note(sample);
    const auto& gone = static_cast<const dds_builtintopic_endpoint_t*>(sample)->key.v;
    std::erase_if(neighbours_,
                  [&](const Neighbour& one) { return std::ranges::equal(one.writer, gone); });
  });
  return neighbours_;
}

void NeighbourWatch::Note(const void* publication) {
  const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(publication);
  if (topic_ != endpoint.topic_name || std::ranges::equal(ours_, endpoint.participant_key.v) ||
      Partitions(endpoint.qos) != partitions_) {
    return;
  }
  const auto known = [&](const Neighbour& one) {
    return std::ranges::equal(one.writer, endpoint.key.v);
  };
  if (std::ranges::any_of(neighbours_, known)) return;
  Neighbour& neighbour = neighbours_.emplace_back();
  neighbour.writer = std::to_array(endpoint.key.v);
  neighbour.participant = std::to_array(endpoint.participant_key.v);
  neighbour.type = Shown(endpoint.type_name);
  Introduce(participants_.handle(), &neighbour);
}

AnnouncementWatch::AnnouncementWatch(const Participant& participant)
    : ours_(participant.key()),
      participants_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, "participants")) {}

const std::vector<Announcement>& AnnouncementWatch::Poll() {
  ForEachChange(participants_.handle(), [&](const void* sample, bool there) {
    const auto& participant = *static_cast<const dds_builtintopic_participant_t*>(sample);
    std::erase_if(announcements_, [&](const Announcement& one) {
      return std::ranges::equal(one.participant, participant.key.v);
    });
    if (!there || std::ranges::equal(ours_, participant.key.v)) return;
    void* bytes = nullptr;
    std::size_t size = 0;
    if (!dds_qget_userdata(participant.qos, &bytes, &size) || bytes == nullptr) return;
    if (announcements_.size() < kMostAnnouncements) {
      Announcement& one = announcements_.emplace_back();
      one.participant = one.who.participant = std::to_array(participant.key.v);
      one.text.assign(static_cast<const char*>(bytes), std::min(size, kLongestAnnouncement));
      Introduce(participant.qos, &one.who);
    }
    dds_free(bytes);
  });
  return announcements_;
}

std::string Describe(const Mismatch& mismatch) {
  constexpr std::size_t kRoom = 32;  // so that what follows fits in a line
  const Neighbour short_name{.process = mismatch.writer.process.substr(0, kRoom),
                             .pid = mismatch.writer.pid};
  return mismatch.topic + " by " + Describe(short_name) + ": " + mismatch.why;
}

MismatchWatch::MismatchWatch(const Participant& participant, std::vector<const ReaderCore*> readers)
    : ours_(participant.key()),
      partitions_(Quoted(participant.partition())),
      readers_(std::move(readers)),
      publications_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, "writers")),
      participants_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, "participants")) {}

std::vector<Mismatch> MismatchWatch::Poll(std::chrono::nanoseconds now) {
  ForEachChange(publications_.handle(), [&](const void* sample, bool there) {
    if (there) return Suspicious(sample, now);
    const auto& gone = static_cast<const dds_builtintopic_endpoint_t*>(sample)->key.v;
    std::erase_if(suspects_, [&](const Suspect& one) {
      return std::ranges::equal(one.found.writer.writer, gone);
    });
  });
  std::vector<Mismatch> told;
  std::erase_if(suspects_, [&](Suspect& suspect) {
    if (now < suspect.since + kPatience) return false;
    if (suspect.reader->IsMatched(suspect.found.writer.writer) || told_ >= kMostTold) return true;
    if (!suspect.reader->is_open()) {
      suspect.since = now;
      return false;
    }
    ++told_;
    std::string& why = suspect.found.why;
    if (why.empty()) why = suspect.reader->refused_policy();
    if (why.empty()) why = "another definition of " + suspect.reader->type();
    told.push_back(std::move(suspect.found));
    return true;
  });
  return told;
}

void MismatchWatch::Suspicious(const void* publication, std::chrono::nanoseconds now) {
  const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(publication);
  const auto reader = std::ranges::find_if(
      readers_, [&](const ReaderCore* one) { return one->topic() == endpoint.topic_name; });
  if (reader == readers_.end() || std::ranges::equal(ours_, endpoint.participant_key.v)) return;
  if (!partitions_.empty() && Partitions(endpoint.qos) != partitions_) return;
  const bool known = std::ranges::any_of(suspects_, [&](const Suspect& one) {
    return std::ranges::equal(one.found.writer.writer, endpoint.key.v);
  });
  if (known || suspects_.size() >= kMostSuspects) return;
  Suspect& suspect = suspects_.emplace_back(
      Suspect{.reader = *reader, .found = {.topic = endpoint.topic_name}, .since = now});
  Neighbour& writer = suspect.found.writer;
  writer.writer = std::to_array(endpoint.key.v);
  writer.participant = std::to_array(endpoint.participant_key.v);
  writer.type = Shown(endpoint.type_name);
  Introduce(participants_.handle(), &writer);
  suspect.found.why = WhyNot(endpoint, (*reader)->type(), partitions_);
}

namespace {

bool SpeaksXcdr1(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  dds_data_representation_id_t* values = nullptr;
  if (!dds_qget_data_representation(qos, &count, &values) || count == 0) return true;
  const bool found = std::count(values, values + count, DDS_DATA_REPRESENTATION_XCDR1) > 0;
  dds_free(values);
  return found;
}

std::string DefinitionOf(const dds_builtintopic_endpoint_t& endpoint) {
  if (!std::equal(kCyclone.begin(), kCyclone.end(), std::begin(endpoint.key.v))) return "";
  const dds_typeinfo_t* info = nullptr;
  // Only reads it. What it gives belongs to the endpoint.
  auto* asked = const_cast<dds_builtintopic_endpoint_t*>(&endpoint);
  if (dds_builtintopic_get_endpoint_type_info(asked, &info) != DDS_RETCODE_OK || info == nullptr) {
    return "";
  }
  ddsi_typeid_str text{};
  return ddsi_make_typeid_str(&text, ddsi_typeinfo_minimal_typeid(info));
}

void ReadQos(const dds_qos_t* qos, Endpoint* endpoint) {
  dds_reliability_kind_t reliability{};
  dds_duration_t duration = 0;
  dds_durability_kind_t durability{};
  dds_ownership_kind_t ownership{};
  endpoint->reliable =
      dds_qget_reliability(qos, &reliability, &duration) && reliability == DDS_RELIABILITY_RELIABLE;
  endpoint->keeps_for_late =
      dds_qget_durability(qos, &durability) && durability != DDS_DURABILITY_VOLATILE;
  endpoint->exclusive = dds_qget_ownership(qos, &ownership) && ownership == DDS_OWNERSHIP_EXCLUSIVE;
  endpoint->has_deadline = dds_qget_deadline(qos, &duration) && duration != DDS_INFINITY;
  endpoint->xcdr1 = SpeaksXcdr1(qos);
  endpoint->partitions = Partitions(qos);
}

}  // namespace

std::string DefinitionOf(const dds_topic_descriptor& type) {
  if ((type.m_flagset & DDS_TOPIC_XTYPES_METADATA) == 0) return "";
  const ddsi_sertype_cdr_data serialized{.sz = type.type_information.sz,
                                         .data = type.type_information.data};
  ddsi_typeinfo_t* const info = ddsi_typeinfo_deser(&serialized);
  if (info == nullptr) return "";
  ddsi_typeid_str text{};
  std::string definition = ddsi_make_typeid_str(&text, ddsi_typeinfo_minimal_typeid(info));
  ddsi_typeinfo_fini(info);
  ddsrt_free(info);
  return definition;
}

std::string WhyNotMatched(const Endpoint& writer, const Endpoint& reader) {
  if (writer.who.type != reader.who.type) {
    return "type " + writer.who.type + ", not " + reader.who.type;
  }
  if (!writer.definition.empty() && !reader.definition.empty() &&
      writer.definition != reader.definition) {
    return "each has another definition of " + writer.who.type;
  }
  if (writer.partitions != reader.partitions) {
    const auto name = [](const Endpoint& one) {
      return one.partitions.empty() ? std::string("none") : one.partitions;
    };
    return "partition: " + name(writer) + ", not " + name(reader);
  }
  if (writer.exclusive != reader.exclusive) return "ownership: one of them is exclusive";
  if (reader.reliable && !writer.reliable) {
    return "reliability: the reader is reliable, the writer best effort";
  }
  if (reader.keeps_for_late && !writer.keeps_for_late) {
    return "durability: the reader wants what was sent before it came, the writer is volatile";
  }
  if (reader.has_deadline && !writer.has_deadline) {
    return "deadline: the reader has one, the writer none";
  }
  if (writer.xcdr1 && !reader.xcdr1) return "data representation: the reader takes no XCDR1";
  return "";
}

EndpointSurvey::EndpointSurvey(const Participant& participant, SurveyOf whose)
    : ours_(participant.key()),
      whose_(whose),
      writers_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, "writers")),
      readers_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, "readers")),
      participants_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, "participants")) {}

void EndpointSurvey::Poll() {
  ForEachChange(participants_.handle(), [&](const void* sample, bool there) {
    const auto& one = *static_cast<const dds_builtintopic_participant_t*>(sample);
    std::erase_if(others_, [&](const Neighbour& other) {
      return std::ranges::equal(other.participant, one.key.v);
    });
    if (!there || std::ranges::equal(ours_, one.key.v) || others_.size() >= kMostParticipants) {
      return;
    }
    Neighbour& other = others_.emplace_back();
    other.participant = std::to_array(one.key.v);
    Introduce(one.qos, &other);
  });
  ForEachChange(writers_.handle(),
                [&](const void* sample, bool there) { Note(sample, there, true); });
  ForEachChange(readers_.handle(),
                [&](const void* sample, bool there) { Note(sample, there, false); });
}

void EndpointSurvey::Note(const void* endpoint, bool there, bool writes) {
  const auto& one = *static_cast<const dds_builtintopic_endpoint_t*>(endpoint);
  std::erase_if(endpoints_, [&](const Endpoint& known) {
    return std::ranges::equal(known.who.writer, one.key.v);
  });
  const bool ours = std::ranges::equal(ours_, one.participant_key.v);
  if (!there || (ours && whose_ == SurveyOf::kOthers) || endpoints_.size() >= kMostEndpoints ||
      std::string_view(one.type_name).starts_with(kBuiltin)) {
    return;
  }
  Endpoint& added = endpoints_.emplace_back();
  added.topic = Shown(one.topic_name);
  added.ours = ours;
  added.writes = writes;
  const auto whose = std::ranges::find_if(others_, [&](const Neighbour& other) {
    return std::ranges::equal(other.participant, one.participant_key.v);
  });
  if (whose != others_.end()) added.who = *whose;
  added.who.writer = std::to_array(one.key.v);
  added.who.participant = std::to_array(one.participant_key.v);
  added.who.type = Shown(one.type_name);
  added.definition = DefinitionOf(one);
  ReadQos(one.qos, &added);
}

EndpointWatch::EndpointWatch(const Participant& participant)
    : ours_(participant.key()),
      writers_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, "writers")),
      readers_(Watch(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, "readers")) {}

std::vector<TopicOnBus> EndpointWatch::Poll() {
  std::vector<TopicOnBus> topics;
  const auto note = [&](const void* sample, bool there, bool of_others) {
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
    if (!there || std::string_view(endpoint.type_name).starts_with(kBuiltin)) return;
    if (!of_others && !std::ranges::equal(ours_, endpoint.participant_key.v)) return;
    topics.push_back({.topic = Shown(endpoint.topic_name), .type = Shown(endpoint.type_name)});
  };
  ForEachChange(writers_.handle(),
                [&](const void* sample, bool there) { note(sample, there, true); });
  ForEachChange(readers_.handle(),
                [&](const void* sample, bool there) { note(sample, there, false); });
  return topics;
}

}  // namespace understudy::bus
