#include "wire/unserved.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "wire/robot_topics.h"
#include "wire/who_serves.h"

namespace understudy::wire {
namespace {

constexpr std::chrono::milliseconds kEvery(250);  // *assumed*, as the next two
constexpr std::chrono::seconds kPatience(3);
constexpr std::size_t kMostTold = 32;

// How the names of topics end on which robots are commanded. Robots read these although nobody
// writes, and publish the others although nobody reads.
constexpr std::string_view kOfCommands[] = {"cmd",     "command", "ctrl/l", "ctrl/r",
                                            "request", "switch",  "_sdk"};

bool IsCommand(std::string_view topic) {
  return std::ranges::any_of(kOfCommands,
                             [&](std::string_view end) { return topic.ends_with(end); });
}

bool IsOfRobots(const std::string& topic, bool reads) {
  if (IsCommand(topic) == reads) return false;
  if (!reads) return !WhoServes(topic).empty();
  return topic.starts_with("rt/") || !TypesOf("rt/" + topic).empty();
}

}  // namespace

std::vector<Unserved> UnservedIn(std::span<const bus::Endpoint> endpoints) {
  struct Sides {
    bool written = false, read = false;
  };
  std::map<std::string_view, Sides> sides;
  for (const bus::Endpoint& one : endpoints) {
    Sides& its = sides[one.topic];
    (one.writes ? its.written : its.read) = true;
  }
  std::vector<Unserved> unserved;
  for (const bus::Endpoint& one : endpoints) {
    Sides& its = sides[one.topic];
    if (one.ours || (its.written && its.read) || !IsOfRobots(one.topic, !one.writes)) continue;
    its = {.written = true, .read = true};
    unserved.push_back({.topic = one.topic, .reads = !one.writes, .who = one.who});
  }
  return unserved;
}

std::vector<Unserved> UnservedWatch::Poll(std::chrono::nanoseconds now) {
  if (now < looked_ + kEvery) return {};
  looked_ = now;
  survey_.Poll();
  std::vector<Unserved> found = UnservedIn(survey_.endpoints());
  const auto what = [](const Unserved& one) { return std::pair(one.topic, one.reads); };
  std::erase_if(waiting_, [&](const Waiting& one) {
    return std::ranges::find(found, one.what, what) == found.end();
  });
  std::erase_if(found, [&](const Unserved& one) {
    if (told_.size() >= kMostTold || told_.contains(what(one))) return true;
    const auto known = std::ranges::find(waiting_, what(one), &Waiting::what);
    if (known == waiting_.end()) {
      waiting_.push_back({what(one), now});
    } else if (now >= known->since + kPatience) {
      told_.insert(what(one));
      return false;
    }
    return true;
  });
  return found;
}

}  // namespace understudy::wire
