#include "stepping.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <thread>

#include "assembly/simulation.h"
#include "bare_loop.h"
#include "client.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "process.h"

namespace understudy::bench {
namespace {

using Wall = std::chrono::steady_clock;

struct Stretch {
  std::int64_t from = 0, to = 0;  // steps since the start
  Speed speed;
};

// Lets a stopped daemon run for a while.
Stretch Run(const Daemon& daemon, double window) {
  daemon.process().Continue();
  const std::int64_t from = daemon.Steps();
  const double cpu = daemon.process().CpuOfFirstThread();
  const Wall::time_point begin = Wall::now();
  std::this_thread::sleep_for(std::chrono::duration<double>(window));
  const std::int64_t to = daemon.Steps();
  const double cpu_used = daemon.process().CpuOfFirstThread() - cpu;
  const double wall = std::chrono::duration<double>(Wall::now() - begin).count();
  daemon.process().Stop();
  const auto count = static_cast<double>(to - from);
  return {.from = from, .to = to, .speed = {.wall = count / wall, .cpu = count / cpu_used}};
}

// Lets it go on for so many steps, then stops it.
void Settle(const Daemon& daemon, std::int64_t steps) {
  const std::int64_t settled = daemon.Steps() + steps;
  while (daemon.Steps() < settled) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  daemon.process().Stop();
}

}  // namespace

Figure MeasureFurtherRobot(const std::string& understudy, const std::string& robot,
                           const Rounds& rounds) {
  const std::vector<std::string> options{"--speed", "max", "--start", "standing"};
  std::vector<std::string> two = options;
  two.insert(two.end(), {robot, "--domain", "5"});  // beside the one that has stopped
  const Daemon alone(understudy, robot, options);
  alone.AwaitReady();
  Settle(alone, rounds.settle);
  std::vector<double> of_one, of_two;  // s of CPU a step
  for (int i = 0; i < rounds.count; ++i) of_one.push_back(1 / Run(alone, rounds.window).speed.cpu);
  const Daemon both(understudy, robot, two, robot + "_1");
  both.AwaitReady();
  Settle(both, rounds.settle);
  for (int i = 0; i < rounds.count; ++i) of_two.push_back(1 / Run(both, rounds.window).speed.cpu);
  const double one = Median(of_one);
  return {.robot = robot,
          .name = "a further robot / a run of its own",
          .unit = "",
          .value = (Median(of_two) - one) / one,
          .bound = 1.1,
          .wanted = Wanted::kAtMost};
}

std::vector<Figure> MeasureStepping(const std::string& understudy, const Doing& doing,
                                    bool listener, const Rounds& rounds) {
  const std::string robot = doing.robot, start = doing.start;
  const std::string hands = doing.hands;
  const config::Config config = config::LoadConfig(
      {.robot = robot, .sets = {"start.pose=" + start, "robot.hand_make=" + hands}},
      config::DataDir());
  assembly::Simulation run(config);
  if (doing.ahead != 0) run.Request("remote.sticks", {{"ly", doing.ahead}});
  BareLoop bare(&run);
  std::optional<Process> client;
  if (listener) client.emplace(HelperArguments("listen", robot));

  const Daemon daemon(understudy, robot,
                      {"--speed", "max", "--start", start, "--set", "robot.hand_make=" + hands});
  daemon.AwaitReady();
  if (doing.ahead != 0) daemon.Ask("/remote/sticks", {{"ly", doing.ahead}});
  Settle(daemon, rounds.settle);

  std::vector<double> bare_wall, daemon_wall, share_wall, share_cpu, share_step;
  for (int round = 0; round < rounds.count; ++round) {
    const auto [from, to, ours] = Run(daemon, rounds.window);
    bare.Follow(from, to);
    const Speed theirs = bare.Run(Bare::kWithImu, rounds.window);
    share_step.push_back(ours.wall / bare.Run(Bare::kStep, rounds.window).wall);
    bare_wall.push_back(theirs.wall);
    daemon_wall.push_back(ours.wall);
    share_wall.push_back(ours.wall / theirs.wall);
    share_cpu.push_back(ours.cpu / theirs.cpu);
  }
  const std::string how = (doing.ahead != 0 ? ", walking" : ", " + start) +
                          (hands == "none" ? "" : ", hands " + hands) +
                          (listener ? ", one reader" : "");
  std::vector<Figure> figures;
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& values) {
    figures.push_back({.robot = robot, .name = name + how, .unit = unit, .value = Median(values)});
  };
  if (!listener) add("bare MuJoCo", "steps/s", bare_wall);
  add("whole daemon", "steps/s", daemon_wall);
  add("daemon / bare without an IMU", "", share_step);
  add("daemon / bare per CPU", "", share_cpu);
  add("daemon / bare", "", share_wall);
  if (!listener) {
    figures.back().bound = doing.wanted;
    figures.back().wanted = Wanted::kAtLeast;
  }
  return figures;
}

}  // namespace understudy::bench
