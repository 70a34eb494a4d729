// One serialized message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

struct ddsi_serdata;

namespace understudy::bus {

// The handle of a matched writer, valid in this process.
using WriterHandle = std::uint64_t;

// Shares Cyclone's buffer, in which Cyclone has checked the bytes against the topic's type and put
// numbers into this machine's byte order.
class CdrSample {
 public:
  CdrSample() = default;
  // `arrived`: source_time() of a message without a timestamp.
  CdrSample(ddsi_serdata* owned, WriterHandle writer, std::int64_t arrived = 0);
  CdrSample(CdrSample&& other) noexcept { *this = std::move(other); }
  CdrSample& operator=(CdrSample&& other) noexcept;
  ~CdrSample();

  // The four bytes of the encoding (00 01: little-endian XCDR1), then the message. Empty if default
  // constructed or moved from.
  std::span<const std::byte> bytes() const { return bytes_; }
  // The source timestamp: when it was written, by the writer's clock; ns since 1970. Of a writer
  // that sends none, as RustDDS's, when it arrived, or 0 if that is not known.
  std::int64_t source_time() const { return source_time_; }
  WriterHandle writer() const { return writer_; }
  // Null if bytes() is empty.
  const ddsi_serdata* serdata() const { return serdata_; }

 private:
  ddsi_serdata* serdata_ = nullptr;
  std::span<const std::byte> bytes_;
  std::int64_t source_time_ = 0;
  WriterHandle writer_ = 0;
};

}  // namespace understudy::bus
