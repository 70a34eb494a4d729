#include "bus/reader.h"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>
#include <dds/ddsi/ddsi_serdata.h>

#include "base/errors.h"
#include "bus/listener.h"
#include "bus/qos.h"

namespace understudy::bus {
namespace {

// The most samples that one call moves out of Cyclone's cache, which bounds the time of a tick, and
// the room there, so that all that arrives between two ticks is counted; *assumed*. Moving one
// takes some 0.1 µs.
constexpr int kMostGathered = 256;
constexpr std::size_t kAtOnce = 32;

ReaderOptions InCyclone(ReaderOptions options) {
  options.depth = std::max(options.depth, kMostGathered);
  return options;
}

// Returns the name of the topic's type, which is to have messages of that size.
std::string TypeOf(const char* topic, const dds_topic_descriptor& descriptor, std::size_t size) {
  if (descriptor.m_size == size) return descriptor.m_typename;
  throw BusError(std::string("topic ") + topic + ": " + descriptor.m_typename +
                 " is not the type of the reader's messages");
}

}  // namespace

struct ReaderCore::Listener {
  static void OnArrival(dds_entity_t, void* reports) {
    auto* const to = static_cast<Reports*>(reports);
    to->arrived.store(true, std::memory_order_release);
    if (to->mail != nullptr) to->mail->store(true, std::memory_order_release);
    if (to->bell != nullptr) to->bell->Ring();
  }
  static void OnLost(dds_entity_t, dds_sample_lost_status_t status, void* reports) {
    static_cast<Reports*>(reports)->lost.fetch_add(
        static_cast<std::uint64_t>(status.total_count_change), std::memory_order_relaxed);
  }
  static void OnMatch(dds_entity_t, dds_subscription_matched_status_t status, void* reports) {
    static_cast<Reports*>(reports)->writers.store(static_cast<int>(status.current_count),
                                                  std::memory_order_relaxed);
  }
  static void OnMismatch(dds_entity_t, dds_requested_incompatible_qos_status_t status,
                         void* reports) {
    static_cast<Reports*>(reports)->policy.store(status.last_policy_id, std::memory_order_relaxed);
  }

