// A wait-free queue from one thread to another, with preallocated slots.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace understudy {

// One thread fills slots, another empties them; neither ever waits. A slot keeps its memory (of
// vectors, for example) for its next use.
template <typename Slot>
class SpscRing {
 public:
  // Makes `slots` slots, each a copy of `prototype`.
  explicit SpscRing(std::size_t slots, const Slot& prototype = {}) : slots_(slots, prototype) {}

  // For the writer: returns the slot to fill next; if all are full, counts a drop and returns
  // nullptr.
  Slot* Claim() {
    if (size() == slots_.size()) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return nullptr;
    }
    return &slots_[written_.load(std::memory_order_relaxed) % slots_.size()];
  }
  void Commit() { written_.fetch_add(1, std::memory_order_release); }

  // For the reader: returns the oldest full slot, or nullptr.
  const Slot* Front() const {
    const std::uint64_t read = read_.load(std::memory_order_relaxed);
    if (read == written_.load(std::memory_order_acquire)) return nullptr;
    return &slots_[read % slots_.size()];
  }
  void Pop() { read_.fetch_add(1, std::memory_order_release); }

  // Exact for the two threads, approximate for others.
  std::size_t size() const {
    const std::uint64_t read = read_.load(std::memory_order_acquire);
    return written_.load(std::memory_order_acquire) - read;
  }
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<Slot> slots_;
  alignas(64) std::atomic<std::uint64_t> written_{0};
  alignas(64) std::atomic<std::uint64_t> read_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace understudy
