#include "run.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>
#include <utility>

#include <spdlog/spdlog.h>

#include "bus/neighbours.h"
#include "bus/participant.h"
#include "bus/reader.h"
#include "control/server.h"
#include "emulator.h"
#include "physics/world_model.h"
#include "reporter.h"
#include "robot/errors.h"
#include "scene.h"
#include "services/motion_switcher.h"
#include "services/service_host.h"
#include "time/pacer.h"
#include "time/realtime.h"
#include "wire/open_port.h"
#include "wire/topics.h"

namespace understudy {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHousekeeping(20);
// The loop looks at the clock, the stop flag and the board only so often when it does not wait.
constexpr std::int64_t kStepsPerPost = 10;

// Says what loading a model brought up.
void Tell(const LoadNotes& notes) {
  for (const std::string& warning : notes.warnings) spdlog::warn("{}", warning);
  if (!notes.rewrites.empty()) {
    spdlog::info(
        "{} places of the model were rewritten for this MuJoCo (`understudy check` lists them)",
        notes.rewrites.size());
  }
  for (const Rewrite& rewrite : notes.rewrites) spdlog::debug("{}", rewrite.text());
  for (const std::string& looks : notes.looks) spdlog::debug("{}", looks);
}

// The world of the configured robot. A model from elsewhere may call things otherwise than the
// robot's description: config->robot then takes its names.
PhysicsWorld MakeWorld(Config* config) {
  const SceneFile scene(config->scene, config->terrain);
  const std::filesystem::path file = ModelFile(config->robot);
  const double timestep = config->physics.timestep;
  LoadNotes notes;
  ModelHandle model;
  if (std::filesystem::path(config->robot.model).is_relative()) {
    model = LoadWorldModel(config->robot, file, scene.path(), timestep, &notes);
  } else {
    FittedModel fitted = LoadFittedModel(config->robot, file, scene.path(), timestep, &notes);
    config->robot = std::move(fitted.spec);
    model = std::move(fitted.model);
  }
  Tell(notes);
  return {std::move(model), config->robot};
}

// Somebody else's writer of rt/lowstate, if one is heard within the time to listen, which began
// when the watch was set.
void RefuseToStartBeside(NeighbourWatch* watch, Clock::Time set, const Participant& participant,
                         const GuardConfig& guard, Clock* clock) {
  const double listen =
      participant.interface() == "lo" ? guard.listen_loopback : guard.listen_network;
  const Clock::Time until =
      set + std::chrono::duration_cast<Clock::Time>(std::chrono::duration<double>(listen));
  do {
    for (const Neighbour& neighbour : watch->Poll()) {
      throw NeighbourError("a robot is already on " + participant.interface() + ", domain " +
                           std::to_string(participant.domain()) + ": " + Describe(neighbour) +
                           " writes rt/lowstate; nothing was sent. Use another --domain or "
                           "--interface, or `understudy exec`");
    }
    clock->SleepUntil(std::min(until, clock->Now() + milliseconds(10)));
  } while (clock->Now() < until);
}

// Tells whether a stranger only has a writer of rt/lowstate or sends with it. Clients on the
// vendor's C++ library may have one and never use it (far-unitree-sdk 0.1.8 does).
class StrangerEar {
 public:
  explicit StrangerEar(const Participant& participant)
      : go_(participant, kGoLowState, kOptions), hg_(participant, kHgLowState, kOptions) {}

  bool HearsOne() {
    const auto ignore = [](const auto&, WriterHandle) {};
    return go_.Take(ignore) + hg_.Take(ignore) > 0;
  }

 private:
  static constexpr ReaderOptions kOptions{.depth = 1, .reliable = false, .foreign_only = true};
  Reader<unitree_go_msg_dds__LowState_> go_;
  Reader<unitree_hg_msg_dds__LowState_> hg_;
};

// Watches the network and talks to the log and the terminal, beside the loop.
class Housekeeper {
 public:
  Housekeeper(const Config& config, bool status_line, const Participant& participant,
              NeighbourWatch watch, const StatusBoard* board)
      : action_(config.guard.on_stranger),
        watch_(std::move(watch)),
        ear_(participant),
        board_(board),
        reporter_(config.robot.rates.lowstate_hz, status_line),
        thread_([this](const std::stop_token& stop) { Run(stop); }) {}

  // Another robot speaks, and this is the configured answer.
  bool must_silence() const { return must_silence_; }
  bool must_stop() const { return must_stop_; }

