#include "run/run.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <malloc.h>
#include <spdlog/spdlog.h>

#include "base/spsc_ring.h"
#include "bus/cyclone_log.h"
#include "bus/discovery.h"
#include "bus/foreign_types.h"
#include "bus/participant.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "emulator/world.h"
#include "mjcf/mujoco_hooks.h"
#include "physics/scene_reader.h"
#include "run/alone.h"
#include "run/make_world.h"
#include "run/reporter.h"
#include "server/server.h"
#include "services/robot_services.h"
#include "services/service_host.h"
#include "time/pacer.h"
#include "time/realtime.h"
#include "wire/port.h"
#include "wire/remote_codec.h"
#include "wire/robot_rank.h"
#include "wire/strangers.h"

namespace understudy::run {
namespace {

using emulator::EventKind;
using std::chrono::milliseconds;

constexpr milliseconds kHousekeeping(20);
// Robots that heard nobody before their start although both were there hear each other soon after;
// *assumed*, several times the duration of discovery on a busy network.
constexpr std::chrono::seconds kSameMoment(5);
// How often a loop that never waits checks the clock and the stop flag and posts its status.
constexpr std::int64_t kStepsPerPost = 10;
// The longest that requests and service calls wait while no step is due or the robot is paused.
constexpr milliseconds kGlance(2);

// Watches the network and writes log and status line, in a thread of its own.
class Housekeeper {
 public:
  Housekeeper(const config::Config& config, bool status_line, wire::StrangerWatch watch,
              bus::MismatchWatch mismatches, const emulator::StatusBoard* board,
              const emulator::EventRing* events)
      : action_(config.guard.on_stranger),
        watch_(std::move(watch)),
        mismatches_(std::move(mismatches)),
        board_(board),
        reporter_(events, config.robot.rates.lowstate_hz, status_line),
        thread_([this](const std::stop_token& stop) { Run(stop); }) {}

  // Whether another robot publishes and guard.on_stranger says so.
  bool must_silence() const { return must_silence_; }
  bool must_stop() const { return must_stop_; }

  // A writer of one of the robot's topics from which nothing arrives.
  struct Unmatched {
    std::array<char, 64> topic{};
    std::array<char, sizeof(emulator::Event::text)> writer{};
  };
  // Calls visit(topic, writer) for each that is new. For the thread of the tick.
  template <typename Visit>
  void TakeUnmatched(Visit&& visit) {
    for (; const Unmatched* one = unmatched_.Front(); unmatched_.Pop()) {
      visit(one->topic.data(), one->writer.data());
    }
  }

  // Logs a warning of MuJoCo from a tick. Never waits; ignores "".
  void Warn(std::string_view text) {
    std::string* const slot = text.empty() ? nullptr : warnings_.Claim();
    if (slot == nullptr) return;
    slot->assign(text);
    warnings_.Commit();
  }

 private:
  void Run(const std::stop_token& stop) {
    time::SteadyClock clock;
    while (!stop.stop_requested()) {
      Watch(clock.Now());
      WatchMismatches(clock.Now());
      reporter_.Update(board_->Read(), clock.Now());
      TellOfCyclone(clock.Now());
      for (; const std::string* text = warnings_.Front(); warnings_.Pop()) {
        spdlog::warn("MuJoCo: {}", *text);
      }
      clock.SleepUntil(clock.Now() + kHousekeeping);
    }
  }

  // The first at once, then sums: garbage comes in large numbers.
  void TellOfCyclone(time::Clock::Time now) {
    constexpr std::chrono::seconds kPeriod(10);
    if (now < cyclone_told_ + kPeriod) return;
    for (const bus::CycloneNotice& notice : bus::TakeCycloneNotices()) {
      spdlog::warn("Cyclone DDS: {}", notice.text());
      cyclone_told_ = now;
    }
  }

