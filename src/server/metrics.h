// Formats the reply to GET /metrics: Prometheus' text format, version 0.0.4.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emulator/event_table.h"
#include "emulator/snapshot.h"
#include "emulator/status.h"
#include "server/status_json.h"

namespace understudy::server {

inline constexpr char kMetricsType[] = "text/plain; version=0.0.4; charset=utf-8";
inline constexpr emulator::SnapshotParts kMetricsParts =
    emulator::kPartMotors | emulator::kPartBattery;

// `snapshot` must have kMetricsParts; `events` has the counts by kind.
std::string MetricsText(const RobotIdentity& identity, const emulator::Status& status,
                        const emulator::Snapshot& snapshot,
                        std::span<const std::uint64_t, emulator::kEventKinds> events);

}  // namespace understudy::server
