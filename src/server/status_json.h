// What GET /status and GET /timings answer.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "emulator/status.h"
#include "robot/randomization.h"

namespace understudy::server {

// Who answers: the same for the whole run.
struct RobotIdentity {
  std::string robot{};    // the description's name, as in `understudy run <robot>`
  std::string version{};  // of this program
  int pid = 0;
  robot::Draws draws{};  // what the run left to chance
};

// Every field of `status` in SI units, keys in a fixed order. A number that is not finite becomes
// null, for JSON has no word for it.
nlohmann::ordered_json StatusJson(const RobotIdentity& identity, const emulator::Status& status);

// How long ticks took and how late they began, in s of wall time. `buckets` of a histogram are not
// added up; the last has no `le`.
nlohmann::ordered_json TimingsJson(const emulator::Status& status);

}  // namespace understudy::server
