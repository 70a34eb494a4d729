#include "walking.h"

#include <cmath>
#include <memory>

#include "assembly/simulation.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "motion/quadruped/figures.h"
#include "motion/quadruped/motion.h"
#include "process.h"

namespace understudy::bench {
namespace {

constexpr double kWarmUp = 2;                 // s
constexpr double kAhead = 0.5, kAside = 0.3;  // of the sticks, -1 to 1

double WantedCost(const std::string& robot) { return robot == "go2" ? 40 : 50; }  // µs per ms

}  // namespace

std::vector<Figure> MeasureWalking(const std::string& robot, double seconds) {
  const config::Config config = config::LoadConfig(
      {.robot = robot, .files = {}, .sets = {"start.pose=standing"}}, config::DataDir());
  if (!robot::IsQuadruped(config.robots[0].spec.kind)) return {};
  assembly::Simulation alone(config);
  const auto motion = std::make_unique<motion::QuadrupedMotion>(
      config.robots[0].spec, motion::ReadQuadruped(alone.world().physics().robot()));
  robot::RobotCommand command;
  command.motors.resize(config.robots[0].spec.motors.size());
  const double dt = 1 / config.robots[0].spec.rates.service_hz;
  const double timestep = alone.world().physics().timestep();
  const long between = std::lround(dt / timestep);
  const long settled = std::lround(kWarmUp / timestep);
  const long steps = settled + std::lround(seconds / timestep);
  alone.Request("remote.sticks", {{"ly", kAhead}, {"lx", -kAside}});
  const authority::goal::Move move{.vx = kAhead * config.robots[0].spec.remote.speed[0],
                                   .vy = kAside * config.robots[0].spec.remote.speed[1],
                                   .yaw_rate = 0,
                                   .hold = 1,
                                   .by_sticks = true};
  double cpu = 0;
  for (long i = 0; i < steps; ++i) {
    alone.Step();
    if (i % between != 0) continue;
    const robot::RobotState& said = alone.world().robot(0).sampled();
    const authority::MotionInput input{.time = alone.world().time(),
                                       .motors = said.motors,
                                       .imu = said.imu,
                                       .foot_force = said.foot_force};
    if (i == 0) motion->Start(input);
    motion->Ask(move);
    const double before = ThreadCpu();
    motion->Step(input, dt, &command);
    if (i >= settled) cpu += ThreadCpu() - before;
  }
  return {{.robot = robot,
           .name = "motion service, walking, CPU per simulated ms",
           .unit = "µs",
           .value = 1e3 * cpu / seconds,
           .bound = WantedCost(robot)}};
}

}  // namespace understudy::bench
