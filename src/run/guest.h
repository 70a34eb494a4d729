// What belongs to one robot while it runs.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "assembly/make_world.h"
#include "base/spsc_ring.h"
#include "bus/discovery.h"
#include "bus/participant.h"
#include "config/config.h"
#include "emulator/events.h"
#include "emulator/status.h"
#include "run/loop.h"
#include "services/service_host.h"
#include "time/clock.h"
#include "wire/port.h"
#include "wire/strangers.h"
#include "wire/unserved.h"

namespace understudy::run {

// Finds other robots, writers of the robot's topics from which nothing arrives, and topics that
// programs wait for in vain. One thread watches; in the loop's thread the robot is silenced, the
// run ended or the writer counted.
class Guard final : public Attachment {
 public:
  // `robot` is its number in the world.
  Guard(std::size_t robot, config::StrangerAction on_stranger, wire::StrangerWatch strangers,
        bus::MismatchWatch mismatches, std::optional<wire::UnservedWatch> unserved);

  // Also reports programs in other DDS domains than `ours`: for a network that no others are on.
  void ExpectOnly(std::set<int> ours) { domains_ = std::move(ours); }

  // Polls the network and logs which robots come and go. For one thread; `now` is wall time.
  void Watch(time::Clock::Time now);

  std::optional<ExitCode> After(const Cycle& cycle) override;

 private:
  // A writer of one of the robot's topics from which nothing arrives.
  struct Unmatched {
    std::array<char, 64> topic{};
    std::array<char, sizeof(emulator::Event::text)> writer{};
  };

  // A topic that nobody serves.
  struct Unserved {
    std::array<char, sizeof(emulator::Event::text)> topic{};
    bool reads = false;
    int process = 0;
  };

  void WatchStrangers(time::Clock::Time now);
  void WatchMismatches(time::Clock::Time now);
  void WatchUnserved(time::Clock::Time now);
  void WatchDomains(time::Clock::Time now);

  std::size_t robot_;
  config::StrangerAction action_;
  wire::StrangerWatch strangers_;
  bus::MismatchWatch mismatches_;
  std::optional<wire::UnservedWatch> unserved_watch_;
  std::set<int> domains_;  // expected or told; empty: any
  time::Clock::Time domains_seen_{};
  time::Clock::Time began_ = time::SteadyClock().Now();
  bool speaks_ = false;  // another robot
  std::atomic<bool> must_silence_{false};
  std::atomic<bool> must_stop_{false};
  SpscRing<Unmatched> unmatched_{8, Unmatched{}};
  SpscRing<Unserved> unserved_{32, Unserved{}};
};

// A robot's network, its topics and services there, and the guard over them.
class Guest {
 public:
  // Joins the network of `config`; discovery begins. `index` is the number of the robot in the
  // world. `config` must outlive the guest; model and time step may change until Open. Throws
  // BusError.
  Guest(std::size_t index, const config::Config& config);
  Guest(const Guest&) = delete;
  Guest& operator=(const Guest&) = delete;

  // Opens topics and services once no other robot is heard (RefuseToStartBeside), and returns them.
  // Throws NeighbourError, BusError, and ModelError if the robot does not fit into the messages.
  emulator::Ports Open(bool private_network, time::Clock* clock);

  // After Open:
  Guard& guard() { return *guard_; }
  services::ServiceHost& services() { return *services_; }

  std::size_t index() const { return index_; }
  const config::RobotConfig& robot() const { return config_.robots[index_]; }
  const bus::Participant& participant() const { return participant_; }

 private:
  std::size_t index_;
  const config::Config& config_;
  bus::Participant participant_;
  std::optional<wire::StrangerWatch> strangers_;  // until Open, then the guard's
  time::Clock::Time watched_since_;
  std::optional<wire::Port> port_;
  std::optional<services::ServiceHost> services_;
  std::optional<Guard> guard_;
};

}  // namespace understudy::run
