// Hands the newest of something from one thread to any number of others.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace understudy::emulator {

// Its values are made once and written in place; one that somebody reads is not written. Neither
// side ever waits: there is always a value to be read, and one to be written as long as fewer than
// kSlots - 1 readings are held at a time.
template <class Value>
class Mailbox {
 public:
  static constexpr std::size_t kSlots = 8;

  // The first reading, before the first post, is `prototype`.
  explicit Mailbox(const Value& prototype = {}) : values_(kSlots, prototype) {}
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  // The writer: a value to be filled in, which holds what it held some posts ago; null where all
  // are being read. Post makes it the newest.
  Value* Claim() {
    const std::size_t newest = newest_.load();
    for (claimed_ = 0; claimed_ < kSlots; ++claimed_) {
      if (claimed_ != newest && readers_[claimed_].load() == 0) return &values_[claimed_];
    }
    return nullptr;
  }
  void Post() { newest_.store(claimed_); }

  // A value that stays as it is for as long as this lives.
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
      // The writer takes no slot that is the newest or is read. It may have taken this one before
      // it saw this reader, but then it has posted another one before.
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
