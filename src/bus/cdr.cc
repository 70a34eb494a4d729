#include "bus/cdr.h"

#include <algorithm>
#include <limits>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>
#include <dds/ddsi/ddsi_serdata.h>

#include "bus/listener.h"
#include "bus/now.h"
#include "bus/qos.h"

namespace understudy::bus {
namespace {

constexpr std::size_t kHead = 4;  // bytes at the front of a message that name its encoding

}  // namespace

// Cyclone calls it once for each sample, never twice at a time for one reader. Named in
// cmake/tsan.supp.
struct CdrReader::Listener {
  static void OnArrival(dds_entity_t, void* arrivals) {
    auto* const to = static_cast<Arrivals*>(arrivals);
    const std::uint64_t number = to->count++;
    Arrival* const arrival = to->ring.Claim();
    if (arrival == nullptr) return;
    *arrival = {.number = number, .time = Now().count()};
    to->ring.Commit();
  }
  static ListenerPtr To(Arrivals* arrivals) {
    ListenerPtr listener = MakeListener(arrivals);
    dds_lset_data_available(listener.get(), &OnArrival);
    return listener;
  }
};

CdrReader::CdrReader(const Participant& participant, const std::string& topic,
                     const dds_topic_descriptor& descriptor)
    : topic_(dds_create_topic(participant.handle(), &descriptor, topic.c_str(), nullptr, nullptr),
             "create topic " + topic),
      reader_(dds_create_reader(participant.subscriber(), topic_.handle(),
                                ReaderQos({.depth = kKeepAll}).get(),
                                Listener::To(arrivals_.get()).get()),
              "read topic " + topic) {}

// That is now, where it is not noted yet or there was no room.
std::int64_t CdrReader::ArrivalOfNext() {
  const std::uint64_t number = taken_++;
  const Arrival* arrival = arrivals_->ring.Front();
  for (; arrival != nullptr && arrival->number < number; arrival = arrivals_->ring.Front()) {
    arrivals_->ring.Pop();
  }
  if (arrival == nullptr || arrival->number != number) return Now().count();
  const std::int64_t time = arrival->time;
  arrivals_->ring.Pop();
  return time;
}

int CdrReader::TakeSome(std::array<CdrSample, kAtOnce>* samples, int* valid) {
  std::array<ddsi_serdata*, kAtOnce> taken{};
  std::array<dds_sample_info_t, kAtOnce> infos;
  const int count =
      dds_takecdr(reader_.handle(), taken.data(), kAtOnce, infos.data(), DDS_ANY_STATE);
  for (std::size_t i = 0; std::cmp_less(i, count); ++i) {
    CdrSample sample(taken[i], infos[i].publication_handle, ArrivalOfNext());
    if (infos[i].valid_data) (*samples)[static_cast<std::size_t>((*valid)++)] = std::move(sample);
  }
  return count;
}

CdrWriter::CdrWriter(const Participant& participant, const std::string& topic,
                     const dds_topic_descriptor& descriptor)
    : descriptor_(descriptor),
      topic_(dds_create_topic(participant.handle(), &descriptor, topic.c_str(), nullptr, nullptr),
             "create topic " + topic),
      writer_(
          dds_create_writer(participant.publisher(), topic_.handle(), WriterQos().get(), nullptr),
          "write topic " + topic) {}

int CdrWriter::matched_readers() const {
  return std::max(0, dds_get_matched_subscriptions(writer_.handle(), nullptr, 0));
}

bool CdrWriter::Write(std::span<const std::byte> bytes) {
  if (bytes.size() < kHead || bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
    return false;
  }
  // 00 00 and 00 01 are XCDR1, 00 06 and 00 07 XCDR2; the odd ones little-endian.
  const auto encoding = static_cast<unsigned>(bytes[1]);
  const bool is_xcdr2 = encoding == 6 || encoding == 7;
  if (bytes[0] != std::byte{0} || (encoding > 1 && !is_xcdr2)) return false;
  const std::uint32_t version = is_xcdr2 ? CDR_ENC_VERSION_2 : CDR_ENC_VERSION_1;

  const auto* begin = reinterpret_cast<const char*>(bytes.data());
  encoded_.assign(begin + kHead, begin + bytes.size());
  const auto size = static_cast<std::uint32_t>(encoded_.size());
  std::uint32_t used = 0;
  if (dds_stream_normalize_data(encoded_.data(), &used, size, encoding % 2 == 0, version,
                                descriptor_.m_ops) == nullptr) {
    return false;
  }
  message_.assign(descriptor_.m_size, '\0');
  dds_istream_t stream;
  dds_istream_init(&stream, size, encoded_.data(), version);
  dds_stream_read(&stream, message_.data(), descriptor_.m_ops);
  const bool written = dds_write(writer_.handle(), message_.data()) == DDS_RETCODE_OK;
  dds_stream_free_sample(message_.data(), descriptor_.m_ops);
  return written;
}

}  // namespace understudy::bus