 private:
  void Run(const std::stop_token& stop) {
    SteadyClock clock;
    while (!stop.stop_requested()) {
      Watch();
      reporter_.Update(board_->Read(), clock.Now());
      if (const auto warning = TakeMujocoWarning()) spdlog::warn("MuJoCo: {}", *warning);
      clock.SleepUntil(clock.Now() + kHousekeeping);
    }
    reporter_.Update(board_->Read(), clock.Now());
  }

  void Watch() {
    const auto& strangers = watch_.Poll();
    // Listened to each time: a last word left unread would be taken for the next stranger's.
    const bool heard = ear_.HearsOne() && !strangers.empty();
    if (strangers.size() != known_) {
      for (const Neighbour& stranger : strangers) {
        spdlog::warn("{} has a writer of rt/lowstate, as a robot has", Describe(stranger));
      }
      if (strangers.empty() && speaks_) {
        spdlog::info("the other robot has gone");
        speaks_ = must_silence_ = false;
      }
      known_ = strangers.size();
    }
    if (speaks_ || !heard) return;
    speaks_ = true;
    constexpr const char* kWhatWeDo[] = {"we fall silent", "we go on (guard.on_stranger: warn)",
                                         "we stop"};
    spdlog::critical("another robot speaks on this network: {}; {}", Describe(strangers.front()),
                     kWhatWeDo[static_cast<int>(action_)]);
    must_silence_ = action_ == StrangerAction::kSilence;
    must_stop_ = action_ == StrangerAction::kStop;
  }

  StrangerAction action_;
  NeighbourWatch watch_;
  StrangerEar ear_;
  const StatusBoard* board_;
  Reporter reporter_;
  std::size_t known_ = 0;
  bool speaks_ = false;
  std::atomic<bool> must_silence_{false};
  std::atomic<bool> must_stop_{false};
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace

ExitCode RunRobot(const Config& asked, const RunOptions& options) {
  Config config = asked;
  SteadyClock clock;
  // First the network: discovery listens while the model compiles.
  const Participant participant(config.network.interface, config.network.domain);
  if (!participant.multicast()) {
    spdlog::info(
        "{} has no multicast: about ten programs find each other. `ip link set {} multicast on` as "
        "root, or `understudy exec`, lifts that",
        config.network.interface, config.network.interface);
  }
  NeighbourWatch watch(participant, "rt/lowstate");
  const Clock::Time watch_set = clock.Now();
  PhysicsWorld world = MakeWorld(&config);
  RefuseToStartBeside(&watch, watch_set, participant, config.guard, &clock);

  const auto port = OpenPort(participant, config.robot);
  std::vector<std::unique_ptr<Service>> services;
  services.push_back(std::make_unique<MotionSwitcher>());
  ServiceHost host(participant, std::move(services));
  RobotMode mode;

  Inbox inbox;
  StatusBoard board;
  Emulator robot(config, std::move(world), port.get(), &inbox);
  const ControlServer control(options.control_socket, config.robot.name, &board, &inbox);
  const Housekeeper housekeeper(config, options.status_line, participant, std::move(watch), &board);

  if (config.time.realtime && config.time.speed > 0) spdlog::info("{}", RequestRealtime().text);
  Pacer pacer(&clock, Clock::Time(std::llround(config.physics.timestep * 1e9)), config.time.speed);

  ExitCode code = ExitCode::kOk;
  bool ready = false;
  while (true) {
    pacer.WaitFor(robot.step());
    const StepHealth health = robot.Tick();
    host.Poll(&mode, clock.Now());

    if (!ready) {
      ready = true;
      spdlog::info("{} is on {}, domain {}; control socket {}", config.robot.name,
                   config.network.interface, config.network.domain, control.socket().string());
      if (options.on_ready) options.on_ready();
      pacer.Resume(robot.step(), config.time.speed);
    }
    const bool diverged =
        health == StepHealth::kDiverged && config.physics.on_divergence == DivergenceAction::kStop;
    if (robot.step() % kStepsPerPost != 0 && !diverged) continue;

    Status status = robot.status();
    status.ready = true;
    status.command_writers = port->command_writers();
    status.speed = config.time.speed;
    status.pace = pacer.reading();
    board.Post(status);
    robot.Silence(housekeeper.must_silence());
    if (diverged) {
      spdlog::critical("the physics diverged at {:.3f} s and physics.on_divergence is stop",
                       robot.time());
      code = ExitCode::kDiverged;
      break;
    }
    if (housekeeper.must_stop()) {
      code = ExitCode::kNeighbour;
      break;
    }
    if (config.time.duration > 0 && robot.time() >= config.time.duration) break;
    if (options.should_stop()) break;
  }
  spdlog::info("{} is off the network after {:.1f} simulated seconds", config.robot.name,
               robot.time());
  return code;
}

}  // namespace understudy
