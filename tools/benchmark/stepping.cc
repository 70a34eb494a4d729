#include "stepping.h"

#include <chrono>
#include <cstdint>
#include <ctime>
#include <optional>
#include <thread>

#include <mujoco/mujoco.h>

#include "alone.h"
#include "client.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "process.h"

namespace understudy::bench {
namespace {

using Wall = std::chrono::steady_clock;

constexpr double kWantedShare = 0.9;
constexpr int kSettle = 1000;  // steps until contacts and tether carry the robot

double ThreadCpu() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

struct Speed {
  double wall = 0;  // steps per s
  double cpu = 0;   // steps per s of CPU of the stepping thread
};

// MuJoCo and nothing else: what holds the settled robot stays as it was there, and every so many
// steps the robot is put back.
class BareLoop {
 public:
  explicit BareLoop(const config::Config& config)
      : settled_(config), model_(settled_.world().physics().model()), data_(mj_makeData(&model_)) {
    for (int i = 0; i < kSettle; ++i) settled_.Step();
    const emulator::Robot& robot = settled_.world().robot();
    mj_copyData(data_.get(), &model_, &settled_.world().physics().data());
    if (!robot.crane().attached()) return;
    const physics::PointReading hook = robot.hook();
    const Eigen::Vector3d pull =
        robot.crane().tension() * (robot.crane().anchor() - hook.p_WP).normalized();
    const mjtNum no_torque[3] = {};
    mj_applyFT(&model_, data_.get(), pull.data(), no_torque, hook.p_WP.data(),
               settled_.world().physics().FindBody(config.robot.crane_body), data_->qfrc_applied);
  }

  Speed Run(double window) {
    constexpr int kTogether = 100;
    const double cpu = ThreadCpu();
    const Wall::time_point start = Wall::now();
    double wall = 0;
    std::int64_t steps = 0;
    do {
      PutBack();
      for (int i = 0; i < kTogether; ++i) mj_step(&model_, data_.get());
      steps += kTogether;
      wall = std::chrono::duration<double>(Wall::now() - start).count();
    } while (wall < window);
    const auto count = static_cast<double>(steps);
    return {.wall = count / wall, .cpu = count / (ThreadCpu() - cpu)};
  }

 private:
  void PutBack() {
    const mjData& settled = settled_.world().physics().data();
    mju_copy(data_->qpos, settled.qpos, model_.nq);
    mju_copy(data_->qvel, settled.qvel, model_.nv);
    mju_copy(data_->qacc_warmstart, settled.qacc_warmstart, model_.nv);
  }

  Alone settled_;
  const mjModel& model_;
  mjcf::DataHandle data_;
};

// Lets a stopped daemon run for a while.
Speed Run(const Daemon& daemon, double window) {
  daemon.process().Continue();
  const std::int64_t steps = daemon.Steps();
  const double cpu = daemon.process().CpuOfFirstThread();
  const Wall::time_point begin = Wall::now();
  std::this_thread::sleep_for(std::chrono::duration<double>(window));
  const auto count = static_cast<double>(daemon.Steps() - steps);
  const double cpu_used = daemon.process().CpuOfFirstThread() - cpu;
  const double wall = std::chrono::duration<double>(Wall::now() - begin).count();
  daemon.process().Stop();
  return {.wall = count / wall, .cpu = count / cpu_used};
}

}  // namespace

std::vector<Figure> MeasureStepping(const std::string& understudy, const std::string& robot,
                                    const std::string& start, bool listener, int rounds,
                                    double window) {
  const config::Config config =
      config::LoadConfig({.robot = robot, .sets = {"start.pose=" + start}}, config::DataDir());
  BareLoop bare(config);
  std::optional<Process> client;
  if (listener) client.emplace(HelperArguments("listen", robot));

  const Daemon daemon(understudy, robot, {"--speed", "max", "--start", start});
  daemon.AwaitReady();
  while (daemon.Steps() < kSettle) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  daemon.process().Stop();

  std::vector<double> bare_wall, daemon_wall, share_wall, share_cpu;
  for (int round = 0; round < rounds; ++round) {
    const Speed theirs = bare.Run(window);
    const Speed ours = Run(daemon, window);
    bare_wall.push_back(theirs.wall);
    daemon_wall.push_back(ours.wall);
    share_wall.push_back(ours.wall / theirs.wall);
    share_cpu.push_back(ours.cpu / theirs.cpu);
  }
  const std::string how = start + (listener ? ", one reader" : "");
  std::vector<Figure> figures;
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& values) {
    figures.push_back({.robot = robot,
                       .name = name + (", " + start) + (listener ? ", one reader" : ""),
                       .unit = unit,
                       .value = Median(values)});
  };
  if (!listener) add("bare MuJoCo", "steps/s", bare_wall);
  add("whole daemon", "steps/s", daemon_wall);
  add("daemon / bare per CPU", "", share_cpu);
  add("daemon / bare", "", share_wall);
  if (!listener) {
    figures.back().bound = kWantedShare;
    figures.back().wanted = Wanted::kAtLeast;
  }
  return figures;
}

}  // namespace understudy::bench
