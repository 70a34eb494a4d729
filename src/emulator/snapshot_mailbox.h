// Hands one snapshot per request from the tick to its observers.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "base/bell.h"
#include "emulator/mailbox.h"
#include "emulator/snapshot.h"

namespace understudy::emulator {

// Observers ask for parts; the tick fills in one snapshot for all that have asked, posts it and
// wakes them. The newest can be read at any time. While nobody asks, the tick only reads one flag
// per observer.
class SnapshotMailbox {
 public:
  // One reader. Used by one thread.
  class Observer {
   public:
    // Requests a snapshot with at least these parts, made after this call.
    void Ask(SnapshotParts parts) { asked_.fetch_or(parts | kAsked); }
    // Rings once the requested snapshot has been posted.
    const Bell& bell() const { return bell_; }

   private:
    friend class SnapshotMailbox;
    std::atomic<SnapshotParts> asked_{0};
    bool served_ = false;  // by the claimed snapshot; used by the tick only
    Bell bell_;
  };

  static constexpr std::size_t kMostObservers = 6;
  static_assert(kMostObservers + 2 <= Mailbox<Snapshot>::kSlots);

  explicit SnapshotMailbox(const Snapshot& prototype) : mailbox_(prototype) {}

  // Returns an observer that lives as long as the mailbox. Any thread. Throws std::length_error if
  // there are more than kMostObservers.
  Observer* Join() {
    const std::size_t index = joined_.fetch_add(1);
    if (index >= kMostObservers) throw std::length_error("too many observers of the snapshot");
    return &observers_[index];
  }
  // Returns the newest snapshot, for reading. Any thread. An observer may hold one reading at a
  // time, and only briefly.
  Mailbox<Snapshot>::Reading Newest() const { return mailbox_.Newest(); }

  // For the tick: returns the snapshot to fill in with its `parts`, or null if none is requested.
  // Call Post afterwards.
  Snapshot* Wanted() {
    const auto asks = [](const Observer& observer) {
      return observer.asked_.load(std::memory_order_relaxed) != 0;
    };
    if (std::ranges::none_of(observers_, asks)) return nullptr;
    Snapshot* snapshot = mailbox_.Claim();
    if (snapshot == nullptr) return nullptr;
    snapshot->parts = 0;
    for (Observer& observer : observers_) {
      const SnapshotParts parts = observer.asked_.exchange(0);
      snapshot->parts |= parts & ~kAsked;
      if (parts != 0) observer.served_ = true;
    }
    return snapshot;
  }
  void Post() {
    mailbox_.Post();
    for (Observer& observer : observers_) {
      if (std::exchange(observer.served_, false)) observer.bell_.Ring();
    }
  }

 private:
  static constexpr SnapshotParts kAsked = 1U << 31;  // something, if only step and time

  Mailbox<Snapshot> mailbox_;
  std::array<Observer, kMostObservers> observers_;
  std::atomic<std::size_t> joined_{0};
};

}  // namespace understudy::emulator
