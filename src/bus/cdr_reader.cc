#include "bus/cdr_reader.h"

#include <memory>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include "bus/qos.h"

namespace understudy::bus {

CdrSample::CdrSample(ddsi_serdata* owned, WriterHandle writer)
    : serdata_(owned), source_time_(owned->timestamp.v), writer_(writer) {
  ddsrt_iovec_t bytes{};
  ddsi_serdata_to_ser_ref(owned, 0, ddsi_serdata_size(owned), &bytes);
  bytes_ = {static_cast<const std::byte*>(bytes.iov_base), bytes.iov_len};
}

CdrSample& CdrSample::operator=(CdrSample&& other) noexcept {
  std::swap(serdata_, other.serdata_);
  std::swap(bytes_, other.bytes_);
  std::swap(source_time_, other.source_time_);
  std::swap(writer_, other.writer_);
  return *this;
}

CdrSample::~CdrSample() {
  if (serdata_ == nullptr) return;
  const ddsrt_iovec_t bytes{const_cast<std::byte*>(bytes_.data()), bytes_.size()};
  ddsi_serdata_to_ser_unref(serdata_, &bytes);
  ddsi_serdata_unref(serdata_);
}

CdrReader::CdrReader(const Participant& participant, const std::string& topic,
                     const dds_topic_descriptor& descriptor)
    : topic_(dds_create_topic(participant.handle(), &descriptor, topic.c_str(), nullptr, nullptr),
             "create topic " + topic),
      reader_(dds_create_reader(participant.handle(), topic_.handle(),
                                ReaderQos({.depth = kKeepAll}).get(), nullptr),
              "read topic " + topic) {}

std::optional<ParticipantKey> CdrReader::ParticipantOf(WriterHandle writer) const {
  const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>
      endpoint(dds_get_matched_publication_data(reader_.handle(), writer),
               &dds_builtintopic_free_endpoint);
  if (endpoint == nullptr) return std::nullopt;
  return std::to_array(endpoint->participant_key.v);
}

int CdrReader::TakeSome(std::array<CdrSample, kAtOnce>* samples, int* valid) {
  std::array<ddsi_serdata*, kAtOnce> taken{};
  std::array<dds_sample_info_t, kAtOnce> infos;
  const int count =
      dds_takecdr(reader_.handle(), taken.data(), kAtOnce, infos.data(), DDS_ANY_STATE);
  for (std::size_t i = 0; std::cmp_less(i, count); ++i) {
    CdrSample sample(taken[i], infos[i].publication_handle);
    if (infos[i].valid_data) (*samples)[static_cast<std::size_t>((*valid)++)] = std::move(sample);
  }
  return count;
}

}  // namespace understudy::bus
