#include "bus/reader.h"

#include <algorithm>
#include <memory>
#include <string>

#include <dds/dds.h>

#include "base/errors.h"
#include "bus/cyclone_log.h"
#include "bus/qos.h"

namespace understudy::bus {
namespace {

using ListenerPtr = std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)>;

// Called by a thread of Cyclone. Named in cmake/tsan.supp.
void NoteArrival(dds_entity_t, void* flag) {
  static_cast<std::atomic<bool>*>(flag)->store(true, std::memory_order_release);
}

ListenerPtr SetOnArrival(std::atomic<bool>* arrived) {
  ListenerPtr listener(dds_create_listener(arrived), &dds_delete_listener);
  dds_lset_data_available(listener.get(), &NoteArrival);
  return listener;
}

}  // namespace

ReaderCore::ReaderCore(const Participant& participant, const char* topic,
                       const dds_topic_descriptor& descriptor, std::size_t message_size,
                       const ReaderOptions& options)
    : undecoded_(&UndecodedSamples(topic)),
      arrived_(std::make_unique<std::atomic<bool>>(false)),
      topic_(dds_create_topic(participant.handle(), &descriptor, topic, nullptr, nullptr),
             std::string("create topic ") + topic),
      reader_(dds_create_reader(participant.handle(), topic_.handle(), ReaderQos(options).get(),
                                SetOnArrival(arrived_.get()).get()),
              std::string("read topic ") + topic) {
  if (descriptor.m_size != message_size) {
    throw BusError(std::string("topic ") + topic + ": " + descriptor.m_typename +
                   " is not the type of the reader's messages");
  }
}

int ReaderCore::matched_writers() const {
  return std::max(0, dds_get_matched_publications(handle(), nullptr, 0));
}

std::optional<ParticipantKey> ReaderCore::ParticipantOf(WriterHandle writer) const {
  const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>
      endpoint(dds_get_matched_publication_data(handle(), writer), &dds_builtintopic_free_endpoint);
  if (endpoint == nullptr) return std::nullopt;
  return std::to_array(endpoint->participant_key.v);
}

ReaderCore::Loan::Loan(std::int32_t reader, int max) noexcept : reader_(reader) {
  std::array<dds_sample_info_t, kMaxTake> infos;
  const int bounded = std::clamp(max, 1, kMaxTake);
  // A null first pointer asks for a loan. Cyclone keeps the memory from one loan to the next.
  size_ =
      std::max(0, dds_take(reader, samples_.data(), infos.data(), static_cast<std::size_t>(bounded),
                           static_cast<std::uint32_t>(bounded)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(size_); ++i) {
    valid_[i] = infos[i].valid_data;
    writers_[i] = infos[i].publication_handle;
  }
}

ReaderCore::Loan::~Loan() {
  if (size_ > 0) dds_return_loan(reader_, samples_.data(), size_);
}

}  // namespace understudy::bus
