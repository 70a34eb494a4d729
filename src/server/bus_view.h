// Shows who reads and writes which topic, what passes and what cannot.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "bus/discovery.h"
#include "bus/participant.h"
#include "server/http.h"

namespace understudy::server {

// {"at": 12.5, "topics": [{"topic": "rt/lowcmd", "sent": 0, "received": 812,
//   "endpoints": [{"who": "process 12 (python3)", "ours": false, "writes": true, "type": "...",
//                  "reliable": true, "durable": false, "exclusive": false, "deadline": false,
//                  "xcdr1": true, "partition": ""}],
//   "mismatches": [{"writer": "process 12 (python3)", "reader": "this robot", "why": "type
//   ..."}], "unserved": ""}]}
// by name. `at` is wall time [s] of a clock that does not jump, `sent` and `received` what the
// robot wrote and got since its start. Two participants are a mismatch if no writer of the one
// matches any reader of the other. `unserved` says who would serve a topic that
// others read and nobody writes, or that robots have, others write and nobody reads; else it is "".
nlohmann::ordered_json BusJson(const std::vector<bus::Endpoint>& endpoints,
                               const std::map<std::string, bus::TopicTraffic>& traffic, double at);

// For the server's thread.
class BusView {
 public:
  // `participant` must outlive it; null: there is no bus.
  explicit BusView(const bus::Participant* participant = nullptr) : participant_(participant) {}

  // Returns what discovery knows now, no older than a quarter of a second; 404 without a bus, 503
  // if Cyclone refuses.
  HttpReply Get(std::chrono::nanoseconds now = std::chrono::steady_clock::now().time_since_epoch());

 private:
  const bus::Participant* participant_;
  std::string text_;
  std::chrono::nanoseconds made_{};
};

}  // namespace understudy::server
