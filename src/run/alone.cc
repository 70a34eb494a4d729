#include "run/alone.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <spdlog/spdlog.h>

#include "base/errors.h"
#include "base/signals.h"

namespace understudy::run {
namespace {

// For a robot that starts at the same moment: *assumed*, several times the longest start.
constexpr std::chrono::seconds kElderPatience(60);

// Those of them that are robots of this program.
std::vector<bus::Neighbour> Robots(const wire::StrangerWatch& watch,
                                   std::vector<bus::Neighbour> strangers) {
  std::erase_if(strangers, [&](const bus::Neighbour& one) {
    return watch.KindOf(one) == wire::StrangerWatch::Kind::kOther;
  });
  return strangers;
}

}  // namespace

void RefuseToStartBeside(wire::StrangerWatch* watch, time::Clock::Time since,
                         const bus::Participant& participant, const config::GuardConfig& guard,
                         bool private_network, time::Clock* clock) {
  // A private network has nobody in it before the robot speaks: the program waits until then.
  const double seconds = private_network                   ? 0
                         : participant.interface() == "lo" ? guard.listen_loopback
                                                           : guard.listen_network;
  const auto listen =
      std::chrono::duration_cast<time::Clock::Time>(std::chrono::duration<double>(seconds));
  const std::string where =
      participant.interface() + ", domain " + std::to_string(participant.domain()) + ": ";
  constexpr const char* kInstead =
      "; nothing was sent. Use another --domain or --interface, or `understudy exec`";
  const bool waits = guard.on_stranger != config::StrangerAction::kWarn;
  time::Clock::Time until = since + listen;
  const time::Clock::Time give_up = clock->Now() + kElderPatience;
  bool alone = true;
  while (true) {
    const wire::StrangerWatch::News news = watch->Poll();
    if (!news.spoke.empty()) {
      throw NeighbourError("a robot is already on " + where + wire::Describe(news.spoke) +
                           " sends rt/lowstate" + kInstead);
    }
    const time::Clock::Time now = clock->Now();
    if (alone && !news.appeared.empty()) {
      alone = false;
      until = std::max(until, now + listen);
    }
    // Two that start at the same moment both hear nobody. The one that began first goes on; the
    // other waits until it writes, or is gone because it could not start after all.
    const std::vector<bus::Neighbour> elders = watch->EldersStarting();
    if (waits && !elders.empty()) {
      if (now >= give_up) {
        throw NeighbourError("a robot has been starting on " + where + wire::Describe(elders) +
                             " for a minute" + kInstead);
      }
      if (StopSignal() != 0)
        throw NeighbourError("ended while it waited for a robot on " + where +
                             wire::Describe(elders) + " starts first");
      until = std::max(until, now + listen);
    }
    const std::vector<bus::Neighbour> starts = Robots(*watch, news.appeared);
    if (waits && !starts.empty()) {
      throw NeighbourError("a robot is already on " + where + wire::Describe(starts) +
                           " was there first, so this one yields" + kInstead);
    }
    if (now >= until) break;
    clock->SleepUntil(std::min(until, now + std::chrono::milliseconds(10)));
  }
  const std::vector<bus::Neighbour> silent = watch->silent();
  if (silent.empty()) return;
  const std::string what = wire::Describe(silent) + " can send rt/lowstate and has not done so yet";
  if (guard.on_stranger == config::StrangerAction::kWarn) {
    spdlog::warn("{}; starting anyway (guard.on_stranger: warn)", what);
    return;
  }
  throw NeighbourError(
      "a robot may already be on " + where + what +
      "; nothing was sent. Is it a program of yours, as some clients in C++ are? Then start the "
      "robot before it, or use `understudy exec`, or allow it by --set guard.on_stranger=warn");
}

}  // namespace understudy::run
