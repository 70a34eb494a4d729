#include "bus/cdr_sample.h"

#include <utility>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

namespace understudy::bus {

CdrSample::CdrSample(ddsi_serdata* owned, WriterHandle writer, std::int64_t arrived)
    : serdata_(owned),
      source_time_(owned->timestamp.v > 0 ? owned->timestamp.v : arrived),
      writer_(writer) {
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

}  // namespace understudy::bus
