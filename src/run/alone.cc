#include "run/alone.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <spdlog/spdlog.h>

#include "base/errors.h"

namespace understudy::run {

void RefuseToStartBeside(wire::StrangerWatch* watch, time::Clock::Time since,
                         const bus::Participant& participant, const config::GuardConfig& guard,
                         time::Clock* clock) {
  const double seconds =
      participant.interface() == "lo" ? guard.listen_loopback : guard.listen_network;
  const auto listen =
      std::chrono::duration_cast<time::Clock::Time>(std::chrono::duration<double>(seconds));
  const std::string where =
      participant.interface() + ", domain " + std::to_string(participant.domain()) + ": ";
  time::Clock::Time until = since + listen;
  bool alone = true;
  while (true) {
    const wire::StrangerWatch::News news = watch->Poll();
    if (!news.spoke.empty()) {
      throw NeighbourError("a robot is already on " + where + wire::Describe(news.spoke) +
                           " sends rt/lowstate; nothing was sent. Use another --domain or "
                           "--interface, or `understudy exec`");
    }
    const time::Clock::Time now = clock->Now();
    if (alone && !news.appeared.empty()) {
      alone = false;
      until = std::max(until, now + listen);
    }
    if (now >= until) break;
    clock->SleepUntil(std::min(until, now + std::chrono::milliseconds(10)));
  }
  const std::vector<bus::Neighbour> silent = watch->silent();
  if (silent.empty()) return;
  const std::string what = wire::Describe(silent) + " can send rt/lowstate and has not done so yet";
  if (guard.on_stranger == config::StrangerAction::kWarn) {
    spdlog::warn("{}; we start all the same (guard.on_stranger: warn)", what);
    return;
  }
  throw NeighbourError(
      "a robot may already be on " + where + what +
      "; nothing was sent. Is it a program of yours, as some clients in C++ are? Then start the "
      "robot before it, or use `understudy exec`, or allow it by --set guard.on_stranger=warn");
}

}  // namespace understudy::run
