// Measurements in which nothing is wrong, and the finding of one check.
#pragma once

#include <algorithm>
#include <string_view>

#include <gtest/gtest.h>

#include "doctor/checks.h"

namespace understudy::doctor {

inline constexpr std::uint32_t kOurs = 0xC0A87BDE;    // 192.168.123.222
inline constexpr std::uint32_t kTheirs = 0xC0A87B63;  // 192.168.123.99
inline constexpr std::uint32_t kSlash24 = 0xFFFFFF00;

// A machine on the cable of a silent robot, with a peer.
inline Measurements Healthy() {
  const DatagramCount all{.sent = 20, .returned = 20, .error = 0};
  Measurements seen;
  seen.question = {.interface = "eth0", .peer = "far"};
  seen.interfaces = {"lo", "eth0"};
  seen.link = LinkState{.up = true, .running = true, .multicast = true, .loopback = false};
  seen.addresses = {{"lo", 0x7F000001, 0xFF000000}, {"eth0", kOurs, kSlash24}};
  seen.multicast_route = "eth0";
  seen.self_multicast = all;
  seen.dropped = DropCounts{};
  seen.receive_buffer = kCycloneReceive;
  seen.send_buffer = kCycloneSend;
  seen.rights = Rights{.fifo = true, .locked = true};
  seen.governors = {"performance"};
  seen.load = 1.0;
  seen.cores = 2;
  seen.lateness = {.count = 1000, .p50 = 6e-5, .p99 = 2e-4, .worst = 5e-3};
  seen.clock_source = "tsc";
  seen.sync = ClockSync{.synchronised = true, .error = 1e-3};
  seen.peer = Peer{.found = true,
                   .who = "process 7 (understudy) on far",
                   .unicast = all,
                   .multicast = all,
                   .from_peer = all,
                   .sent = 1000,
                   .returned = 1000,
                   .there_and_back = {.count = 1000, .p50 = 2e-4, .p99 = 5e-4, .worst = 2e-3},
                   .offset = ClockOffset{.ahead = -1e-3, .error = 1e-4}};
  return seen;
}

// `seen` after `change`.
template <class Change>
Measurements But(Change&& change) {
  Measurements seen = Healthy();
  change(seen);
  return seen;
}

inline Finding FindingOf(std::string_view check, const Measurements& seen) {
  const auto row = std::ranges::find(Checks(), check, &Check::name);
  if (row == Checks().end()) throw std::invalid_argument("no check '" + std::string(check) + "'");
  return row->judge(seen);
}

inline CheckVerdict VerdictOf(std::string_view check, const Measurements& seen) {
  return FindingOf(check, seen).verdict;
}

// For messages of failed expectations.
inline void PrintTo(CheckVerdict verdict, std::ostream* out) { *out << Word(verdict); }

}  // namespace understudy::doctor
