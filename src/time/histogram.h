// A histogram of durations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::time {

// Inclusive upper bounds [s] of the buckets; the last bucket has none.
inline constexpr std::array<double, 13> kHistogramBounds = {
    5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 5e-2, 2e-1};

struct Histogram {
  std::array<std::uint64_t, kHistogramBounds.size() + 1> counts{};  // per bucket, not cumulative
  double sum = 0;                                                   // s

  void Add(double seconds) {
    std::size_t bucket = 0;
    while (bucket < kHistogramBounds.size() && seconds > kHistogramBounds[bucket]) ++bucket;
    ++counts[bucket];
    sum += seconds;
  }
};

}  // namespace understudy::time
