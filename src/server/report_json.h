// What GET /timings answers.
#pragma once

#include <nlohmann/json.hpp>

#include "emulator/status.h"

namespace understudy::server {

// How long ticks took and how late they began, in s of wall time. `buckets` of a histogram are not
// added up; the last has no `le`.
nlohmann::ordered_json TimingsJson(const emulator::Status& status);

}  // namespace understudy::server
