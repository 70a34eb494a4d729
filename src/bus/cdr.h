// Reads and writes messages as serialized bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/spsc_ring.h"
#include "bus/cdr_sample.h"
#include "bus/participant.h"
#include "bus/reader.h"
#include "bus/topic.h"

namespace understudy::bus {

// Receives everything that is written to a topic, by our own participant too, and keeps it until it
// is taken, without limit. Best effort, as a robot's readers, so that no writer waits for it.
//
// A writer of this process delivers its messages in its own thread. It shares a lock with Take,
// which holds it only while it moves up to 32 pointers.
class CdrReader {
 public:
  // Throws BusError when Cyclone refuses.
  CdrReader(const Participant& participant, const std::string& topic,
            const dds_topic_descriptor& descriptor);

  // Takes all waiting messages, oldest first, and calls visit(CdrSample) with each. Never blocks.
  template <typename Visit>
  void Take(Visit&& visit) {
    std::array<CdrSample, kAtOnce> samples;
    for (int taken = static_cast<int>(kAtOnce); taken > 0;) {
      int valid = 0;
      taken = TakeSome(&samples, &valid);
      for (int i = 0; i < valid; ++i) visit(std::move(samples[static_cast<std::size_t>(i)]));
    }
  }

  // Returns the participant of a sample's writer; nullopt if the writer has gone meanwhile.
  std::optional<ParticipantKey> ParticipantOf(WriterHandle writer) const {
    return bus::ParticipantOf(reader_, writer);
  }

 private:
  static constexpr std::size_t kAtOnce = 32;
  static constexpr std::size_t kArrivals = 1024;  // *assumed*: more than arrive between two takes

  // When samples arrived, noted by the thread that receives them.
  struct Arrival {
    std::uint64_t number;  // of the reader's samples
    std::int64_t time;     // ns since 1970
  };
  struct Arrivals {
    SpscRing<Arrival> ring{kArrivals};
    std::uint64_t count = 0;  // of all samples, also those for which there was no room
  };
  struct Listener;

  // Returns how many samples it took; sets `valid` to how many of them are messages.
  int TakeSome(std::array<CdrSample, kAtOnce>* samples, int* valid);
  // Returns when the next sample to be taken arrived.
  std::int64_t ArrivalOfNext();

  std::unique_ptr<Arrivals> arrivals_ = std::make_unique<Arrivals>();
  std::uint64_t taken_ = 0;  // samples
  Entity topic_;
  Entity reader_;
};

// Sends serialized messages, reliable and without blocking, as Writer does.
class CdrWriter {
 public:
  // Throws BusError if Cyclone refuses. `descriptor` must outlive the writer.
  CdrWriter(const Participant& participant, const std::string& topic,
            const dds_topic_descriptor& descriptor);

  // Returns how many readers are matched now.
  int matched_readers() const;

  // Sends one message, in the form of CdrSample::bytes(). Returns false, and sends nothing, if the
  // bytes are not a valid message of the type.
  bool Write(std::span<const std::byte> bytes);

 private:
  const dds_topic_descriptor& descriptor_;
  Entity topic_;
  Entity writer_;
  std::vector<char> encoded_;
  std::vector<char> message_;  // the type's C struct
};

}  // namespace understudy::bus
