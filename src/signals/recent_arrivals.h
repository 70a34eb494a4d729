// Message rate over a sliding window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "judge/margin.h"

namespace understudy::signals {

// Counts the messages of the last second, without its beginning. Times are ns
// and never go back.
class RecentArrivals {
 public:
  // Allocates nothing later if messages come at no more instants in a second than `instants`.
  explicit RecentArrivals(std::size_t instants = 1) : ring_(instants + 1) {}

  void Add(std::int64_t at, std::uint64_t messages) {
    if (!first_) first_ = at;
    if (size_ == ring_.size()) Grow();
    ring_[(oldest_ + size_) % ring_.size()] = {at, messages};
    ++size_;
    sum_ += messages;
  }
  // Returns the rate [Hz] at a time; unknown until a second after the first message.
  double RateAt(std::int64_t now) {
    while (size_ > 0 && ring_[oldest_].at <= now - kWindow) {
      sum_ -= ring_[oldest_].messages;
      oldest_ = (oldest_ + 1) % ring_.size();
      --size_;
    }
    return first_ && now - *first_ >= kWindow ? static_cast<double>(sum_) : judge::kUnknown;
  }

 private:
  static constexpr std::int64_t kWindow = 1'000'000'000;

  struct Instant {
    std::int64_t at = 0;
    std::uint64_t messages = 0;
  };

  void Grow() {
    std::vector<Instant> larger(2 * ring_.size());
    for (std::size_t i = 0; i < size_; ++i) larger[i] = ring_[(oldest_ + i) % ring_.size()];
    ring_ = std::move(larger);
    oldest_ = 0;
  }

  std::vector<Instant> ring_;  // size_ instants from oldest_ on
  std::size_t oldest_ = 0, size_ = 0;
  std::uint64_t sum_ = 0;  // of their messages
  std::optional<std::int64_t> first_;
};

}  // namespace understudy::signals
