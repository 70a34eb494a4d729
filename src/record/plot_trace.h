// A line of a plot while a recording is read.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace understudy::record {

using TracePoints = std::vector<std::pair<double, double>>;  // s, value

// Columns of pixels of a line: of each the least and the most is drawn; *assumed*.
inline constexpr std::size_t kTraceColumns = 1200;

// `all`, of `from` to `to` [s], or of each column the least and the most, in order.
TracePoints Thinned(const TracePoints& all, double from, double to);

// No more than a few times what is drawn, however long the recording is.
class Trace {
 public:
  // Adds `value` at `at` [s] of a line from `from` to `to`, but none that no line can go through.
  void Add(double at, double value, double from, double to);
  const TracePoints& points() const { return points_; }

 private:
  static constexpr std::size_t kFull = 16 * kTraceColumns;

  TracePoints points_;
  std::size_t full_ = kFull;
};

}  // namespace understudy::record