  void Watch(time::Clock::Time now) {
    const wire::StrangerWatch::News news = watch_.Poll();
    for (const bus::Neighbour& stranger : news.appeared) {
      spdlog::warn("{} has a writer of rt/lowstate, as a robot has", bus::Describe(stranger));
    }
    constexpr const char* kWhatWeDo[] = {"this one sends nothing until that one is gone",
                                         "this one goes on (guard.on_stranger: warn)",
                                         "this one stops"};
    // Of two robots of this program the elder goes on, since the younger yields.
    using Kind = wire::StrangerWatch::Kind;
    const auto is = [this](Kind kind) {
      return [this, kind](const bus::Neighbour& one) { return watch_.KindOf(one) == kind; };
    };
    const std::vector<bus::Neighbour> speaking = watch_.speaking();
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

  // Passes on to the tick what only this thread has time to find out.
  void WatchMismatches(time::Clock::Time now) {
    for (const bus::Mismatch& found : mismatches_.Poll(now)) {
      Unmatched* const slot = unmatched_.Claim();
      if (slot == nullptr) return;
      emulator::CopyText(found.topic, &slot->topic);
      emulator::CopyText(bus::Describe(found), &slot->writer);
      unmatched_.Commit();
    }
  }

  config::StrangerAction action_;
  wire::StrangerWatch watch_;
  bus::MismatchWatch mismatches_;
  const emulator::StatusBoard* board_;
  Reporter reporter_;
  time::Clock::Time began_ = time::SteadyClock().Now();
  bool speaks_ = false;
  time::Clock::Time cyclone_told_ = -std::chrono::hours(1);
  std::atomic<bool> must_silence_{false};
  std::atomic<bool> must_stop_{false};
  SpscRing<Unmatched> unmatched_{8, Unmatched{}};
  SpscRing<std::string> warnings_{4, std::string(511, ' ')};  // with room for any warning
  std::jthread thread_;                                       // last: it uses all of the above
};

// Where record.start puts what it is given no folder for; "" if that is gone.
std::filesystem::path RecordingFolder() {
  std::error_code gone;
  return std::filesystem::current_path(gone);
}

// Fills in and posts a snapshot if one is requested.
void ShowSnapshot(const emulator::World& world, emulator::SnapshotMailbox* snapshots) {
  emulator::Snapshot* snapshot = snapshots->Wanted();
  if (snapshot == nullptr) return;
  world.Show(snapshot);
  snapshot->wireless_remote = wire::EncodeRemote(snapshot->remote);
  snapshots->Post();
}

}  // namespace

ExitCode RunRobot(const config::Config& asked, const RunOptions& options) {
  config::Config config = asked;
  time::SteadyClock clock;
  // The participant comes first, so that discovery runs while the model compiles.
  const std::int64_t since =
      std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  const bus::Participant participant(config.network.interface, config.network.domain,
                                     wire::AnnounceRobot(since));
  if (bus::ReadsForeignTypes()) {
    spdlog::warn(
        "the libddsc of this system reads how others describe their types, at which it crashes "
        "where they are on Fast DDS 3 (ROS 2 since Kilted): have them use rmw_cyclonedds_cpp");
  }
  wire::StrangerWatch watch(participant);
  const time::Clock::Time watch_set = clock.Now();
  MadeWorld made = MakeWorld(&config);
  // Compiling needs many times the memory of the result; later it is locked.
  malloc_trim(0);
  RefuseToStartBeside(&watch, watch_set, participant, config.guard, options.private_network,
                      &clock);

  wire::Port port(participant, config.robot, config.physics.timestep);
  services::ServiceHost host(
      participant, services::ServicesOf(config.robot.apis),
      [](const std::string& notice) { spdlog::warn("{}", notice); }, config.robot.status_texts);

  emulator::Inbox inbox;
  emulator::StatusBoard board;
  emulator::World world(std::move(made.world), config::WorldSettingsOf(config),
                        {{.spec = config.robot,
                          .settings = config::RobotSettingsOf(config),
                          .port = &port,
                          .services = &host}},
                        &inbox);
  script::Play(options.script, &world);
  Recording recording(options.recording, participant, config, made.draws, &world);
  emulator::SnapshotMailbox snapshots(world.MakeSnapshot());
  physics::SceneReader scene([&config] { return MakeSightModel(config); });
  const server::ControlServer control(
      options.control_socket,
      {.identity = {.robot = config.robot.name,
                    .log = options.log.string(),
                    .draws = std::move(made.draws)},
       .board = &board,
       .inbox = &inbox,
       .snapshots = &snapshots,
       .events = server::EventHistory(&world.events()),
       .scene = server::SceneFiles(&scene, &config.robot),
       .bus = server::BusView(&participant),
       .recordings = server::Recordings(RecordingFolder(), &scene, config.robot.name),
       .services = services::ServicesOf(config.robot.apis),
       .files = server::StaticFiles(config::PanelDir()),
       .openapi = config::OpenApiFile()},
      server::ServerLimits{}, options.panel);
  std::vector<const bus::ReaderCore*> readers = port.readers();
  std::ranges::copy(host.readers(), std::back_inserter(readers));
  Housekeeper housekeeper(config, options.status_line, std::move(watch),
                          bus::MismatchWatch(participant, std::move(readers)), &board,
                          &world.events());

  if (config.time.realtime && config.time.speed > 0)
    spdlog::info("{}", time::RequestRealtime().text);
  time::Pacer pacer(&clock, time::Clock::Time(std::llround(config.physics.timestep * 1e9)),
                    config.time.speed);

  ExitCode code = ExitCode::kOk;
  bool ready = false;
  time::Histogram ticks;
  while (true) {
    physics::StepHealth health = physics::StepHealth::kFine;
    const time::Wait wait = pacer.Follow(world.pace(), world.step(), kGlance);
    if (wait.overrun > 0) world.events().Add(EventKind::kOverrun, 0, {wait.overrun});
    if (wait.shift > 0) world.events().Add(EventKind::kStall, 0, {wait.shift});
    if (wait.due) {
      health = world.Tick(pacer.reached());
      housekeeper.Warn(mjcf::TakeMujocoWarning());
      ticks.Add(std::chrono::duration<double>(clock.Now() - pacer.reached()).count());
    } else {
      world.Attend(clock.Now());
    }
    ShowSnapshot(world, &snapshots);
    if (wait.due) recording.Offer(pacer);
    const bool recording_turned = recording.Follow();
    const bool diverged = health == physics::StepHealth::kDiverged && !world.resets_on_divergence();
    // A client that waits for the last step, for the start or for a recording finds it in this
    // status.
    const bool posts = !ready || recording_turned || world.step() % kStepsPerPost == 0 ||
                       world.pace().stands_still();
    if (wait.due && !posts && !diverged) continue;

    board.Post(world.status(
        {.ready = true, .pace = pacer.reading(), .ticks = ticks, .recording = recording.status()}));
    if (!std::exchange(ready, true)) {
      spdlog::info("{} is on {}, domain {}; control socket {}", config.robot.name,
                   config.network.interface, config.network.domain, control.socket().string());
      if (!control.url().empty()) spdlog::info("panel: {}", control.url());
      // On lo it matters only when a domain is full, and whoever then cannot join says so.
      if (!participant.multicast() && participant.interface() != "lo") {
        spdlog::warn(
            "{} has no multicast, so programs on other machines do not find this robot; to fix it, "
            "as root: ip link set {} multicast on",
            participant.interface(), participant.interface());
      }
      if (options.on_ready) options.on_ready(control.url());
      pacer.Resume(world.step(), world.pace().speed);
    }
    world.robot().Silence(housekeeper.must_silence());
    housekeeper.TakeUnmatched([&](std::string_view topic, std::string_view writer) {
      world.robot().NoteUnmatched(topic, writer);
    });
    if (diverged) {
      spdlog::critical("the physics diverged at {:.3f} s and physics.on_divergence is stop",
                       world.time());
      code = ExitCode::kDiverged;
      break;
    }
    if (housekeeper.must_stop()) {
      code = ExitCode::kNeighbour;
      break;
    }
    if (config.time.duration > 0 && world.time() >= config.time.duration) break;
    if (options.should_stop(world.step(), &world.events())) break;
  }
  if (const emulator::Status status = world.status(); status.script_waiting > 0) {
    spdlog::warn("script: {}: was still waiting for '{}' at the end", status.script_where.data(),
                 status.script_waits_for.data());
  }
  spdlog::info("{} has left the network after {:.1f} simulated seconds", config.robot.name,
               world.time());
  return code;
}

}  // namespace understudy::run
