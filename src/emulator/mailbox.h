// Passes the newest value from one thread to any number of others.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace understudy::emulator {

// Values are allocated once and written in place, never while one is read. Neither side waits:
// there is always a value to read, and one to write as long as fewer than kSlots - 1 readings are
// held.
template <class Value>
class Mailbox {
 public:
  static constexpr std::size_t kSlots = 8;

  // Readers get `prototype` until the first post.
  explicit Mailbox(const Value& prototype = {}) : values_(kSlots, prototype) {}
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  // For the writer: returns a value to fill in, which still has old content, or null if all are
  // being read. Post makes it the newest.
  Value* Claim() {
    const std::size_t newest = newest_.load();
    for (claimed_ = 0; claimed_ < kSlots; ++claimed_) {
      if (claimed_ != newest && readers_[claimed_].load() == 0) return &values_[claimed_];
    }
    return nullptr;
  }
  void Post() { newest_.store(claimed_); }

  // A value that does not change while this object exists.
  class Reading {
   public:
    Reading(const Value* value, std::atomic<int>* readers) : value_(value), readers_(readers) {}
    Reading(Reading&& other) noexcept
        : value_(other.value_), readers_(std::exchange(other.readers_, nullptr)) {}
    Reading& operator=(Reading&&) = delete;
    ~Reading() {
      if (readers_ != nullptr) readers_->fetch_sub(1);
    }

    const Value& operator*() const { return *value_; }
    const Value* operator->() const { return value_; }

   private:
    const Value* value_;
    std::atomic<int>* readers_;
  };

  // Any thread.
  Reading Newest() const {
    while (true) {
      const std::size_t slot = newest_.load();
      readers_[slot].fetch_add(1);
      // The writer uses no slot that is the newest or has readers. If it claimed this one before it
      // saw this reader, then it has since posted another one, and newest_ has changed.
      if (newest_.load() == slot) return {&values_[slot], &readers_[slot]};
      readers_[slot].fetch_sub(1);
    }
  }

 private:
  std::vector<Value> values_;
  mutable std::array<std::atomic<int>, kSlots> readers_{};
  std::atomic<std::size_t> newest_{0};
  std::size_t claimed_ = 0;
};

}  // namespace understudy::emulator
