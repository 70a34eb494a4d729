// What GET /metrics answers: Prometheus' text format, version 0.0.4.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emulator/event_table.h"
#include "emulator/frame.h"
#include "emulator/status.h"
#include "server/status_json.h"

namespace understudy::server {

inline constexpr char kMetricsType[] = "text/plain; version=0.0.4; charset=utf-8";
inline constexpr emulator::FrameParts kMetricsParts =
    emulator::kPartMotors | emulator::kPartBattery;

// `frame` has kMetricsParts, `events` counts them by kind.
std::string MetricsText(const RobotIdentity& identity, const emulator::Status& status,
                        const emulator::Frame& frame,
                        std::span<const std::uint64_t, emulator::kEventKinds> events);

}  // namespace understudy::server
