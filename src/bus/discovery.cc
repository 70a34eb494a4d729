#include "bus/discovery.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <dds/dds.h>

namespace understudy::bus {
namespace {

constexpr std::size_t kPeersAtOnce = 16;

std::string Property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value)) return "";
  std::string text(value);
  dds_free(value);
  return text;
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
    const dds_qos_t* qos = static_cast<const dds_builtintopic_participant_t*>(sample)->qos;
    neighbour->host = Property(qos, "__Hostname");
    neighbour->process = Property(qos, "__ProcessName");
    neighbour->pid = Property(qos, "__Pid");
    neighbour->addresses = Property(qos, "__NetworkAddresses");
  }
  dds_return_loan(participants, &sample, 1);
}

constexpr std::size_t kAtOnce = 16;

// Prefix of the types of discovery's built-in topics, which our participant reads too.
constexpr std::string_view kBuiltin = "org::eclipse::cyclonedds::builtin::";

template <typename Visit>
void TakeNew(dds_entity_t reader, Visit&& visit) {
  int taken = 0;
  do {
    std::array<void*, kAtOnce> samples{};
    std::array<dds_sample_info_t, kAtOnce> infos;
    taken = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    for (std::size_t i = 0; std::cmp_less(i, taken); ++i) {
      if (infos[i].instance_state != DDS_ALIVE_INSTANCE_STATE || !infos[i].valid_data) continue;
      visit(*static_cast<const dds_builtintopic_endpoint_t*>(samples[i]));
    }
    if (taken > 0) dds_return_loan(reader, samples.data(), taken);
  } while (std::cmp_equal(taken, kAtOnce));
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
      topic_(std::move(topic)),
      publications_(dds_create_reader(participant.handle(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION,
                                      nullptr, nullptr),
                    "watch the writers of " + topic_),
      participants_(dds_create_reader(participant.handle(), DDS_BUILTIN_TOPIC_DCPSPARTICIPANT,
                                      nullptr, nullptr),
                    "watch the participants") {}

const std::vector<Neighbour>& NeighbourWatch::Poll() {
  int taken = 0;
  do {
    std::array<void*, kPeersAtOnce> samples{};
    std::array<dds_sample_info_t, kPeersAtOnce> infos;
    taken =
        dds_take(publications_.handle(), samples.data(), infos.data(), kPeersAtOnce, kPeersAtOnce);
    for (std::size_t i = 0; std::cmp_less(i, taken); ++i) {
      if (infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE && infos[i].valid_data) {
        Note(samples[i]);
      } else {
        const auto& gone = static_cast<const dds_builtintopic_endpoint_t*>(samples[i])->key.v;
        std::erase_if(neighbours_,
                      [&](const Neighbour& one) { return std::ranges::equal(one.writer, gone); });
      }
    }
    if (taken > 0) dds_return_loan(publications_.handle(), samples.data(), taken);
  } while (std::cmp_equal(taken, kPeersAtOnce));
  return neighbours_;
}

void NeighbourWatch::Note(const void* publication) {
  const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(publication);
  if (topic_ != endpoint.topic_name || std::ranges::equal(ours_, endpoint.participant_key.v))
    return;
  const auto known = [&](const Neighbour& one) {
    return std::ranges::equal(one.writer, endpoint.key.v);
  };
  if (std::ranges::any_of(neighbours_, known)) return;
  Neighbour& neighbour = neighbours_.emplace_back();
  neighbour.writer = std::to_array(endpoint.key.v);
  neighbour.participant = std::to_array(endpoint.participant_key.v);
  neighbour.type = endpoint.type_name;
  Introduce(participants_.handle(), &neighbour);
}

EndpointWatch::EndpointWatch(const Participant& participant)
    : ours_(participant.key()),
      writers_(dds_create_reader(participant.handle(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr,
                                 nullptr),
               "watch the writers"),
      readers_(dds_create_reader(participant.handle(), DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr,
                                 nullptr),
               "watch the readers") {}

std::vector<TopicOnBus> EndpointWatch::Poll() {
  std::vector<TopicOnBus> topics;
  const auto note = [&](const dds_builtintopic_endpoint_t& endpoint) {
    if (std::string_view(endpoint.type_name).starts_with(kBuiltin)) return;
    topics.push_back({.topic = endpoint.topic_name, .type = endpoint.type_name});
  };
  TakeNew(writers_.handle(), note);
  TakeNew(readers_.handle(), [&](const dds_builtintopic_endpoint_t& endpoint) {
    if (std::ranges::equal(ours_, endpoint.participant_key.v)) note(endpoint);
  });
  return topics;
}

}  // namespace understudy::bus
