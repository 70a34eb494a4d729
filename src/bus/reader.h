// Reads messages of one topic by polling.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "bus/participant.h"
#include "bus/topic.h"

namespace understudy::bus {

// The handle of a matched writer, valid in this process.
using WriterHandle = std::uint64_t;

// The most samples that one Take visits.
inline constexpr int kMaxTake = 16;

inline constexpr int kKeepAll = 0;

struct ReaderOptions {
  int depth =
      kMaxTake;  // most samples kept until taken, newer ones replace older ones; or kKeepAll
  bool reliable = false;      // false: best effort, as a robot's readers, matches every writer
  bool foreign_only = false;  // ignores what our own participant writes
};

// The part of Reader that does not depend on the message type.
class ReaderCore {
 public:
  // Throws BusError if Cyclone refuses or if `message_size` is not that of the descriptor.
  ReaderCore(const Participant& participant, const char* topic,
             const dds_topic_descriptor& descriptor, std::size_t message_size,
             const ReaderOptions& options);

  // Returns how many writers are matched now, including our own participant's. Does not allocate.
  int matched_writers() const;

  // Returns how many samples of the topic were received and could not be decoded.
  std::uint64_t undecoded() const { return undecoded_->load(std::memory_order_relaxed); }

  ReaderCore(ReaderCore&& other) = default;

  // Returns the participant of a sample's writer; nullopt if the writer has gone meanwhile.
  // Allocates.
  std::optional<ParticipantKey> ParticipantOf(WriterHandle writer) const;

 protected:
  // Samples on loan from Cyclone, oldest first. The destructor returns them.
  class Loan {
   public:
    Loan(std::int32_t reader, int max) noexcept;
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    int size() const { return size_; }
    // Returns nullptr if the sample only reports that a writer has gone.
    const void* sample(int i) const {
      return valid_[static_cast<std::size_t>(i)] ? samples_[static_cast<std::size_t>(i)] : nullptr;
    }
    WriterHandle writer(int i) const { return writers_[static_cast<std::size_t>(i)]; }

   private:
    std::int32_t reader_;
    int size_ = 0;
    std::array<void*, kMaxTake> samples_{};
    std::array<bool, kMaxTake> valid_{};
    std::array<WriterHandle, kMaxTake> writers_{};
  };

  std::int32_t handle() const { return reader_.handle(); }

  // Returns whether samples may have arrived since it last returned true. It only loads a flag,
  // whereas an empty take locks three mutexes.
  bool MayHoldSamples() {
    return arrived_->load(std::memory_order_relaxed) &&
           arrived_->exchange(false, std::memory_order_acquire);
  }
  // Samples may be left: makes the next MayHoldSamples return true.
  void LeaveSamples() { arrived_->store(true, std::memory_order_relaxed); }

 private:
  const std::atomic<std::uint64_t>* undecoded_;
  std::unique_ptr<std::atomic<bool>> arrived_;  // set by Cyclone's threads; outlives reader_
  Entity topic_;
  Entity reader_;
};

// Receives messages of one topic.
template <typename Msg>
class Reader : public ReaderCore {
 public:
  Reader(const Participant& participant, const Topic<Msg>& topic, const ReaderOptions& options = {})
      : ReaderCore(participant, topic.name, *topic.descriptor, sizeof(Msg), options) {}

  // Takes at most `max` (1..kMaxTake) waiting samples, oldest first, and calls visit(const Msg&,
  // WriterHandle) with each. The message belongs to Cyclone and is valid during the call. Returns
  // how many were visited. Never blocks; while nothing waits it only loads a flag. An exception of
  // `visit` passes through, and the remaining samples are lost.
  template <typename Visit>
  int Take(Visit&& visit, int max = kMaxTake) {
    if (!MayHoldSamples()) return 0;
    int visited = 0;
    int lent = 0;
    do {
      const Loan loan(handle(), max);
      lent = loan.size();
      if (lent > 0) LeaveSamples();
      for (int i = 0; i < lent; ++i) {
        if (loan.sample(i) == nullptr) continue;
        std::forward<Visit>(visit)(*static_cast<const Msg*>(loan.sample(i)), loan.writer(i));
        ++visited;
      }
    } while (lent > 0 && visited == 0);
    return visited;
  }
};

}  // namespace understudy::bus
