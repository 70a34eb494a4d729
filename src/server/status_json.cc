#include "server/status_json.h"

#include <numeric>
#include <string>

#include "motion/protection.h"
#include "robot/remote_keys.h"

namespace understudy::server {
namespace {

using nlohmann::ordered_json;

ordered_json RefusedJson(const authority::GateCounts& counts) {
  ordered_json refused;
  for (std::size_t i = 1; i < robot::kRefusals; ++i) {
    refused[std::string{robot::Name(static_cast<robot::Refusal>(i))}] = counts.refused[i];
  }
  return refused;
}

ordered_json RefusedJson(const services::ServiceCounts& counts) {
  ordered_json refused;
  for (std::size_t i = 1; i < services::kCallRefusals; ++i) {
    refused[std::string{services::Name(static_cast<services::CallRefusal>(i))}] = counts.refused[i];
  }
  return refused;
}

// {"seed": 7, "drawn": {"friction": 0.9, "mass": {"base_link": 1.02, ...}, ...}}; null where
// nothing was drawn.
ordered_json DrawsJson(const robot::Draws& draws) {
  if (draws.seed < 0) return nullptr;
  ordered_json drawn = ordered_json::object();
  for (const robot::Drawn& one : draws.values) {
    if (one.element.empty()) {
      drawn[one.quantity] = one.value;
    } else {
      drawn[one.quantity][one.element] = one.value;
    }
  }
  return {{"seed", draws.seed}, {"drawn", drawn}};
}

// One object per hand that the robot has.
ordered_json HandsJson(const emulator::Status& status) {
  ordered_json hands = ordered_json::array();
  for (const emulator::HandStatus& hand : status.hands) {
    if (hand.name[0] == '\0') continue;
    hands.push_back({{"name", hand.name.data()},
                     {"accepted", hand.commands.accepted},
                     {"timeouts", hand.commands.timeouts},
                     {"refused", RefusedJson(hand.commands)}});
  }
  return hands;
}

// {"left": 3.5, "right": 0.0}, N; {} of a robot without hands.
ordered_json HandForceJson(const emulator::Status& status) {
  ordered_json forces = ordered_json::object();
  for (const emulator::HandForce& hand : status.hand_forces) {
    if (hand.name[0] != '\0') forces[hand.name.data()] = hand.force;
  }
  return forces;
}

// Those dangers against which the motion service does something now.
ordered_json ProtectsJson(const robot::MotionState& state) {
  ordered_json names = ordered_json::array();
  for (std::size_t i = 0; i < state.dangers.size(); ++i) {
    if (state.dangers[i].does != robot::Protection::kNothing) {
      names.push_back(motion::Dangers()[i].name);
    }
  }
  return names;
}

ordered_json PaceJson(const time::PaceReading& pace) {
  return {{"real_time_factor", pace.real_time_factor},
          {"overruns", pace.overruns},
          {"lateness", pace.lateness},
          {"worst_lateness", pace.worst_lateness},
          {"shifts", pace.shifts},
          {"shifted", pace.shifted}};
}

ordered_json HistogramJson(const time::Histogram& histogram) {
  ordered_json buckets = ordered_json::array();
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    ordered_json bucket{{"count", histogram.counts[i]}};
    if (i < time::kHistogramBounds.size()) bucket["le"] = time::kHistogramBounds[i];
    buckets.push_back(bucket);
  }
  const auto count =
      std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0});
  const double mean = count == 0 ? 0 : histogram.sum / static_cast<double>(count);
  return {{"count", count}, {"mean", mean}, {"sum", histogram.sum}, {"buckets", buckets}};
}

}  // namespace

ordered_json StatusJson(const RobotIdentity& identity, const emulator::Status& status,
                        const EventHistory& events) {
  return {
      {"robot", identity.robot},
      {"name", identity.name},
      {"version", identity.version},
      {"pid", identity.pid},
      {"log", identity.log},
      {"ready", status.loop.ready},
      {"silenced", status.silenced},
      {"time", status.time},
      {"steps", status.steps},
      {"speed", status.speed},
      {"paused", status.paused},
      {"steps_left", status.steps_left},
      {"pace", PaceJson(status.loop.pace)},
      {"commands",
       {{"state", authority::Name(status.gate)},
        {"accepted", status.commands.accepted},
        {"timeouts", status.commands.timeouts},
        {"refused", RefusedJson(status.commands)},
        {"unused_slots", status.port.unused_slots},
        {"unset_heads", status.port.unset_heads},
        {"writers", status.command_writers}}},
      {"arm_sdk",
       {{"accepted", status.arm_commands.accepted}, {"refused", RefusedJson(status.arm_commands)}}},
      {"user_lowcmd",
       {{"accepted", status.user_commands.accepted},
        {"timeouts", status.user_commands.timeouts},
        {"refused", RefusedJson(status.user_commands)}}},
      {"hand_sdk",
       {{"accepted", status.hand_commands.accepted},
        {"refused", RefusedJson(status.hand_commands)}}},
      {"hands", HandsJson(status)},
      {"hand_force", HandForceJson(status)},
      {"services",
       {{"requests", status.services.requests},
        {"refused", RefusedJson(status.services)},
        {"lost_replies", status.services.lost_replies}}},
      {"power", robot::Name(status.power)},
      {"boots_for", status.boots_for},
      {"motion",
       {{"service", status.motion_service.data()},
        {"state", status.motion.id},
        {"name", status.motion.name},
        {"mode", status.motion.mode},
        {"protects", ProtectsJson(status.motion)},
        {"arm_weight", status.arm_weight},
        {"hand_weight", status.hand_weight}}},
      {"remote",
       {{"there", status.remote.there},
        {"keys", robot::RemoteKeyNames(status.remote.keys)},
        {"lx", status.remote.lx},
        {"ly", status.remote.ly},
        {"rx", status.remote.rx},
        {"ry", status.remote.ry},
        {"wish", status.stick_wish}}},
      {"script",
       {{"done", status.script_done},
        {"refused", status.script_refused},
        {"waiting", status.script_waiting},
        {"where", status.script_where.data()},
        {"waits_for", status.script_waits_for.data()}}},
      {"published", status.published},
      {"write_failures", status.port.write_failures},
      {"divergences", status.divergences},
      {"crane",
       {{"attached", status.crane_attached},
        {"length", status.crane_length},
        {"tension", status.crane_tension}}},
      {"clamped", status.clamped},
      {"base", {{"height", status.base_height}, {"tilt", status.tilt}}},
      {"recording",
       {{"state", emulator::Name(status.loop.recording.state)},
        {"file", status.loop.recording.file.data()},
        {"messages", status.loop.recording.messages},
        {"bytes", status.loop.recording.bytes},
        {"dropped", status.loop.recording.dropped}}},
      {"randomization", DrawsJson(identity.draws)},
      {"unserved", UnservedJson(events)},
  };
}

ordered_json TimingsJson(const emulator::Status& status) {
  ordered_json timings{{"time", status.time},
                       {"steps", status.steps},
                       {"speed", status.speed},
                       {"paused", status.paused}};
  timings.update(PaceJson(status.loop.pace));
  timings["tick"] = HistogramJson(status.loop.ticks);
  timings["late"] = HistogramJson(status.loop.pace.latenesses);
  return timings;
}

}  // namespace understudy::server
