#include "server/report_json.h"

#include <numeric>

namespace understudy::server {
namespace {

using nlohmann::ordered_json;

ordered_json HistogramJson(const time::Histogram& histogram) {
  ordered_json buckets = ordered_json::array();
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    ordered_json bucket{{"count", histogram.counts[i]}};
    if (i < time::kHistogramBounds.size()) bucket["le"] = time::kHistogramBounds[i];
    buckets.push_back(bucket);
  }
  const auto count =
      std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0});
  const double mean = count == 0 ? 0 : histogram.sum / static_cast<double>(count);
  return {{"count", count}, {"mean", mean}, {"sum", histogram.sum}, {"buckets", buckets}};
}

}  // namespace

ordered_json TimingsJson(const emulator::Status& status) {
  return {{"time", status.time},
          {"steps", status.steps},
          {"speed", status.speed},
          {"paused", status.paused},
          {"real_time_factor", status.pace.real_time_factor},
          {"overruns", status.pace.overruns},
          {"lateness", status.pace.lateness},
          {"worst_lateness", status.pace.worst_lateness},
          {"shifts", status.pace.shifts},
          {"shifted", status.pace.shifted},
          {"tick", HistogramJson(status.ticks)},
          {"late", HistogramJson(status.pace.latenesses)}};
}

}  // namespace understudy::server
