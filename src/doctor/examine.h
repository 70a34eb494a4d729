// Collects the evidence: reads the machine, listens on the bus, sends to the peer.
#pragma once

#include <cstdint>
#include <string>

#include "doctor/measurements.h"

namespace understudy::doctor {

// Measures for `question.seconds`, and with a peer up to 2 s before to find it. Writes to no topic
// of the vendor's; without a peer it sends only DDS discovery and, on the interface, 20 datagrams a
// second to the group of discovery. What cannot be seen is left out of the evidence. Ends early on
// a stop signal.
Measurements Examine(const Question& question);

struct EchoOptions {
  std::string interface = "lo";
  int domain = 0;
  std::string name{};  // by which --peer finds it
};

// Answers examinations of other machines until a stop signal. Calls `ready` once it does. Returns
// how many messages it answered. Throws BusError.
std::uint64_t Echo(const EchoOptions& options, void (*ready)(const EchoOptions& options));

}  // namespace understudy::doctor
