// What GET /timings answers.
#ifndef UNDERSTUDY_SERVER_REPORT_JSON_H_
#define UNDERSTUDY_SERVER_REPORT_JSON_H_

#include <nlohmann/json.hpp>

#include "emulator/status.h"

namespace understudy::server {

// How long ticks took and how late they began, in s of wall time. `buckets` of a histogram are not
// added up; the last has no `le`.
nlohmann::ordered_json TimingsJson(const emulator::Status& status);

}  // namespace understudy::server

#endif  // UNDERSTUDY_SERVER_REPORT_JSON_H_
