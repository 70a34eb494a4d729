#include "run/run.h"

#include <chrono>
#include <deque>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "assembly/make_world.h"
#include "bus/foreign_types.h"
#include "config/load.h"
#include "emulator/world.h"
#include "run/attachments.h"
#include "run/guest.h"
#include "run/log_notes.h"
#include "run/loop.h"
#include "run/observers.h"
#include "run/reporter.h"
#include "time/realtime.h"

namespace understudy::run {
namespace {

constexpr std::chrono::milliseconds kHousekeeping(20);

// The robots join their networks first, so that discovery runs while the model compiles.
std::deque<Guest> Join(const config::Config& config) {
  std::deque<Guest> guests;
  for (std::size_t i = 0; i < config.robots.size(); ++i) guests.emplace_back(i, config);
  if (bus::ReadsForeignTypes()) {
    spdlog::warn(
        "the libddsc of this system reads how others describe their types, at which it crashes "
        "where they are on Fast DDS 3 (ROS 2 since Kilted): have them use rmw_cyclonedds_cpp");
  }
  return guests;
}

// Of several robots.
std::vector<std::string> NamesOf(const config::Config& config) {
  std::vector<std::string> names;
  for (const config::RobotConfig& robot : config.robots) names.push_back(robot.name);
  if (names.size() == 1) names.clear();
  return names;
}

// Lets the programs' clock go on once no step follows, since Cyclone waits while it ends.
struct ClockEnd {
  time::ProgramClock* clock;
  ~ClockEnd() {
    if (clock != nullptr) clock->End();
  }
};

// What there is in a run, in the order in which it is made; it goes in reverse.
class Setup {
 public:
  Setup(const config::Config& asked, const RunOptions& options);

  ExitCode Run();

 private:
  std::unique_ptr<emulator::World> MakePlayedWorld();
  void KeepHouse(const std::stop_token& stop);
  void ReportReady();

  const RunOptions& options_;
  config::Config config_;
  time::SteadyClock clock_;
  std::deque<Guest> guests_;  // by number of the robot
  ClockEnd setup_end_{options_.programs};
  robot::Draws draws_;
  std::shared_ptr<const assembly::SightModel> sight_;
  std::deque<emulator::Inbox> inboxes_;  // by robot
  std::unique_ptr<emulator::World> world_;
  std::deque<Observers> observers_;  // by robot
  Notices notices_;
  Reporter reporter_;
  std::jthread housekeeping_;  // uses the above
};

Setup::Setup(const config::Config& asked, const RunOptions& options)
    : options_(options),
      config_(asked),
      guests_(Join(config_)),
      inboxes_(config_.robots.size()),
      world_(MakePlayedWorld()),
      reporter_(&world_->events(), config_.robots[0].spec.rates.lowstate_hz, options.status_line,
                NamesOf(config_)) {
  for (Guest& guest : guests_) {
    observers_.emplace_back(options, config_, draws_, sight_, guest, &inboxes_[guest.index()],
                            world_.get());
    guest.services().Attach(&observers_.back().cameras());
  }
  housekeeping_ = std::jthread([this](const std::stop_token& stop) { KeepHouse(stop); });
}

// The robots speak last, when the model is known to be sound and nobody else is heard.
std::unique_ptr<emulator::World> Setup::MakePlayedWorld() {
  assembly::MadePhysics made = assembly::MakePhysics(&config_);
  LogNotes(made.notes);
  draws_ = std::move(made.draws);
  sight_ = std::move(made.sight);
  auto world = assembly::MakeWorld(
      std::move(made.world), config_,
      [this](std::size_t robot) { return guests_[robot].Open(options_.private_network, &clock_); },
      &inboxes_.front());
  for (std::size_t i = 1; i < inboxes_.size(); ++i) world->Attach(&inboxes_[i]);
  script::Play(options_.script, world.get());
  return world;
}

// Does what must not keep the tick waiting, in a thread of its own.
void Setup::KeepHouse(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const time::Clock::Time now = clock_.Now();
    for (Guest& guest : guests_) guest.guard().Watch(now);
    reporter_.Update(observers_.front().board().Read(), now);
    notices_.Log(now);
    clock_.SleepUntil(clock_.Now() + kHousekeeping);
  }
}

// Called after the first LowState.
void Setup::ReportReady() {
  for (const Guest& guest : guests_) {
    const bus::Participant& participant = guest.participant();
    const server::ControlServer& control = observers_[guest.index()].control();
    const std::string& partition = participant.partition();
    spdlog::info("{} is on {}, domain {}{}; control socket {}", guest.robot().name,
                 participant.interface(), participant.domain(),
                 partition.empty() ? "" : ", partition " + partition, control.socket().string());
    // On lo it matters only when a domain is full; a program that cannot join says so.
    if (!participant.multicast() && participant.interface() != "lo") {
      spdlog::warn(
          "{} has no multicast, so programs on other machines do not find this robot; to fix it, "
          "as root: ip link set {} multicast on",
          participant.interface(), participant.interface());
    }
    if (!control.url().empty()) spdlog::info("panel: {}", control.url());
  }
  if (options_.on_ready) options_.on_ready(observers_.front().control().url());
}

ExitCode Setup::Run() {
  const ClockEnd loop_end{options_.programs};
  if (options_.programs != nullptr) {
    spdlog::info("{}", options_.programs->Begin());
  } else if (config_.time.realtime && config_.time.speed > 0) {
    spdlog::info("{}", time::RequestRealtime().text);
  }
  FirstStep ready([this] { ReportReady(); });
  DivergenceStop divergence;
  StopRule stop(config_.time.duration, config_.physics.timestep, options_.should_stop);
  // The first that ends the run decides its exit code.
  std::vector<Attachment*> attachments = {&notices_};
  for (Observers& observers : observers_) {
    for (Attachment* one : observers.attachments()) attachments.push_back(one);
  }
  attachments.insert(attachments.end(), {&ready, &divergence});
  for (Guest& guest : guests_) attachments.push_back(&guest.guard());
  attachments.push_back(&stop);
  ExitCode code = Loop(&clock_, world_.get(), std::move(attachments), options_.programs).Run();
  const bool cut = std::ranges::any_of(observers_, &Observers::recording_failed);
  if (code == ExitCode::kOk && cut && !options_.recording.file.empty()) code = ExitCode::kRecord;

  if (const emulator::Status status = world_->status(0); status.script_waiting > 0) {
    spdlog::warn("script: {}: was still waiting for '{}' at the end", status.script_where.data(),
                 status.script_waits_for.data());
  }
  for (const config::RobotConfig& robot : config_.robots) {
    spdlog::info("{} has left the network after {:.1f} simulated seconds", robot.name,
                 world_->time());
  }
  return code;
}

}  // namespace

ExitCode RunWorld(const config::Config& config, const RunOptions& options) {
  return Setup(config, options).Run();
}

}  // namespace understudy::run