  static ListenerPtr To(Reports* reports) {
    ListenerPtr listener = MakeListener(reports);
    dds_lset_data_available(listener.get(), &OnArrival);
    dds_lset_sample_lost(listener.get(), &OnLost);
    dds_lset_subscription_matched(listener.get(), &OnMatch);
    dds_lset_requested_incompatible_qos(listener.get(), &OnMismatch);
    return listener;
  }
};

void ReaderCore::MessageDeleter::operator()(std::byte* message) const {
  dds_stream_free_sample(message, descriptor->m_ops);
  std::default_delete<std::byte[]>()(message);
}

ReaderCore::ReaderCore(const Participant& participant, const char* topic,
                       const dds_topic_descriptor& descriptor, std::size_t message_size,
                       const ReaderOptions& options)
    : name_(topic),
      type_(TypeOf(topic, descriptor, message_size)),
      undecoded_(&UndecodedOf(topic)),
      seen_undecoded_(undecoded_->all),
      before_(UndecodedByWriter(topic)),
      received_(&participant.traffic().Of(topic).received),
      most_bytes_(options.most_bytes),
      reports_(std::make_unique<Reports>(options)),
      subscriber_(participant.subscriber()),
      options_(InCyclone(options)),
      topic_(dds_create_topic(participant.handle(), &descriptor, topic, nullptr, nullptr),
             std::string("create topic ") + topic),
      reader_(Create()),
      queue_(static_cast<std::size_t>(options.depth)),
      message_(new std::byte[message_size]{}, MessageDeleter{&descriptor}) {}

Entity ReaderCore::Create() {
  Entity reader(dds_create_reader(subscriber_, topic_.handle(), ReaderQos(options_).get(),
                                  Listener::To(reports_.get()).get()),
                "read topic " + name_);
  reports_->handle.store(reader.handle(), std::memory_order_release);
  return reader;
}

void ReaderCore::Open(bool open) {
  if (open == reader_.has_value()) return;
  if (open) {
    reader_.emplace(Create());
  } else {
    reports_->handle = 0;
    reader_.reset();
    reports_->writers = 0;
  }
}

void ReaderCore::CountUndecoded() const {
  seen_undecoded_ = undecoded_->all.load(std::memory_order_relaxed);
  own_undecoded_ = 0;
  for (const auto& [writer, count] : UndecodedByWriter(name_)) {
    const auto before = before_.find(writer);
    const std::uint64_t since = count - (before == before_.end() ? 0 : before->second);
    if (since == 0) continue;
    const auto [own, is_new] = own_writers_.try_emplace(writer, false);
    if (is_new) own->second = IsMatched(writer);
    if (own->second) own_undecoded_ += since;
  }
}

bool ReaderCore::IsMatched(const std::array<std::uint8_t, 16>& writer) const {
  const std::int32_t reader = reports_->handle.load(std::memory_order_acquire);
  std::vector<dds_instance_handle_t> writers(static_cast<std::size_t>(matched_writers()));
  const int count = dds_get_matched_publications(reader, writers.data(), writers.size());
  writers.resize(std::min(writers.size(), static_cast<std::size_t>(std::max(0, count))));
  return std::ranges::any_of(writers, [&](dds_instance_handle_t one) {
    const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>
        endpoint(dds_get_matched_publication_data(reader, one), &dds_builtintopic_free_endpoint);
    return endpoint != nullptr && std::ranges::equal(endpoint->key.v, writer);
  });
}

std::string_view ReaderCore::refused_policy() const {
  switch (reports_->policy.load(std::memory_order_relaxed)) {
    case DDS_INVALID_QOS_POLICY_ID:
      return "";
    case DDS_DURABILITY_QOS_POLICY_ID:
      return "durability";
    case DDS_PRESENTATION_QOS_POLICY_ID:
      return "presentation";
    case DDS_DEADLINE_QOS_POLICY_ID:
      return "deadline";
    case DDS_LATENCYBUDGET_QOS_POLICY_ID:
      return "latency budget";
    case DDS_OWNERSHIP_QOS_POLICY_ID:
      return "ownership";
    case DDS_LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    case DDS_PARTITION_QOS_POLICY_ID:
      return "partition";
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case DDS_DESTINATIONORDER_QOS_POLICY_ID:
      return "destination order";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID:
      return "data representation";
    case DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID:
      return "type consistency";
    default:
      return "another policy";
  }
}

// An empty take locks three mutexes, the flag none. It is lowered first: what arrives meanwhile
// raises it again.
void ReaderCore::Gather() {
  if (!reports_->arrived.load(std::memory_order_relaxed) ||
      !reports_->arrived.exchange(false, std::memory_order_acquire) || !reader_) {
    return;
  }
  std::array<ddsi_serdata*, kAtOnce> taken{};
  std::array<dds_sample_info_t, kAtOnce> infos;
  for (int total = 0; total < kMostGathered;) {
    const int count =
        dds_takecdr(reader_->handle(), taken.data(), kAtOnce, infos.data(), DDS_ANY_STATE);
    for (std::size_t i = 0; std::cmp_less(i, count); ++i) {
      CdrSample sample(taken[i], infos[i].publication_handle);
      if (!infos[i].valid_data) continue;  // says only that a writer has gone
      received_->fetch_add(1, std::memory_order_relaxed);
      if (sample.bytes().size() > most_bytes_) {
        ++too_long_;
      } else {
        Push(std::move(sample));
      }
    }
    if (std::cmp_less(count, kAtOnce)) return;
    total += count;
  }
  reports_->arrived.store(true, std::memory_order_relaxed);  // more may be left
}

void ReaderCore::Push(CdrSample sample) {
  if (waiting_ == queue_.size()) {
    first_ = (first_ + 1) % queue_.size();
    --waiting_;
    ++replaced_;
  }
  queue_[(first_ + waiting_) % queue_.size()] = std::move(sample);
  ++waiting_;
}

void ReaderCore::Drop() {
  Gather();
  for (; waiting_ > 0; --waiting_) {
    queue_[first_] = CdrSample();
    first_ = (first_ + 1) % queue_.size();
  }
}

bool ReaderCore::Next(CdrSample* sample) {
  Gather();
  if (waiting_ == 0) return false;
  *sample = std::move(queue_[first_]);
  queue_[first_] = CdrSample();
  first_ = (first_ + 1) % queue_.size();
  --waiting_;
  return true;
}

// Strings and sequences reuse the room of the message before.
const void* ReaderCore::Decode(const CdrSample& sample) {
  if (!ddsi_serdata_to_sample(sample.serdata(), message_.get(), nullptr, nullptr)) return nullptr;
  return message_.get();
}

}  // namespace understudy::bus
