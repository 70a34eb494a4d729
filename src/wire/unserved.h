// Finds topics that a program reads or writes and that nobody serves.
#pragma once

#include <chrono>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/discovery.h"

namespace understudy::wire {

struct Unserved {
  std::string topic{};
  bool reads = false;    // else the program writes it
  bus::Neighbour who{};  // one of those who do
};

// Returns the topics of others that nobody serves, in the order of `endpoints`, each once: those
// that are read and that nobody writes, if they are named as a robot's (rt/...) or would be with
// rt/ before them; and those of commands to robots (WhoServes) that are written and that nobody
// reads. What robots themselves read and publish is none of them.
std::vector<Unserved> UnservedIn(std::span<const bus::Endpoint> endpoints);

// Watches for them.
class UnservedWatch {
 public:
  // Throws BusError if Cyclone refuses.
  explicit UnservedWatch(const bus::Participant& participant)
      : survey_(participant, bus::SurveyOf::kAll) {}

  // Returns those that are new, each once, 32 in all. One has 3 s of wall time to be served. Never
  // blocks; looks four times a second.
  std::vector<Unserved> Poll(std::chrono::nanoseconds now);

 private:
  struct Waiting {
    std::pair<std::string, bool> what;  // topic, reads
    std::chrono::nanoseconds since;
  };

  bus::EndpointSurvey survey_;
  std::chrono::nanoseconds looked_{};
  std::vector<Waiting> waiting_;
  std::set<std::pair<std::string, bool>> told_;
};

}  // namespace understudy::wire
