// What GET /metrics answers: Prometheus' text format, version 0.0.4.
#ifndef UNDERSTUDY_CONTROL_METRICS_H_
#define UNDERSTUDY_CONTROL_METRICS_H_

#include <string>

#include "control/frame.h"
#include "control/status.h"
#include "control/status_json.h"

namespace understudy {

inline constexpr char kMetricsType[] = "text/plain; version=0.0.4; charset=utf-8";
inline constexpr FrameParts kMetricsParts = kPartMotors | kPartBattery;

// `frame` has kMetricsParts.
std::string MetricsText(const RobotIdentity& identity, const Status& status, const Frame& frame);

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_METRICS_H_
