// Makes the replies to GET /status and GET /timings.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "emulator/status.h"
#include "robot/randomization.h"
#include "server/event_history.h"

namespace understudy::server {

// The identity of the robot, constant during a run.
struct RobotIdentity {
  std::string robot{};    // the name of the description, as in `understudy run <robot>`
  std::string name{};     // in a world of several robots, else ""
  std::string version{};  // of this program
  int pid = 0;
  std::string log{};     // the file of its log, "" if it has none
  robot::Draws draws{};  // the drawn values of randomization
};

// Returns all fields of `status` in SI units, and of `events` the topics that nobody serves, with
// keys in a fixed order. Numbers that are not finite become null, since JSON cannot represent them.
nlohmann::ordered_json StatusJson(const RobotIdentity& identity, const emulator::Status& status,
                                  const EventHistory& events = EventHistory());

// Returns the histograms of the duration and lateness of ticks [s of wall time]. `buckets` are not
// cumulative; the last has no `le`.
nlohmann::ordered_json TimingsJson(const emulator::Status& status);

}  // namespace understudy::server
