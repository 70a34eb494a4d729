// Reads messages of one topic by polling.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bell.h"
#include "bus/cdr_sample.h"
#include "bus/cyclone_log.h"
#include "bus/participant.h"
#include "bus/topic.h"

namespace understudy::bus {

// The most samples that one Take visits.
inline constexpr int kMaxTake = 16;

inline constexpr int kKeepAll = 0;

struct ReaderOptions {
  int depth = kMaxTake;       // most samples kept until taken, newer ones replace older ones
  bool reliable = false;      // false: best effort, as a robot's readers, matches every writer
  bool foreign_only = false;  // ignores what our own participant writes
  // Longer samples are dropped unread and count as undecoded: decoding takes as long as they have
  // bytes. Of the serialized message.
  std::size_t most_bytes = 65536;
  const Bell* bell = nullptr;  // rung when something has arrived; outlives the reader
  // "Data available" flag, shared by several readers: raised when something has arrived. Outlives
  // the reader.
  std::atomic<bool>* mail = nullptr;
};

// The part of Reader that does not depend on the message type: a bounded queue of serialized
// samples. For one thread, but for what says otherwise.
class ReaderCore {
 public:
  // Throws BusError if Cyclone refuses or if `message_size` is not that of the descriptor.
  // `options.depth` is 1 or more.
  ReaderCore(const Participant& participant, const char* topic,
             const dds_topic_descriptor& descriptor, std::size_t message_size,
             const ReaderOptions& options);

  ReaderCore(ReaderCore&& other) = default;

  // Returns how many writers are matched now, including our own participant's. Any thread.
  int matched_writers() const { return reports_->writers.load(std::memory_order_relaxed); }
  // Returns whether the writer with that GUID is among them. Allocates. Any thread.
  bool IsMatched(const std::array<std::uint8_t, 16>& writer) const;

  // Returns how many samples from its writers were received and could not be decoded or were too
  // long. Allocates if there are more than before, else it only loads a counter.
  std::uint64_t undecoded() const {
    if (seen_undecoded_ != undecoded_->all.load(std::memory_order_relaxed)) CountUndecoded();
    return own_undecoded_ + too_long_;
  }
  // Returns how many samples were received and never taken: newer ones replaced them in the queue,
  // or Cyclone reported them lost.
  std::uint64_t lost() const { return replaced_ + reports_->lost.load(std::memory_order_relaxed); }
  // Closes the reader, so that nobody reads the topic, or opens it again; `open` at first. What
  // waits in the queue stays, what has not been gathered is dropped. Throws BusError if Cyclone
  // refuses; the reader is closed then.
  void Open(bool open);
  // Any thread.
  bool is_open() const { return reports_->handle.load(std::memory_order_acquire) != 0; }

  // Moves what has arrived into the queue, as Take does first.
  void Gather();
  // Drops all that has arrived and waits; it does not count as lost.
  void Drop();

  // Returns the participant of a sample's writer; nullopt if the writer has gone meanwhile.
  // Allocates.
  std::optional<ParticipantKey> ParticipantOf(WriterHandle writer) const {
    return reader_ ? bus::ParticipantOf(*reader_, writer) : std::nullopt;
  }

  const std::string& topic() const { return name_; }
  const std::string& type() const { return type_; }
  // Returns the name of the policy for which a writer was last refused, "" if none was. Any thread.
  std::string_view refused_policy() const;

 protected:
  // Takes the oldest sample; false if none waits. Never blocks; while nothing waits it only loads a
  // flag.
  bool Next(CdrSample* sample);
  // Decodes the sample. The message belongs to the reader and is valid until the next call;
  // nullptr if Cyclone cannot.
  const void* Decode(const CdrSample& sample);

 private:
  // What Cyclone's threads report.
  struct Reports {
    explicit Reports(const ReaderOptions& options) : bell(options.bell), mail(options.mail) {}

    const Bell* bell;
    std::atomic<bool>* mail;
    std::atomic<bool> arrived{false};
    std::atomic<std::uint64_t> lost{0};
    std::atomic<int> writers{0};           // that match now
    std::atomic<std::uint32_t> policy{0};  // of the last writer that did not match; 0: none
    std::atomic<std::int32_t> handle{0};   // of the reader; 0: it is closed
  };
  // Releases what Cyclone allocated for strings and sequences of a message.
  struct MessageDeleter {
    const dds_topic_descriptor* descriptor;
    void operator()(std::byte* message) const;
  };

  // Called by Cyclone's threads. Named in cmake/tsan.supp.
  struct Listener;
  Entity Create();
  void Push(CdrSample sample);
  void CountUndecoded() const;

  std::string name_, type_;
  // Cyclone reports them for the process: a reader counts those of writers that match it.
  const UndecodedSamples* undecoded_;
  mutable std::uint64_t seen_undecoded_, own_undecoded_ = 0;
  mutable std::map<UndecodedSamples::Writer, bool> own_writers_;  // whether it matched this reader
  std::map<UndecodedSamples::Writer, std::uint64_t> before_;      // of the time before this reader
  std::atomic<std::uint64_t>* received_;
  std::size_t most_bytes_;
  std::unique_ptr<Reports> reports_;  // outlives reader_
  std::int32_t subscriber_;
  ReaderOptions options_;
  Entity topic_;
  std::optional<Entity> reader_;  // nullopt while it is closed
  std::vector<CdrSample> queue_;  // a ring of `depth`
  std::size_t first_ = 0, waiting_ = 0;
  std::uint64_t replaced_ = 0, too_long_ = 0;
  std::unique_ptr<std::byte[], MessageDeleter> message_;  // the type's C struct
};

// Receives messages of one topic.
template <typename Msg>
class Reader : public ReaderCore {
 public:
  Reader(const Participant& participant, const Topic<Msg>& topic, const ReaderOptions& options = {})
      : ReaderCore(participant, topic.name, *topic.descriptor, sizeof(Msg), options) {}

  // Takes at most `max` (1..kMaxTake) waiting samples, oldest first, and calls visit(const Msg&,
  // WriterHandle) with each. The message belongs to the reader and is valid during the call.
  // Returns how many were visited. Never blocks; while nothing waits it only loads a flag.
  template <typename Visit>
  int Take(Visit&& visit, int max = kMaxTake) {
    int visited = 0;
    for (CdrSample sample; visited < std::min(max, kMaxTake) && Next(&sample);) {
      const void* const message = Decode(sample);
      if (message == nullptr) continue;
      ++visited;
      std::forward<Visit>(visit)(*static_cast<const Msg*>(message), sample.writer());
    }
    return visited;
  }
};

// Receives messages of one topic and leaves them serialized, for those who decode only a part.
template <typename Msg>
class RawReader : public ReaderCore {
 public:
  RawReader(const Participant& participant, const Topic<Msg>& topic, const ReaderOptions& options)
      : ReaderCore(participant, topic.name, *topic.descriptor, sizeof(Msg), options) {}

  using ReaderCore::Next;
};

}  // namespace understudy::bus
