// Reads this machine: plain values, without judging them. Needs no rights.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "doctor/measurements.h"

namespace understudy::doctor {

// Returns nullopt if there is no interface of that name.
std::optional<LinkState> ReadLink(const std::string& interface);
// Returns those of all interfaces that are up.
std::vector<Address> ReadAddresses();
// Returns the first of the interface's own, in the host's byte order; 0 for none.
std::uint32_t OwnAddress(const std::vector<Address>& addresses, const std::string& interface);
// Returns the interface to which the kernel's main table sends what goes to the group of discovery
// by a socket that names none; "" if none does.
std::optional<std::string> ReadMulticastRoute();
// The same of any address, in the host's byte order, by a text such as /proc/net/route.
std::string RouteTo(std::uint32_t address, std::string_view table);

// Returns the counts so far.
std::optional<DropCounts> ReadDropCounts(const std::string& interface);
// Reads "RcvbufErrors" of the lines "Udp:" of /proc/net/snmp; nullopt if it is not there.
std::optional<std::uint64_t> FullBuffers(std::string_view snmp);

// Returns the bytes of buffer that a UDP socket has after it asked for `wanted` if it had less, as
// Cyclone does and measures: as getsockopt tells, which is twice what was granted (socket(7)).
std::optional<int> GrantedBuffer(bool receive, int wanted);

// Asks for them as a robot's loop does, in a thread of its own, and gives them back.
Rights TryRights();

std::vector<std::string> ReadGovernors();
std::optional<double> ReadLoad();
std::string ReadClockSource();
std::optional<ClockSync> ReadClockSync();

// Follows CLOCK_REALTIME against CLOCK_MONOTONIC.
class ClockWatch {
 public:
  // Takes a reading of both, s, the system's clock between `before` and `after`, two readings of
  // the monotonic one. Those that took longer than a tenth of kClockStep are left out.
  void Note(double before, double system, double after);
  // Reads them.
  void Note();

  const ClockCourse& course() const { return course_; }

 private:
  ClockCourse course_;
  std::optional<double> offset_;  // of the last reading, s
};

}  // namespace understudy::doctor
