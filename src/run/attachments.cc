#include "run/attachments.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <spdlog/spdlog.h>

#include "bus/cyclone_log.h"
#include "mjcf/mujoco_hooks.h"
#include "run/recording.h"
#include "wire/remote_codec.h"

namespace understudy::run {
namespace {

constexpr std::int64_t kStepsPerPost = 10;

// A duration of 0.502 s is 502 steps of 1 ms in spite of rounding.
std::int64_t LastStep(double duration, double timestep) {
  if (duration <= 0) return std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>(std::ceil(duration / timestep - 1e-6));
}

}  // namespace

std::optional<ExitCode> Notices::After(const Cycle&) {
  const std::string_view text = mjcf::TakeMujocoWarning();
  std::string* const slot = text.empty() ? nullptr : warnings_.Claim();
  if (slot == nullptr) return {};
  slot->assign(text);
  warnings_.Commit();
  return {};
}

void Notices::Log(time::Clock::Time now) {
  constexpr std::chrono::seconds kPeriod(10);
  if (!cyclone_logged_ || now >= *cyclone_logged_ + kPeriod) {
    for (const bus::CycloneNotice& notice : bus::TakeCycloneNotices()) {
      spdlog::warn("Cyclone DDS: {}", notice.text());
      cyclone_logged_ = now;
    }
  }
  for (; const std::string* text = warnings_.Front(); warnings_.Pop()) {
    spdlog::warn("MuJoCo: {}", *text);
  }
}

std::optional<ExitCode> Snapshots::After(const Cycle& cycle) {
  emulator::Snapshot* snapshot = mailbox_.Wanted();
  if (snapshot == nullptr) return {};
  cycle.world.Show(snapshot);
  snapshot->wireless_remote = wire::EncodeRemote(snapshot->remote);
  mailbox_.Post();
  return {};
}

StatusPoster::StatusPoster(std::size_t robot, emulator::StatusBoard* board,
                           const Recording* recording)
    : robot_(robot), board_(board), recording_(recording) {}

std::optional<ExitCode> StatusPoster::After(const Cycle& cycle) {
  const emulator::World& world = cycle.world;
  if (cycle.ticked) ticks_.Add(cycle.took);
  const bool due = !cycle.ticked || world.step() == 1 || world.step() % kStepsPerPost == 0 ||
                   world.pace().stands_still() || cycle.diverged() ||
                   (recording_ != nullptr && recording_->turned());
  if (!due) return {};
  const emulator::LoopReading reading = {
      .ready = true,
      .pace = cycle.pacer.reading(),
      .ticks = ticks_,
      .recording = recording_ != nullptr ? recording_->status() : emulator::RecordingStatus{}};
  board_->Post(world.status(robot_, reading));
  return {};
}

std::optional<ExitCode> FirstStep::After(const Cycle& cycle) {
  if (cycle.ticked && call_) std::exchange(call_, nullptr)();
  return {};
}

std::optional<ExitCode> DivergenceStop::After(const Cycle& cycle) {
  if (!cycle.diverged()) return {};
  spdlog::critical("the physics diverged at {:.3f} s and physics.on_divergence is stop",
                   cycle.world.time());
  return ExitCode::kDiverged;
}

StopRule::StopRule(double duration, double timestep, ShouldStop should_stop)
    : last_step_(LastStep(duration, timestep)), should_stop_(std::move(should_stop)) {}

std::optional<ExitCode> StopRule::After(const Cycle& cycle) {
  const std::int64_t step = cycle.world.step();
  const bool stops =
      step >= last_step_ || (should_stop_ && should_stop_(step, &cycle.world.events()));
  return stops ? std::optional(ExitCode::kOk) : std::nullopt;
}

}  // namespace understudy::run
