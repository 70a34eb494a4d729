// Formats the reply to GET /metrics: Prometheus' text format, version 0.0.4.
#pragma once

#include <string>

#include "emulator/snapshot.h"
#include "emulator/status.h"
#include "server/event_history.h"
#include "server/status_json.h"

namespace understudy::server {

inline constexpr char kMetricsType[] = "text/plain; version=0.0.4; charset=utf-8";
inline constexpr emulator::SnapshotParts kMetricsParts =
    emulator::kPartMotors | emulator::kPartBattery;

// `snapshot` must have kMetricsParts.
std::string MetricsText(const RobotIdentity& identity, const emulator::Status& status,
                        const emulator::Snapshot& snapshot, const EventHistory& events);

}  // namespace understudy::server
