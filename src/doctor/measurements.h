// What was seen of this machine, its network and the others on it: plain values, which the checks
// judge (checks.h). An empty optional was not seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/discovery.h"

namespace understudy::doctor {

// What is asked.
struct Question {
  std::string interface = "lo";
  int domain = 0;
  double seconds = 3;           // how long to measure, wall time
  std::string peer{};           // host, IPv4 address or name of an echo; "" for none
  bool hg = false;              // the round trip has the sizes of hg messages, else of go
  std::optional<int> robots{};  // how many are to speak; nullopt: none or one
};

// An IPv4 address of this machine, in the host's byte order.
struct Address {
  std::string interface;
  std::uint32_t address = 0;
  std::uint32_t mask = 0;
};

// The counters of an interface since it was made, and those of UDP in this network.
struct DropCounts {
  std::uint64_t interface_errors = 0;   // damaged, sent or received
  std::uint64_t interface_dropped = 0;  // thrown away by the kernel or the card
  std::uint64_t buffer_full = 0;        // UDP: found no room in a socket's receive buffer
};

struct LinkState {
  bool up = false;
  bool running = false;  // has a carrier: a cable, and something that is on at its other end
  bool multicast = false;
  bool loopback = false;
};

// Datagrams of the probe (probe.h).
struct DatagramCount {
  int sent = 0;
  int returned = 0;
  int error = 0;  // the last errno of sending or, from ICMP, of arriving; 0 for none
};

// Durations, s.
struct Spread {
  std::size_t count = 0;
  double p50 = 0;
  double p99 = 0;
  double worst = 0;
};

// Returns that of the values, by the nearest rank; zeros for none.
Spread SpreadOf(std::vector<double> values);

// What the kernel gives to a robot's loop (time/realtime.h).
struct Rights {
  bool fifo = false;
  bool locked = false;
  std::uint64_t priority_limit = 0;  // RLIMIT_RTPRIO
  std::uint64_t memory_limit = 0;    // RLIMIT_MEMLOCK, bytes
};

// The system's clock, CLOCK_REALTIME, against CLOCK_MONOTONIC.
struct ClockCourse {
  int steps = 0;       // jumps of more than kClockStep
  double largest = 0;  // s, the farthest jump; positive is forward
};
// *Assumed*: far above what NTP's slewing (0.5 ms a second at most, adjtimex(2)) does between two
// readings, and below a period of LowState.
inline constexpr double kClockStep = 1e-3;

struct ClockSync {
  bool synchronised = false;  // STA_UNSYNC is not set: a daemon of NTP or PTP keeps it
  double error = 0;           // s, the kernel's bound for it
};

// A participant that writes rt/lowstate.
struct StateWriter {
  std::string who;
  bool speaks = false;
};

// rt/lowstate as it arrived, of all robots.
struct States {
  std::size_t count = 0;
  double rate = 0;           // Hz
  double longest_pause = 0;  // s
};

// Of the system's clock of the peer against ours.
struct ClockOffset {
  double ahead = 0;  // s, of the peer's
  double error = 0;  // s: it is within ahead - error and ahead + error
};

// The peer that was named.
struct Peer {
  bool found = false;                       // by discovery
  std::string who{};                        // by discovery
  std::optional<std::string> no_address{};  // why its address is not known; else the probe went out
  DatagramCount unicast{};                  // there and back
  DatagramCount multicast{};                // to the group, answered to us
  DatagramCount from_peer{};                // of `unicast`, answered to the group too
  int sent = 0;                             // messages of the round trip
  int returned = 0;
  Spread there_and_back{};
  std::optional<ClockOffset> offset{};
};

struct Measurements {
  Question question{};
  std::vector<std::string> interfaces{};          // of this machine
  std::optional<LinkState> link{};                // empty: there is no interface of that name
  std::vector<Address> addresses{};               // of all interfaces
  std::optional<std::string> multicast_route{};   // the interface it leads to; "" to none
  std::optional<DatagramCount> self_multicast{};  // to the group and back to ourselves
  std::optional<DropCounts> dropped{};            // during the test
  std::optional<int> receive_buffer{};  // bytes that a socket gets which asks for kCycloneReceive
  std::optional<int> send_buffer{};     // bytes that a socket gets which asks for kCycloneSend
  std::optional<Rights> rights{};
  std::vector<std::string> governors{};  // of the cores, each once; empty: not seen
  std::optional<double> load{};          // programs that wanted to run in the last minute
  int cores = 0;
  Spread lateness{};  // of the wakings, one every kPeriod
  std::string clock_source{};
  ClockCourse clock{};
  std::optional<ClockSync> sync{};
  std::string no_bus{};  // why there is none; "" if we joined
  std::vector<bus::Neighbour> participants{};
  std::vector<bus::Endpoint> endpoints{};
  std::vector<StateWriter> robots{};
  States states{};
  std::optional<Peer> peer{};
};

// What Cyclone DDS 0.10.2 asks for (its SocketReceiveBufferSize and SocketSendBufferSize), bytes.
inline constexpr int kCycloneReceive = 1 << 20, kCycloneSend = 64 << 10;

}  // namespace understudy::doctor
