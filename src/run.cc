#include "run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "bus/participant.h"
#include "control/server.h"
#include "emulator.h"
#include "make_world.h"
#include "physics/world_model.h"
#include "reporter.h"
#include "robot/errors.h"
#include "services/robot_services.h"
#include "services/service_host.h"
#include "time/pacer.h"
#include "time/realtime.h"
#include "wire/open_port.h"
#include "wire/strangers.h"

namespace understudy {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHousekeeping(20);
// The loop looks at the clock, the stop flag and the board only so often when it does not wait.
constexpr std::int64_t kStepsPerPost = 10;

// Returns when nobody else is a robot here, or only may be one and the configuration allows that.
// `since`: when the watch was set. Who has a writer is given the same time again to speak.
void RefuseToStartBeside(StrangerWatch* watch, Clock::Time since, const Participant& participant,
                         const GuardConfig& guard, Clock* clock) {
  const double seconds =
      participant.interface() == "lo" ? guard.listen_loopback : guard.listen_network;
  const auto listen =
      std::chrono::duration_cast<Clock::Time>(std::chrono::duration<double>(seconds));
  const std::string where =
      participant.interface() + ", domain " + std::to_string(participant.domain()) + ": ";
  Clock::Time until = since + listen;
  bool alone = true;
  while (true) {
    const StrangerWatch::News news = watch->Poll();
    if (!news.spoke.empty()) {
      throw NeighbourError("a robot is already on " + where + Describe(news.spoke) +
                           " sends rt/lowstate; nothing was sent. Use another --domain or "
                           "--interface, or `understudy exec`");
    }
    const Clock::Time now = clock->Now();
    if (alone && !news.appeared.empty()) {
      alone = false;
      until = std::max(until, now + listen);
    }
    if (now >= until) break;
    clock->SleepUntil(std::min(until, now + milliseconds(10)));
  }
  const std::vector<Neighbour> silent = watch->silent();
  if (silent.empty()) return;
  const std::string what = Describe(silent) + " can send rt/lowstate and has not done so yet";
  if (guard.on_stranger == StrangerAction::kWarn) {
    spdlog::warn("{}; we start all the same (guard.on_stranger: warn)", what);
    return;
  }
  throw NeighbourError(
      "a robot may already be on " + where + what +
      "; nothing was sent. Is it a program of yours, as some clients in C++ are? Then start the "
      "robot before it, or use `understudy exec`, or allow it by --set guard.on_stranger=warn");
}

// Watches the network and talks to the log and the terminal, beside the loop.
class Housekeeper {
 public:
  Housekeeper(const Config& config, bool status_line, StrangerWatch watch, const StatusBoard* board)
      : action_(config.guard.on_stranger),
        watch_(std::move(watch)),
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
    const StrangerWatch::News news = watch_.Poll();
    for (const Neighbour& stranger : news.appeared) {
      spdlog::warn("{} has a writer of rt/lowstate, as a robot has", Describe(stranger));
    }
    constexpr const char* kWhatWeDo[] = {"we fall silent", "we go on (guard.on_stranger: warn)",
                                         "we stop"};
    if (!news.spoke.empty()) {
      spdlog::critical("another robot speaks on this network: {}; {}", Describe(news.spoke),
                       kWhatWeDo[static_cast<int>(action_)]);
    }
    const bool speaks = !watch_.speaking().empty();
    if (speaks_ && !speaks) spdlog::info("the other robot has gone");
    speaks_ = speaks;
    must_silence_ = speaks && action_ == StrangerAction::kSilence;
    must_stop_ = speaks && action_ == StrangerAction::kStop;
  }

  StrangerAction action_;
  StrangerWatch watch_;
  const StatusBoard* board_;
  Reporter reporter_;
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
        "{} has no multicast: about nine programs find each other. `ip link set {} multicast on` "
        "as "
        "root, or `understudy exec`, lifts that",
        config.network.interface, config.network.interface);
  }
  StrangerWatch watch(participant);
  const Clock::Time watch_set = clock.Now();
  MadeWorld made = MakeWorld(&config);
  RefuseToStartBeside(&watch, watch_set, participant, config.guard, &clock);

  const auto port = OpenPort(participant, config.robot);
  ServiceHost host(participant, ServicesOf(config.robot.name),
                   [](const std::string& notice) { spdlog::warn("{}", notice); });

  Inbox inbox;
  StatusBoard board;
  Emulator robot(config, std::move(made.world), port.get(), &inbox);
  robot.Play(options.script);
  const ControlServer control(options.control_socket, config.robot.name, &board, &inbox,
                              ServerLimits{}, std::move(made.draws));
  const Housekeeper housekeeper(config, options.status_line, std::move(watch), &board);

  if (config.time.realtime && config.time.speed > 0) spdlog::info("{}", RequestRealtime().text);
  Pacer pacer(&clock, Clock::Time(std::llround(config.physics.timestep * 1e9)), config.time.speed);

  ExitCode code = ExitCode::kOk;
  bool ready = false;
  while (true) {
    pacer.WaitFor(robot.step());
    const StepHealth health = robot.Tick();
    host.Poll(&robot.owner(), clock.Now());

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
