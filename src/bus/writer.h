// Writers.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "bus/participant.h"
#include "bus/topic.h"

namespace understudy::bus {

// The part of Writer that does not know the message.
class WriterCore {
 public:
  // Throws BusError when Cyclone refuses. `message_size` is checked against the descriptor's.
  WriterCore(const Participant& participant, const char* topic,
             const dds_topic_descriptor& descriptor, std::size_t message_size);

  WriterCore(WriterCore&& other) = default;

  // Readers matched now, of any participant, ours included. Does not allocate.
  int matched_readers() const;

  // Whether there is one: what nobody reads need not be made. A load; may trail matched_readers()
  // by the moment that Cyclone's thread takes to tell.
  bool has_readers() const { return readers_->load(std::memory_order_relaxed) > 0; }

  // Whether a reader of that participant is matched, so that what is written now reaches it.
  // Allocates: for services, not for the tick.
  bool ReachesParticipant(const ParticipantKey& key) const;

  // Messages that Cyclone did not take, since start.
  std::uint64_t failures() const { return failures_; }

 protected:
  bool WriteMessage(const void* message) noexcept;

 private:
  std::unique_ptr<std::atomic<std::uint32_t>>
      readers_;  // set by Cyclone's threads; outlives writer_
  Entity topic_;
  Entity writer_;
  std::uint64_t failures_ = 0;
};

// Sends messages of one topic.
//
// Reliable, yet a reader that hangs or is slow does not hold us up: the history is KEEP_LAST 1, for
// which Cyclone 0.10.2 never makes a writer wait (the next message replaces the one not yet
// acknowledged), and the time that a write may block is 0. Such a reader loses messages; the others
// get all of them.
template <typename Msg>
class Writer : public WriterCore {
 public:
  Writer(const Participant& participant, const Topic<Msg>& topic)
      : WriterCore(participant, topic.name, *topic.descriptor, sizeof(Msg)) {}

  // Sends one message to the readers matched now. False, and counted in failures(), when Cyclone
  // refuses it. Without a reader it costs as much: ask has_readers() first. Allocates in Cyclone's
  // C, not here.
  bool Write(const Msg& message) noexcept { return WriteMessage(&message); }
};

}  // namespace understudy::bus
