#include "batch.h"

#include <chrono>
#include <numeric>
#include <string>

#include <unistd.h>

#include "assembly/command_port.h"
#include "assembly/simulation.h"
#include "bare_loop.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "process.h"
#include "python/batch.h"
#include "robot/command_topics.h"

namespace understudy::bench {
namespace {

using Wall = std::chrono::steady_clock;

constexpr double kControlPeriod = 0.02;  // s
constexpr int kControls = 50;            // of a round

// As the tasks of understudy.envs have them; a G1 hangs, since by gains alone it would soon fall.
struct Kind {
  const char* robot;
  std::vector<std::string> sets;
  double kp, kd;  // of each motor, N·m/rad and N·m·s/rad
  double wanted;  // share of bare MuJoCo's speed
};
std::vector<Kind> Kinds() {
  return {{.robot = "go2",
           .sets = {"start.pose=standing", "motion.service=none", "physics.timestep=0.002",
                    "physics.contacts=pyramid"},
           .kp = 40,
           .kd = 2,
           .wanted = 0.95},
          {.robot = "g1",
           .sets = {"start.pose=hanging", "motion.service=none"},
           .kp = 150,
           .kd = 4,
           .wanted = 0.92}};
}

std::vector<robot::MotorCommand> Hold(std::span<const float> q, const Kind& kind) {
  std::vector<robot::MotorCommand> motors;
  for (const float angle : q) {
    motors.push_back({.enabled = true, .q = angle, .kp = kind.kp, .kd = kind.kd});
  }
  return motors;
}

double Seconds(Wall::time_point since) {
  return std::chrono::duration<double>(Wall::now() - since).count();
}

// A batch whose robots begin, stand for a second and begin anew.
class Standing {
 public:
  Standing(const Kind& kind, const config::Layers& layers, int robots, std::size_t threads)
      : kind_(kind),
        batch_(layers, static_cast<std::size_t>(robots), threads, 1),
        all_(batch_.size()) {
    std::iota(all_.begin(), all_.end(), 0);
    seeds_.assign(all_.begin(), all_.end());
  }

  // s of CPU of this thread for a robot.
  double Begin() {
    const double cpu = ThreadCpu();
    batch_.Begin(all_, seeds_);
    batch_.Command(Hold(batch_.columns().front().values, kind_));
    return (ThreadCpu() - cpu) / static_cast<double>(batch_.size());
  }
  // Makes the steps of a second and returns how many there were, per s.
  Speed Run() {
    const auto steps = static_cast<double>(Steps() * batch_.size());
    const double cpu = ThreadCpu();
    const Wall::time_point begin = Wall::now();
    for (int i = 0; i < kControls; ++i) batch_.Step(kControlPeriod);
    return {.wall = steps / Seconds(begin), .cpu = steps / (ThreadCpu() - cpu)};
  }
  std::size_t Steps() const {
    return static_cast<std::size_t>(kControls * batch_.robot(0).world().StepsOf(kControlPeriod));
  }

 private:
  const Kind& kind_;
  python::Batch batch_;
  std::vector<std::size_t> all_;
  std::vector<int> seeds_;
};

// The same second of one robot alone, for the bare loop.
class Alone {
 public:
  Alone(const Kind& kind, const config::Config& config)
      : port_(config.robots[0].spec, config.physics.timestep),
        run_(config, [this](std::size_t) { return emulator::Ports{&port_}; }),
        bare_(&run_) {
    run_.Step();
    std::vector<float> q;
    for (const robot::MotorReading& motor : port_.lowstate().motors) {
      q.push_back(static_cast<float>(motor.q));
    }
    port_.Give(robot::kLowCmdTopic, {.motors = Hold(q, kind)});
  }
  BareLoop& Follow(std::size_t steps) {
    bare_.Follow(0, static_cast<std::int64_t>(steps));
    return bare_;
  }

 private:
  assembly::CommandPort port_;
  assembly::Simulation run_;
  BareLoop bare_;
};

std::vector<Figure> Measure(const Kind& kind, const BatchEffort& effort) {
  const config::Layers layers{.robot = kind.robot, .sets = kind.sets};
  Alone alone(kind, config::LoadConfig(layers, config::DataDir()));
  Standing first(kind, layers, 1, 1);  // whose model the others share is none of theirs
  BareLoop& bare = alone.Follow(first.Steps());

  const double memory = Megabytes(getpid(), "Pss:"), cpu = ThreadCpu();
  Standing one(kind, layers, effort.robots, 1);
  const double made = (ThreadCpu() - cpu) / effort.robots;
  const double taken = (Megabytes(getpid(), "Pss:") - memory) / effort.robots;
  Standing two(kind, layers, effort.robots, 2);

  std::vector<double> begins, steps, bares, shares, gains;
  for (int round = 0; round < effort.rounds; ++round) {
    begins.push_back(one.Begin());
    two.Begin();
    const Speed ours = one.Run(), theirs = bare.Run(Bare::kStep, 0.2);
    steps.push_back(ours.cpu);
    bares.push_back(theirs.cpu);
    shares.push_back(ours.cpu / theirs.cpu);
    gains.push_back(two.Run().wall / ours.wall);
  }
  const auto figure = [&kind](const char* name, const char* unit, double value) {
    return Figure{
        .robot = kind.robot, .name = std::string("batch, ") + name, .unit = unit, .value = value};
  };
  const auto bounded = [&figure](const char* name, const char* unit, double value, double bound,
                                 Wanted wanted) {
    Figure limited = figure(name, unit, value);
    limited.bound = bound;
    limited.wanted = wanted;
    return limited;
  };
  std::vector<Figure> figures = {
      figure("bare MuJoCo, steps per s of CPU", "", Median(bares)),
      figure("steps per s of CPU", "", Median(steps)),
      bounded("batch / bare MuJoCo per CPU", "", Median(shares), kind.wanted, Wanted::kAtLeast),
      figure("control steps of 20 ms per s of CPU", "",
             Median(steps) * kControls / static_cast<double>(one.Steps())),
      bounded("a robot is made in", "ms", 1e3 * made, 2, Wanted::kAtMost),
      bounded("a robot takes", "MB", taken, 1.5, Wanted::kAtMost),
      bounded("an episode begins in", "ms", 1e3 * Median(begins), 0.3, Wanted::kAtMost)};
  if (Cores() > 1) {
    figures.push_back(bounded("two threads / one", "", Median(gains), 1.9, Wanted::kAtLeast));
  }
  return figures;
}

}  // namespace

std::vector<Figure> MeasureBatch(const BatchEffort& effort) {
  std::vector<Figure> figures;
  for (const Kind& kind : Kinds()) {
    for (Figure& figure : Measure(kind, effort)) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace understudy::bench
