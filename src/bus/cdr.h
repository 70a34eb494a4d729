// Readers and writers of messages that stay as they are on the wire: bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/participant.h"
#include "bus/reader.h"
#include "bus/topic.h"

struct ddsi_serdata;

namespace understudy::bus {

// One message as bytes, shared with Cyclone, not copied.
class CdrSample {
 public:
  CdrSample() = default;
  CdrSample(ddsi_serdata* owned, WriterHandle writer);
  CdrSample(CdrSample&& other) noexcept { *this = std::move(other); }
  CdrSample& operator=(CdrSample&& other) noexcept;
  ~CdrSample();

  // Four bytes that name the encoding (00 01: little-endian XCDR1), then the message.
  std::span<const std::byte> bytes() const { return bytes_; }
  // When its writer wrote it, by that machine's clock; ns since 1970.
  std::int64_t source_time() const { return source_time_; }
  WriterHandle writer() const { return writer_; }

 private:
  ddsi_serdata* serdata_ = nullptr;
  std::span<const std::byte> bytes_;
  std::int64_t source_time_ = 0;
  WriterHandle writer_ = 0;
};

// Receives all that anybody writes to a topic, our own participant included, and keeps it until it
// is taken, however much that is. Best effort, so that it hears what a robot hears and no writer
// waits for it.
//
// A writer of this process hands its messages over in its own thread. It shares a lock with Take,
// which is held for as long as it takes to move 32 pointers.
class CdrReader {
 public:
  // Throws BusError when Cyclone refuses.
  CdrReader(const Participant& participant, const std::string& topic,
            const dds_topic_descriptor& descriptor);

  // Takes all that waits, oldest first, and calls visit(CdrSample) with each. Never blocks.
  template <typename Visit>
  void Take(Visit&& visit) {
    std::array<CdrSample, kAtOnce> samples;
    for (int taken = static_cast<int>(kAtOnce); taken > 0;) {
      int valid = 0;
      taken = TakeSome(&samples, &valid);
      for (int i = 0; i < valid; ++i) visit(std::move(samples[static_cast<std::size_t>(i)]));
    }
  }

  // Whose a taken sample is; nullopt when the writer has gone meanwhile.
  std::optional<ParticipantKey> ParticipantOf(WriterHandle writer) const;

 private:
  static constexpr std::size_t kAtOnce = 32;

  // How many were taken, and how many of those are messages.
  int TakeSome(std::array<CdrSample, kAtOnce>* samples, int* valid);

  Entity topic_;
  Entity reader_;
};

// Sends as a Writer does: reliable, and nobody holds it up.
class CdrWriter {
 public:
  // Throws BusError when Cyclone refuses. `descriptor` must outlive the writer.
  CdrWriter(const Participant& participant, const std::string& topic,
            const dds_topic_descriptor& descriptor);

  // Readers matched now.
  int matched_readers() const;

  // One message as CdrSample::bytes() has it. The bytes may come from anywhere: those that are no
  // message of the type are not sent, and the answer is false.
  bool Write(std::span<const std::byte> bytes);

 private:
  const dds_topic_descriptor& descriptor_;
  Entity topic_;
  Entity writer_;
  std::vector<char> encoded_;
  std::vector<char> message_;  // the type's C struct
};

}  // namespace understudy::bus
