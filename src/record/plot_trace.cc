#include "record/plot_trace.h"

#include <algorithm>
#include <cmath>

namespace understudy::record {

TracePoints Thinned(const TracePoints& all, double from, double to) {
  if (all.size() <= 2 * kTraceColumns) return all;
  TracePoints thin;
  const double width = (to - from) / static_cast<double>(kTraceColumns);
  for (std::size_t begin = 0; begin < all.size();) {
    const double column = std::floor((all[begin].first - from) / width);
    std::size_t end = begin, least = begin, most = begin;
    for (; end < all.size() && std::floor((all[end].first - from) / width) == column; ++end) {
      if (all[end].second < all[least].second) least = end;
      if (all[end].second > all[most].second) most = end;
    }
    thin.push_back(all[std::min(least, most)]);
    if (least != most) thin.push_back(all[std::max(least, most)]);
    begin = std::max(end, begin + 1);
  }
  return thin;
}

void Trace::Add(double at, double value, double from, double to) {
  if (!std::isfinite(value)) return;
  points_.emplace_back(at, value);
  if (points_.size() < full_) return;
  points_ = Thinned(points_, from, to);
  full_ = std::max(kFull, 2 * points_.size());  // where times go back and forth it stays long
}

}  // namespace understudy::record
