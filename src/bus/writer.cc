#include "bus/writer.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>

#include "base/errors.h"
#include "bus/listener.h"
#include "bus/qos.h"

namespace understudy::bus {
namespace {

using Readers = std::atomic<std::uint32_t>;

// Called by a thread of Cyclone. Named in cmake/tsan.supp.
void NoteMatch(dds_entity_t, dds_publication_matched_status_t status, void* count) {
  static_cast<Readers*>(count)->store(status.current_count, std::memory_order_relaxed);
}

ListenerPtr CountOnMatch(Readers* readers) {
  ListenerPtr listener = MakeListener(readers);
  dds_lset_publication_matched(listener.get(), &NoteMatch);
  return listener;
}

}  // namespace

WriterCore::WriterCore(const Participant& participant, const char* topic,
                       const dds_topic_descriptor& descriptor, std::size_t message_size)
    : descriptor_(&descriptor),
      readers_(std::make_unique<Readers>(0)),
      sent_(&participant.traffic().Of(topic).sent),
      topic_(dds_create_topic(participant.handle(), &descriptor, topic, nullptr, nullptr),
             std::string("create topic ") + topic),
      writer_(dds_create_writer(participant.publisher(), topic_.handle(), WriterQos().get(),
                                CountOnMatch(readers_.get()).get()),
              std::string("write topic ") + topic) {
  if (descriptor.m_size != message_size) {
    throw BusError(std::string("topic ") + topic + ": " + descriptor.m_typename +
                   " is not the type of the writer's messages");
  }
  // Our topics have no key, hence one instance. Registering it sends nothing. Without it Cyclone
  // creates the instance for each message and wakes a thread to delete it.
  const std::vector<std::byte> any_message(message_size);
  dds_instance_handle_t instance = DDS_HANDLE_NIL;
  dds_register_instance(writer_.handle(), &instance, any_message.data());
}

int WriterCore::matched_readers() const {
  return std::max(0, dds_get_matched_subscriptions(writer_.handle(), nullptr, 0));
}

bool WriterCore::ReachesParticipant(const ParticipantKey& key) const {
  std::vector<dds_instance_handle_t> readers(static_cast<std::size_t>(matched_readers()));
  const int count = dds_get_matched_subscriptions(writer_.handle(), readers.data(), readers.size());
  // The number of matched readers may have grown since.
  readers.resize(std::min(readers.size(), static_cast<std::size_t>(std::max(0, count))));
  return std::ranges::any_of(readers, [&](dds_instance_handle_t reader) {
    const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>
        endpoint(dds_get_matched_subscription_data(writer_.handle(), reader),
                 &dds_builtintopic_free_endpoint);
    return endpoint != nullptr && std::ranges::equal(endpoint->participant_key.v, key);
  });
}

bool WriterCore::WriteMessage(const void* message) noexcept {
  if (dds_write(writer_.handle(), message) != DDS_RETCODE_OK) return false;
  sent_->fetch_add(1, std::memory_order_relaxed);
  return true;
}

void WriterCore::PackMessage(const void* message, std::vector<char>* packed) const {
  dds_ostream_t stream;
  dds_ostream_init(&stream, 0, CDR_ENC_VERSION_1);
  dds_stream_write(&stream, static_cast<const char*>(message), descriptor_->m_ops);
  const auto* const begin = reinterpret_cast<const char*>(stream.m_buffer);
  packed->assign(begin, begin + stream.m_index);
  dds_ostream_fini(&stream);
}

bool WriterCore::WritePacked(const std::vector<char>& packed) noexcept {
  const std::unique_ptr<char[]> message(new (std::nothrow) char[descriptor_->m_size]{});
  if (!message) return false;
  dds_istream_t stream;
  dds_istream_init(&stream, static_cast<std::uint32_t>(packed.size()), packed.data(),
                   CDR_ENC_VERSION_1);
  dds_stream_read(&stream, message.get(), descriptor_->m_ops);
  const bool written = WriteMessage(message.get());
  dds_stream_free_sample(message.get(), descriptor_->m_ops);
  return written;
}

}  // namespace understudy::bus
