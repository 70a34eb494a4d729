#include "run/reporter.h"

#include <cstdio>

#include <spdlog/spdlog.h>

#include "robot/refusal_text.h"

namespace understudy::run {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Late ticks since they were last spoken of that are worth a warning.
constexpr std::uint64_t kManyOverruns = 50;

// Causes beside the refusals.
enum Cause : std::size_t {
  kWriters = robot::kMostCommandTopics * robot::kRefusals,
  kUnusedSlots,
  kUnsetHeads,
  kWriteFailures,
  kTimeouts,
  kOverruns,
  kShifts,
  kDivergence,
  kScript,
  kHandTimeouts  // and of the other hands
};

}  // namespace

Reporter::Reporter(double expected_hz, bool status_line)
    : expected_hz_(expected_hz), status_line_(status_line) {
  spoken_.fill(-seconds(10));
}

Reporter::~Reporter() {
  if (line_drawn_) std::fputs("\r\033[K", stderr);
}

void Reporter::Update(const emulator::Status& status, WallTime now) {
  for (std::size_t topic = 0; topic < robot::kMostCommandTopics; ++topic) {
    SpeakOfRefusals(topic, status, now);
  }
  if (status.command_writers > 1 && status.command_writers != last_.command_writers &&
      MaySpeak(kWriters, now)) {
    spdlog::warn("{} programs write rt/lowcmd; the robot follows whichever wrote last",
                 status.command_writers);
  }
  if (status.port.unused_slots != 0 && last_.port.unused_slots == 0 &&
      MaySpeak(kUnusedSlots, now)) {
    spdlog::warn(
        "a LowCmd sets gains or torque in a slot without a motor; the robot ignores it. Is the "
        "program's motor order this robot's?");
  }
  if (status.port.unset_heads != 0 && last_.port.unset_heads == 0 && MaySpeak(kUnsetHeads, now)) {
    spdlog::info(
        "LowCmd comes without head and level_flag; it is taken, though nobody has shown that a "
        "real robot does");
  }
  if (status.port.write_failures != last_.port.write_failures && MaySpeak(kWriteFailures, now)) {
    spdlog::error("{} messages could not be sent", status.port.write_failures);
  }
  if (status.commands.timeouts != last_.commands.timeouts && MaySpeak(kTimeouts, now)) {
    spdlog::warn("commands stopped: motors are damping until the next one");
  }
  if (status.gate == authority::GateState::kFollowing && last_.commands.accepted == 0 &&
      status.commands.accepted > 0) {
    spdlog::info("following LowCmd");
  }
  for (std::size_t hand = 0; hand < robot::kMostHands; ++hand) SpeakOfHand(hand, status, now);
  if (status.pace.overruns != said_overruns_ && MaySpeak(kOverruns, now)) {
    // A few late ticks are made up for unnoticed. Many mean that the machine is too slow.
    const std::uint64_t fresh = status.pace.overruns - said_overruns_;
    const auto level = fresh > kManyOverruns ? spdlog::level::warn : spdlog::level::info;
    const double factor = status.pace.real_time_factor;
    spdlog::log(level, "{} ticks began late, the worst so far by {:.1f} ms{}", fresh,
                status.pace.worst_lateness * 1e3,
                factor > 0 ? fmt::format("; real-time factor {:.2f}", factor) : "");
    said_overruns_ = status.pace.overruns;
  }
  if (status.pace.shifted > said_shifted_ && MaySpeak(kShifts, now)) {
    spdlog::warn("{:.1f} s behind wall time, which is not made up for: simulated time goes on late",
                 status.pace.shifted - said_shifted_);
    said_shifted_ = status.pace.shifted;
  }
  if (status.divergences != last_.divergences && MaySpeak(kDivergence, now)) {
    spdlog::error("the physics diverged at {:.3f} s", status.time);
  }
  if (status.motion_service != last_.motion_service) {
    if (const std::string_view service(status.motion_service.data()); service.empty()) {
      spdlog::info("no motion service is on: motors follow rt/lowcmd");
    } else {
      spdlog::info("motion service {} moves the motors", service);
    }
  }
  if (status.script_refused != last_.script_refused && MaySpeak(kScript, now)) {
    spdlog::warn("script: {}", status.script_refusal.data());
  }
  if (last_.ready) SpeakOfPace(status);
  if (status_line_) DrawStatusLine(status, now);
  last_ = status;
}

