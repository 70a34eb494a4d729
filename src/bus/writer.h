// Writes messages of one topic.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "bus/participant.h"
#include "bus/topic.h"

namespace understudy::bus {

// The part of Writer that does not depend on the message type.
class WriterCore {
 public:
  // Throws BusError if Cyclone refuses or if `message_size` is not that of the descriptor.
  WriterCore(const Participant& participant, const char* topic,
             const dds_topic_descriptor& descriptor, std::size_t message_size);

  WriterCore(WriterCore&& other) = default;

  // Returns how many readers are matched now, including our own participant's. Does not allocate.
  int matched_readers() const;

  // Returns whether a reader is matched, so that unread messages need not be made. Only loads a
  // flag, which Cyclone's thread sets slightly later than matched_readers() changes.
  bool has_readers() const { return readers_->load(std::memory_order_relaxed) > 0; }

  // Returns whether a reader of that participant is matched, so that it receives what is written
  // now. Allocates.
  bool ReachesParticipant(const ParticipantKey& key) const;

  // Sends what Writer::Pack made; returns false if Cyclone refuses it.
  bool WritePacked(const std::vector<char>& packed) noexcept;

 protected:
  bool WriteMessage(const void* message) noexcept;
  void PackMessage(const void* message, std::vector<char>* packed) const;

 private:
  const dds_topic_descriptor* descriptor_;
  std::unique_ptr<std::atomic<std::uint32_t>>
      readers_;  // set by Cyclone's threads; outlives writer_
  std::atomic<std::uint64_t>* sent_;
  Entity topic_;
  Entity writer_;
};

// Sends messages of one topic.
//
// The writer is reliable, but a reader that hangs or is slow does not block it: the history is
// KEEP_LAST 1, for which Cyclone 0.10.2 never makes a writer wait (the next message replaces the
// unacknowledged one), and the blocking time is 0. Such a reader loses messages; the others do not.
template <typename Msg>
class Writer : public WriterCore {
 public:
  Writer(const Participant& participant, const Topic<Msg>& topic)
      : WriterCore(participant, topic.name, *topic.descriptor, sizeof(Msg)) {}

  // Sends one message to the readers matched now. If Cyclone refuses it, returns false. It takes as
  // long without a reader: check has_readers() first. Only Cyclone allocates.
  bool Write(const Msg& message) noexcept { return WriteMessage(&message); }
  // Copies the message, with all that it points to, so that it can be sent later.
  void Pack(const Msg& message, std::vector<char>* packed) const { PackMessage(&message, packed); }
};

}  // namespace understudy::bus
