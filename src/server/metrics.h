// What GET /metrics answers: Prometheus' text format, version 0.0.4.
#ifndef UNDERSTUDY_SERVER_METRICS_H_
#define UNDERSTUDY_SERVER_METRICS_H_

#include <string>

#include "emulator/frame.h"
#include "emulator/status.h"
#include "server/status_json.h"

namespace understudy {

inline constexpr char kMetricsType[] = "text/plain; version=0.0.4; charset=utf-8";
inline constexpr FrameParts kMetricsParts = kPartMotors | kPartBattery;

// `frame` has kMetricsParts.
std::string MetricsText(const RobotIdentity& identity, const Status& status, const Frame& frame);

}  // namespace understudy

#endif  // UNDERSTUDY_SERVER_METRICS_H_
