#include "record/event_log.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "robot/remote_keys.h"

namespace understudy::record {
namespace {

using nlohmann::json;

class Events {
 public:
  Events(const emulator::Status& status, std::int64_t step) : step_(step), time_(status.time) {}

  void Add(std::string kind, std::string text, const json& detail = json::object()) {
    events_.push_back({.step = step_,
                       .time = time_,
                       .kind = std::move(kind),
                       .text = std::move(text),
                       .detail = detail.dump(-1, ' ', false, json::error_handler_t::replace)});
  }
  std::vector<Event> Take() { return std::move(events_); }

 private:
  std::int64_t step_;
  double time_;
  std::vector<Event> events_;
};

std::string Plural(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// What brings the commands of a topic, and whose they are.
std::string MessageOf(std::size_t topic, const emulator::Status& status) {
  if (topic == robot::kLowCmdTopic) return "LowCmd";
  if (topic < robot::kFirstHandTopic)
    return "LowCmd of " + std::string(robot::kCommandTopicNames[topic]);
  return "HandCmd to the " + std::string(status.hands[topic - robot::kFirstHandTopic].name.data()) +
         " hand";
}

json TopicOf(std::size_t topic, const emulator::Status& status) {
  if (topic < robot::kFirstHandTopic) return {{"topic", robot::kCommandTopicNames[topic]}};
  return {{"hand", status.hands[topic - robot::kFirstHandTopic].name.data()}};
}

void TellRequests(const emulator::RequestNotes& notes, std::uint64_t told, Events* events) {
  const std::uint64_t oldest = std::max(told, notes.oldest());
  if (oldest > told) events->Add("requests", Plural(oldest - told, "more request"));
  for (std::uint64_t number = oldest; number < notes.count; ++number) {
    const emulator::Request& request = notes[number].request;
    json detail(emulator::ValuesOf(request));
    detail["time"] = notes[number].time;
    events->Add(std::string(request.row->name), emulator::Describe(request), detail);
  }
}

}  // namespace

std::vector<Event> EventLog::Compare(const emulator::Status& status, std::int64_t step) {
  Events events(status, step);
  const std::string_view service(status.motion_service.data());
  if (first_ || service != last_.motion_service.data()) {
    events.Add("motion_service",
               service.empty() ? "no motion service" : "motion service " + std::string(service),
               {{"service", service}});
  }
  if (first_ || status.gate != last_.gate) {
    events.Add("gate", std::string(authority::Name(status.gate)),
               {{"state", authority::Name(status.gate)}});
  }
  for (std::size_t topic = 0; topic < robot::kMostCommandTopics; ++topic) {
    if (emulator::CommandCounts(status, topic).timeouts ==
        emulator::CommandCounts(last_, topic).timeouts)
      continue;
    events.Add("timeout", MessageOf(topic, status) + " stopped", TopicOf(topic, status));
  }
  if (status.motion.id != last_.motion.id || status.motion.mode != last_.motion.mode) {
    events.Add("motion", "motion " + std::to_string(status.motion.id),
               {{"state", status.motion.id}, {"mode", status.motion.mode}});
  }
  if (status.remote.keys != last_.remote.keys) {
    const std::string keys = robot::RemoteKeyNames(status.remote.keys);
    events.Add("remote", keys.empty() ? "keys let go" : keys, {{"keys", keys}});
  }
  TellRequests(status.requests, last_.requests.count, &events);
  for (std::size_t i = last_.script_done; i < status.script_done && i < script_.size(); ++i) {
    events.Add("script", script_[i], {{"event", i}});
  }
  if (status.script_refused > last_.script_refused) {
    events.Add("script_refused", status.script_refusal.data());
  }
  if (status.divergences > last_.divergences) events.Add("divergence", "the physics diverged");
  if (status.paused != last_.paused) {
    events.Add("pause", status.paused ? "paused" : "goes on", {{"on", status.paused}});
  }
  if (!first_ && status.speed != last_.speed) {
    events.Add("speed", status.speed > 0 ? "speed " + json(status.speed).dump() : "speed max",
               {{"speed", status.speed}});
  }
  if (status.silenced != last_.silenced) {
    events.Add("silence", status.silenced ? "silenced: another robot speaks" : "speaks again",
               {{"on", status.silenced}});
  }
  if (status.crane_attached != last_.crane_attached) {
    events.Add("crane", status.crane_attached ? "hangs from the crane" : "off the crane",
               {{"attached", status.crane_attached}});
  }
  if (status.clamped != last_.clamped) {
    events.Add("clamp", status.clamped ? "clamped" : "unclamped", {{"on", status.clamped}});
  }
  if (status.pace.shifts > last_.pace.shifts) {
    const double late = status.pace.shifted - last_.pace.shifted;
    events.Add("stall", "a stall that is not made up for", {{"seconds", late}});
  }
  std::vector<Event> told = events.Take();
  for (Event& event : Crowds(status, step, false)) told.push_back(std::move(event));
  last_ = status;
  first_ = false;
  return told;
}

std::vector<Event> EventLog::Crowds(const emulator::Status& status, std::int64_t step, bool all) {
  Events events(status, step);
  std::uint64_t fresh = 0;
  for (std::size_t topic = 0; topic < robot::kMostCommandTopics; ++topic) {
    for (std::size_t i = 1; i < robot::kRefusals; ++i) {
      const std::uint64_t count = emulator::CommandCounts(status, topic).refused[i];
      if (!Tell(&refused_[topic][i], count, status.time, all, &fresh)) continue;
      const std::string why(robot::Name(static_cast<robot::Refusal>(i)));
      json detail = TopicOf(topic, status);
      detail["reason"] = why;
      detail["count"] = fresh;
      events.Add(
          "refused",
          "refused " + std::to_string(fresh) + " " + MessageOf(topic, status) + " (" + why + ")",
          detail);
    }
  }
  if (Tell(&overruns_, status.pace.overruns, status.time, all, &fresh)) {
    events.Add("overrun", Plural(fresh, "tick") + " late",
               {{"count", fresh}, {"worst", status.pace.worst_lateness}});
  }
  if (Tell(&failures_, status.port.write_failures, status.time, all, &fresh)) {
    events.Add("write_failure", Plural(fresh, "message") + " not sent", {{"count", fresh}});
  }
  return events.Take();
}

bool EventLog::Tell(Crowd* crowd, std::uint64_t count, double time, bool all,
                    std::uint64_t* fresh) {
  // Half a step of grace.
  if (count == crowd->told || (!all && time < crowd->at + kEventEvery - 0.0005)) return false;
  *fresh = count - crowd->told;
  crowd->told = count;
  crowd->at = time;
  return true;
}

}  // namespace understudy::record
