// What happened to a robot, seen from one status to the next.
#ifndef UNDERSTUDY_RECORD_EVENT_LOG_H_
#define UNDERSTUDY_RECORD_EVENT_LOG_H_

#include <array>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "emulator/status.h"
#include "record/truth.h"

namespace understudy::record {

// Refusals, overruns and lost messages come in crowds: each cause is told once in this simulated
// time [s], with its count; *assumed*.
inline constexpr double kEventEvery = 0.1;

class EventLog {
 public:
  // `names` of what a script does, in order.
  explicit EventLog(std::vector<std::string> script) : script_(std::move(script)) {}

  // What is new in `status`, which is of `step`. Statuses come in order of time.
  std::vector<Event> Compare(const emulator::Status& status, std::int64_t step);
  // What was held back until now.
  std::vector<Event> Rest(std::int64_t step) { return Crowds(last_, step, true); }

 private:
  struct Crowd {
    std::uint64_t told = 0;
    double at = -kEventEvery;  // s
  };

  std::vector<Event> Crowds(const emulator::Status& status, std::int64_t step, bool all);
  // Whether a count that has grown is to be told now; `fresh` becomes by how much.
  static bool Tell(Crowd* crowd, std::uint64_t count, double time, bool all, std::uint64_t* fresh);

  std::vector<std::string> script_;
  emulator::Status last_;
  bool first_ = true;
  std::array<std::array<Crowd, robot::kRefusals>, robot::kMostCommandTopics> refused_{};
  Crowd overruns_, failures_;
};

}  // namespace understudy::record

#endif  // UNDERSTUDY_RECORD_EVENT_LOG_H_
