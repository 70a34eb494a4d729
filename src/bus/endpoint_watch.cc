#include "bus/endpoint_watch.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <dds/dds.h>

namespace understudy::bus {
namespace {

constexpr std::size_t kAtOnce = 16;

// Types of the topics that discovery itself consists of; those are among our own readers.
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
