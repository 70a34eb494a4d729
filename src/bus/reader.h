// Readers, polled: no thread of ours.
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

// Names a matched writer within this process.
using WriterHandle = std::uint64_t;

// The most samples that one Take visits.
inline constexpr int kMaxTake = 16;

inline constexpr int kKeepAll = 0;

struct ReaderOptions {
  int depth = kMaxTake;       // samples kept until taken, the oldest goes first; or kKeepAll
  bool reliable = false;      // best effort, as the robot's, accepts every writer
  bool foreign_only = false;  // leave out what our own participant writes
};

// The part of Reader that does not know the message.
class ReaderCore {
 public:
  // Throws BusError when Cyclone refuses. `message_size` is checked against the descriptor's.
  ReaderCore(const Participant& participant, const char* topic,
             const dds_topic_descriptor& descriptor, std::size_t message_size,
             const ReaderOptions& options);

  // Writers matched now, of any participant, ours included. Does not allocate.
  int matched_writers() const;

  // Samples of its topic that came and could not be decoded.
  std::uint64_t undecoded() const { return undecoded_->load(std::memory_order_relaxed); }

  ReaderCore(ReaderCore&& other) = default;

  // Whose a taken sample is; nullopt when the writer has gone meanwhile. Allocates.
  std::optional<ParticipantKey> ParticipantOf(WriterHandle writer) const;

 protected:
  // Samples lent by Cyclone, oldest first, given back at the end of the scope.
  class Loan {
   public:
    Loan(std::int32_t reader, int max) noexcept;
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    int size() const { return size_; }
    // nullptr where Cyclone only tells that a writer has gone.
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

  // Whether anything may have come since this was last asked and answered with yes. Of what comes
  // meanwhile the next call tells. An empty take locks three mutexes; this is a load.
  bool MayHoldSamples() {
    return arrived_->load(std::memory_order_relaxed) &&
           arrived_->exchange(false, std::memory_order_acquire);
  }
  // Something may be left: the next MayHoldSamples says yes.
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

  // Takes what waits, oldest first, at most `max` (1..kMaxTake) samples, and calls
  // visit(const Msg&, WriterHandle) with each. The message is Cyclone's and is gone after the call.
  // Returns how many were visited. Never blocks, and costs next to nothing while nothing waits.
  // What `visit` throws passes through, and the samples it has not seen are lost.
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
