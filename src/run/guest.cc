#include "run/guest.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "run/alone.h"
#include "run/other_domains.h"
#include "services/robot_services.h"
#include "wire/robot_rank.h"

namespace understudy::run {
namespace {

using Kind = wire::StrangerWatch::Kind;

// Two robots that started without hearing each other do so soon after; *assumed*, several times the
// duration of discovery on a busy network.
constexpr std::chrono::seconds kSameMoment(5);
constexpr std::chrono::seconds kDomainsEvery(1);  // *assumed*

// Since 1970 [ns].
std::int64_t Today() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

Guard::Guard(std::size_t robot, config::StrangerAction on_stranger, wire::StrangerWatch strangers,
             bus::MismatchWatch mismatches, std::optional<wire::UnservedWatch> unserved)
    : robot_(robot),
      action_(on_stranger),
      strangers_(std::move(strangers)),
      mismatches_(std::move(mismatches)),
      unserved_watch_(std::move(unserved)) {}

void Guard::Watch(time::Clock::Time now) {
  WatchStrangers(now);
  WatchMismatches(now);
  if (unserved_watch_) WatchUnserved(now);
  if (!domains_.empty()) WatchDomains(now);
}

void Guard::WatchStrangers(time::Clock::Time now) {
  const wire::StrangerWatch::News news = strangers_.Poll();
  for (const bus::Neighbour& stranger : news.appeared) {
    spdlog::warn("{} has a writer of rt/lowstate, as a robot has", bus::Describe(stranger));
  }
  constexpr const char* kWhatWeDo[] = {"this one sends nothing until that one is gone",
                                       "this one goes on (guard.on_stranger: warn)",
                                       "this one stops"};
  // Of two robots of this program the elder goes on, since the younger yields.
  const auto is = [this](Kind kind) {
    return [this, kind](const bus::Neighbour& one) { return strangers_.KindOf(one) == kind; };
  };
  const std::vector<bus::Neighbour> speaking = strangers_.speaking();
  const bool speaks = !std::ranges::all_of(speaking, is(Kind::kYounger));
  const bool yields = action_ != config::StrangerAction::kWarn && now < began_ + kSameMoment &&
                      std::ranges::any_of(speaking, is(Kind::kElder));
  if (!news.spoke.empty()) {
    const char* const what =
        !speaks  ? "it began to start after this one, so it has to yield, and this one goes on"
        : yields ? "it began to start before this one, so this one stops"
                 : kWhatWeDo[static_cast<int>(action_)];
    spdlog::critical("another robot speaks on this network: {}; {}", wire::Describe(news.spoke),
                     what);
  }
  if (speaks_ && !speaks) spdlog::info("the other robot is gone");
  speaks_ = speaks;
  must_silence_ = speaks && action_ == config::StrangerAction::kSilence;
  must_stop_ = must_stop_ || yields || (speaks && action_ == config::StrangerAction::kStop);
}

void Guard::WatchMismatches(time::Clock::Time now) {
  for (const bus::Mismatch& found : mismatches_.Poll(now)) {
    Unmatched* const slot = unmatched_.Claim();
    if (slot == nullptr) return;
    emulator::CopyText(found.topic, &slot->topic);
    emulator::CopyText(bus::Describe(found), &slot->writer);
    unmatched_.Commit();
  }
}

void Guard::WatchUnserved(time::Clock::Time now) {
  for (const wire::Unserved& found : unserved_watch_->Poll(now)) {
    Unserved* const slot = unserved_.Claim();
    if (slot == nullptr) return;
    emulator::CopyText(found.topic, &slot->topic);
    slot->reads = found.reads;
    slot->process = 0;  // stays where a stranger announces no number
    const std::string& pid = found.who.pid;
    std::from_chars(pid.data(), pid.data() + pid.size(), slot->process);
    unserved_.Commit();
  }
}

void Guard::WatchDomains(time::Clock::Time now) {
  if (now < domains_seen_ + kDomainsEvery) return;
  domains_seen_ = now;
  for (const int domain : DomainsHere()) {
    if (!domains_.insert(domain).second) continue;
    spdlog::warn(
        "a program is in DDS domain {}, where it does not find this robot; start the robot with "
        "--domain {}, or the program in the robot's domain (some have an option for simulations)",
        domain, domain);
  }
}

std::optional<ExitCode> Guard::After(const Cycle& cycle) {
  emulator::Robot& robot = cycle.world.robot(robot_);
  robot.Silence(must_silence_);
  for (const Unmatched* one = unmatched_.Front(); one != nullptr; one = unmatched_.Front()) {
    robot.NoteUnmatched(one->topic.data(), one->writer.data());
    unmatched_.Pop();
  }
  for (const Unserved* one = unserved_.Front(); one != nullptr; one = unserved_.Front()) {
    robot.NoteUnserved(one->topic.data(), one->reads, one->process);
    unserved_.Pop();
  }
  if (must_stop_) return ExitCode::kNeighbour;
  return {};
}

Guest::Guest(std::size_t index, const config::Config& config)
    : index_(index),
      config_(config),
      participant_(robot().network.interface, robot().network.domain,
                   wire::AnnounceRobot(Today(), robot().network.partition),
                   robot().network.partition),
      strangers_(participant_),
      watched_since_(time::SteadyClock().Now()) {}

emulator::Ports Guest::Open(bool private_network, time::Clock* clock) {
  RefuseToStartBeside(&*strangers_, watched_since_, participant_, config_.guard, private_network,
                      clock);
  port_.emplace(participant_, robot().spec, config_.physics.timestep);
  services_.emplace(
      participant_, &port_->outlets(), services::ServicesOf(robot().spec.apis),
      [](const std::string& notice) { spdlog::warn("{}", notice); }, robot().spec.status_texts);
  std::vector<const bus::ReaderCore*> readers = port_->readers();
  std::ranges::copy(services_->readers(), std::back_inserter(readers));
  guard_.emplace(index_, config_.guard.on_stranger, *std::exchange(strangers_, std::nullopt),
                 bus::MismatchWatch(participant_, std::move(readers)),
                 // What programs wait for is the same for all robots of a world: one says so.
                 index_ == 0 ? std::optional(wire::UnservedWatch(participant_)) : std::nullopt);
  if (private_network && index_ == 0) {
    std::set<int> ours;
    for (const config::RobotConfig& one : config_.robots) ours.insert(one.network.domain);
    guard_->ExpectOnly(std::move(ours));
  }
  return {.topics = &*port_, .services = &*services_};
}

}  // namespace understudy::run
