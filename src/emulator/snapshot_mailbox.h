// Where the tick shows itself to whoever looks.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "base/bell.h"
#include "emulator/frame.h"
#include "emulator/mailbox.h"

namespace understudy::emulator {

// Observers ask for parts; the tick fills in one snapshot for all that have asked, posts it and
// wakes them. Everybody may read the newest at any time. While nobody asks, the tick reads a flag
// per observer.
class SnapshotMailbox {
 public:
  // Of one thread.
  class Observer {
   public:
    // A snapshot with these parts, and perhaps others, that is made from now on.
    void Ask(FrameParts parts) { asked_.fetch_or(parts | kAsked); }
    // Rung once what was asked for is there.
    const Bell& bell() const { return bell_; }

   private:
    friend class SnapshotMailbox;
    std::atomic<FrameParts> asked_{0};
    bool served_ = false;  // by the snapshot that is being filled in; the tick's
    Bell bell_;
  };

  static constexpr std::size_t kMostObservers = 6;
  static_assert(kMostObservers + 2 <= Mailbox<Frame>::kSlots);

  explicit SnapshotMailbox(const Frame& prototype) : mailbox_(prototype) {}

  // For as long as the mailbox lives. Any thread. Throws where there are too many.
  Observer* Join() {
    const std::size_t index = joined_.fetch_add(1);
    if (index >= kMostObservers) throw std::length_error("too many observers of the snapshot");
    return &observers_[index];
  }
  // Any thread, no longer than a moment: an observer may hold one reading.
  Mailbox<Frame>::Reading Newest() const { return mailbox_.Newest(); }

  // The tick: the snapshot to be filled in as its `parts` say, or null where none is wanted. Post
  // follows.
  Frame* Wanted() {
    const auto asks = [](const Observer& observer) {
      return observer.asked_.load(std::memory_order_relaxed) != 0;
    };
    if (std::ranges::none_of(observers_, asks)) return nullptr;
    Frame* frame = mailbox_.Claim();
    if (frame == nullptr) return nullptr;
    frame->parts = 0;
    for (Observer& observer : observers_) {
      const FrameParts parts = observer.asked_.exchange(0);
      frame->parts |= parts & ~kAsked;
      if (parts != 0) observer.served_ = true;
    }
    return frame;
  }
  void Post() {
    mailbox_.Post();
    for (Observer& observer : observers_) {
      if (std::exchange(observer.served_, false)) observer.bell_.Ring();
    }
  }

 private:
  static constexpr FrameParts kAsked = 1U << 31;  // something, if only step and time

  Mailbox<Frame> mailbox_;
  std::array<Observer, kMostObservers> observers_;
  std::atomic<std::size_t> joined_{0};
};

}  // namespace understudy::emulator
