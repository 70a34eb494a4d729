#include "latency.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

#include "bus/writer.h"
#include "client.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "process.h"
#include "wire/message_crc.h"

namespace understudy::bench {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kPatience(20'000);
constexpr milliseconds kLost(200);  // a message that takes longer is taken for lost
constexpr double kTau = 2;          // N·m; moves little, stands out of the noise of 0.1
constexpr double kAllowance_us = 100;
constexpr double kWantedStart = 0.25;  // s
constexpr double kWantedMemory = 60;   // MB

double Microseconds(Clock::duration time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

void PrepareCommand(int, unitree_go_msg_dds__LowCmd_* command) {
  command->head[0] = 0xFE;
  command->head[1] = 0xEF;
  command->level_flag = 0xFF;
}

void PrepareCommand(int mode_machine, unitree_hg_msg_dds__LowCmd_* command) {
  command->mode_machine = static_cast<std::uint8_t>(mode_machine);
}

// Waits for a message that `matches`; nullopt after `patience`.
template <typename Msg, typename Matches>
std::optional<Clock::time_point> Await(WaitingReader<Msg>* reader, milliseconds patience,
                                       Matches&& matches) {
  const Clock::time_point until = Clock::now() + patience;
  while (Clock::now() < until) {
    if (!reader->Wait(until - Clock::now())) continue;
    bool seen = false;
    reader->Take([&](const Msg& message, bus::WriterHandle) { seen = seen || matches(message); });
    if (seen) return Clock::now();
  }
  return std::nullopt;
}

template <typename Family>
class Probe {
 public:
  Probe(const bus::Participant& participant, const robot::RobotSpec& spec)
      : slot_(static_cast<std::size_t>(spec.motors[0].slot)),
        commands_(participant, Family::kLowCmd),
        states_(participant, Family::kLowState),
        pings_(participant, {"bench/ping", Family::kLowCmd.descriptor}),
        pongs_(participant, {"bench/pong", Family::kLowState.descriptor}) {
    PrepareCommand(spec.mode_machine, &command_);
    for (const robot::MotorSpec& motor : spec.motors) {
      auto& wire = command_.motor_cmd[motor.slot];
      wire.mode = 1;
      wire.kd = 1;
    }
  }

  // µs from write to seen, nullopt when lost.
  std::optional<double> Command() {
    command_.motor_cmd[slot_].tau = static_cast<float>(tau_ = -tau_);
    command_.crc = wire::MessageCrc(command_);
    const Clock::time_point start = Clock::now();
    commands_.Write(command_);
    const auto seen = Await(&states_, kLost, [this](const auto& state) {
      return std::abs(state.motor_state[slot_].tau_est - tau_) < std::abs(tau_);
    });
    return seen ? std::optional(Microseconds(*seen - start)) : std::nullopt;
  }

  std::optional<double> RoundTrip() {
    command_.crc = ++ping_;
    const Clock::time_point start = Clock::now();
    pings_.Write(command_);
    const auto seen =
        Await(&pongs_, kLost, [this](const auto& pong) { return pong.tick == ping_; });
    return seen ? std::optional(Microseconds(*seen - start)) : std::nullopt;
  }

 private:
  std::size_t slot_;
  double tau_ = kTau;
  std::uint32_t ping_ = 0;
  typename Family::LowCmd command_{};
  bus::Writer<typename Family::LowCmd> commands_;
  WaitingReader<typename Family::LowState> states_;
  bus::Writer<typename Family::LowCmd> pings_;
  WaitingReader<typename Family::LowState> pongs_;
};

template <typename Family>
std::vector<Figure> Latency(const std::string& understudy, const robot::RobotSpec& robot,
                            int samples) {
  const Daemon daemon(understudy, robot.name, {"--released"});
  const Process echo(HelperArguments("echo", robot.name));
  const bus::Participant participant("lo", 0);
  Probe<Family> probe(participant, robot);
  daemon.AwaitReady();
  const Clock::time_point until = Clock::now() + kPatience;
  while (!probe.Command() || !probe.RoundTrip()) {
    if (Clock::now() > until) throw std::runtime_error("neither robot nor echo answers");
  }

  const double period_us = 1e6 / robot.rates.lowstate_hz;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> phase(0, period_us);
  std::vector<double> command, trip;
  int lost = 0;
  for (int i = 0; i < samples; ++i) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::micro>(phase(random)));
    const auto one = probe.Command();
    const auto other = probe.RoundTrip();
    one ? command.push_back(*one) : void(++lost);
    other ? trip.push_back(*other) : void(++lost);
  }
  if (command.empty() || trip.empty()) throw std::runtime_error("every message was lost");
  const double trip_p99 = Percentile(trip, 0.99);
  const auto figure = [&](const char* name, double value) {
    return Figure{.robot = robot.name, .name = name, .unit = "us", .value = value};
  };
  std::vector<Figure> figures = {
      figure("round trip of the same messages, p50", Median(trip)),
      figure("round trip of the same messages, p99", trip_p99),
      figure("LowCmd to LowState, p50", Median(command)),
      figure("LowCmd to LowState, p99", Percentile(command, 0.99)),
      {.robot = robot.name, .name = "messages lost", .unit = "", .value = lost + 0.0}};
  figures[3].bound = period_us + trip_p99 + kAllowance_us;
  return figures;
}

template <typename Family>
Figure Start(const std::string& understudy, const robot::RobotSpec& robot, int rounds) {
  const bus::Participant participant("lo", 0);
  WaitingReader<typename Family::LowState> states(participant, Family::kLowState);
  std::vector<double> times;
  for (int round = 0; round < rounds; ++round) {
    const Clock::time_point start = Clock::now();
    const Daemon daemon(understudy, robot.name, {});
    const auto seen = Await(&states, kPatience, [](const auto&) { return true; });
    if (!seen) throw std::runtime_error("no LowState came");
    times.push_back(std::chrono::duration<double>(*seen - start).count());
  }
  return {.robot = robot.name,
          .name = "exec to first LowState at a client",
          .unit = "s",
          .value = Median(times),
          .bound = kWantedStart};
}

}  // namespace

std::vector<Figure> MeasureLatency(const std::string& understudy, const std::string& robot,
                                   int samples) {
  const robot::RobotSpec spec =
      config::LoadConfig({.robot = robot}, config::DataDir()).robots[0].spec;
  return spec.family == robot::WireFamily::kGo ? Latency<GoFamily>(understudy, spec, samples)
                                               : Latency<HgFamily>(understudy, spec, samples);
}

Figure MeasureStart(const std::string& understudy, const std::string& robot, int rounds) {
  const robot::RobotSpec spec =
      config::LoadConfig({.robot = robot}, config::DataDir()).robots[0].spec;
  return spec.family == robot::WireFamily::kGo ? Start<GoFamily>(understudy, spec, rounds)
                                               : Start<HgFamily>(understudy, spec, rounds);
}

std::vector<Figure> MeasureMemory(const std::string& understudy, const std::string& robot,
                                  double seconds) {
  const Daemon daemon(understudy, robot, {});
  daemon.AwaitReady();
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  const pid_t pid = daemon.process().pid();
  const double pss = Megabytes(pid, "Pss:"), rss = Megabytes(pid, "Rss:");
  return {{.robot = robot, .name = "memory, proportional (Pss)", .unit = "MB", .value = pss},
          {.robot = robot,
           .name = "memory, resident (Rss)",
           .unit = "MB",
           .value = rss,
           .bound = kWantedMemory}};
}

}  // namespace understudy::bench