void Reporter::SpeakOfPace(const emulator::Status& status) const {
  if (status.paused != last_.paused) {
    spdlog::info("{} at {:.3f} s", status.paused ? "paused" : "resumed", status.time);
  }
  if (status.speed == last_.speed) return;
  spdlog::info("speed {}",
               status.speed == 0 ? "as fast as possible" : fmt::format("{:g}", status.speed));
}

void Reporter::SpeakOfRefusals(std::size_t topic, const emulator::Status& status, WallTime now) {
  const authority::GateCounts& counts = emulator::CommandCounts(status, topic);
  for (std::size_t i = 1; i < robot::kRefusals; ++i) {
    const std::uint64_t fresh = counts.refused[i] - said_refused_[topic][i];
    if (fresh == 0 || !MaySpeak(topic * robot::kRefusals + i, now)) continue;
    said_refused_[topic][i] = counts.refused[i];
    const auto refusal = static_cast<robot::Refusal>(i);
    if (topic == robot::kLowCmdTopic) {
      spdlog::warn("refused {} LowCmd ({}): {}", fresh, robot::Name(refusal),
                   robot::Explain(refusal));
    } else if (topic < robot::kFirstHandTopic) {
      spdlog::warn("refused {} LowCmd of {} ({}): {}", fresh, robot::kCommandTopicNames[topic],
                   robot::Name(refusal), robot::Explain(refusal));
    } else {
      spdlog::warn("refused {} HandCmd to the {} hand ({}): {}", fresh,
                   status.hands[topic - robot::kFirstHandTopic].name.data(), robot::Name(refusal),
                   robot::ExplainForHand(refusal));
    }
  }
}

void Reporter::SpeakOfHand(std::size_t hand, const emulator::Status& status, WallTime now) {
  const emulator::HandStatus& is = status.hands[hand];
  const emulator::HandStatus& was = last_.hands[hand];
  if (is.commands.timeouts != was.commands.timeouts && MaySpeak(kHandTimeouts + hand, now)) {
    spdlog::warn("commands to the {} hand stopped: watched motors lock until mode's bit 7 is 0",
                 is.name.data());
  }
  if (was.commands.accepted == 0 && is.commands.accepted > 0) {
    spdlog::info("the {} hand follows HandCmd", is.name.data());
  }
}

bool Reporter::MaySpeak(std::size_t cause, WallTime now) {
  if (now - spoken_[cause] < seconds(1)) return false;
  spoken_[cause] = now;
  return true;
}

void Reporter::DrawStatusLine(const emulator::Status& status, WallTime now) {
  const bool started = line_drawn_ || status.pace.real_time_factor > 0;
  if (started && now - drawn_at_ < milliseconds(500)) return;
  if (started) {
    const double wall = std::chrono::duration<double>(now - drawn_at_).count();
    const auto rate = [wall](std::uint64_t to, std::uint64_t from) {
      return static_cast<double>(to - from) / wall;
    };
    const double factor = (status.time - drawn_.time) / wall;
    const std::string refusal =
        status.last_refusal == robot::Refusal::kNone
            ? ""
            : "  last refusal " + std::string(robot::Name(status.last_refusal));
    std::fprintf(stderr, "\r\033[K%.1f s  x%.2f  LowState %.0f/s of %.0f  LowCmd %.0f/s  %s%s%s%s",
                 status.time, factor, rate(status.published, drawn_.published),
                 expected_hz_ * factor, rate(status.commands.accepted, drawn_.commands.accepted),
                 authority::Name(status.gate).data(), status.paused ? "  PAUSED" : "",
                 status.silenced ? "  SILENCED" : "", refusal.c_str());
    std::fflush(stderr);
    line_drawn_ = true;
  }
  drawn_at_ = now;
  drawn_ = status;
}

}  // namespace understudy::run
