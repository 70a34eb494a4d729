// A queue between two threads, of slots that are made once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace understudy {

// One thread fills slots, one empties them; neither ever waits. What a slot holds (memory of
// vectors, say) is kept for its next use.
template <typename Slot>
class SpscRing {
 public:
  // `slots` of them, each a copy of `prototype`.
  explicit SpscRing(std::size_t slots, const Slot& prototype = {}) : slots_(slots, prototype) {}

  // The writer: the slot to fill next, or nullptr, counted as dropped, when all are full.
  Slot* Claim() {
    if (size() == slots_.size()) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return nullptr;
    }
    return &slots_[written_.load(std::memory_order_relaxed) % slots_.size()];
  }
  void Commit() { written_.fetch_add(1, std::memory_order_release); }

  // The reader: the oldest full slot, or nullptr.
  const Slot* Front() const {
    const std::uint64_t read = read_.load(std::memory_order_relaxed);
    if (read == written_.load(std::memory_order_acquire)) return nullptr;
    return &slots_[read % slots_.size()];
  }
  void Pop() { read_.fetch_add(1, std::memory_order_release); }

  // Either thread, and others for a rough answer.
  std::size_t size() const {
    const std::uint64_t read = read_.load(std::memory_order_acquire);
    return written_.load(std::memory_order_acquire) - read;
  }
  std::size_t capacity() const { return slots_.size(); }
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<Slot> slots_;
  alignas(64) std::atomic<std::uint64_t> written_{0};
  alignas(64) std::atomic<std::uint64_t> read_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace understudy
