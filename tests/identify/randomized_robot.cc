#include "tests/identify/randomized_robot.h"

#include "assembly/simulation.h"
#include "config/load.h"
#include "physics/bench.h"
#include "tests/support/fake_port.h"
#include "tests/support/fake_services.h"

namespace understudy::identify {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

config::Config ConfigOf(const std::string& robot, std::vector<std::string> sets) {
  sets.insert(sets.end(), {"start.pose=clamped", "motion.service=none"});
  return config::LoadConfig({.robot = robot, .files = {}, .trees = {}, .sets = std::move(sets)},
                            kRoot);
}

}  // namespace

config::Config Known(const std::string& robot) { return ConfigOf(robot, {}); }

Replay ReplayOf(const config::Config& config) {
  return {{.spec = config.robots[0].spec, .file = kRoot / "models" / config.robots[0].spec.model},
          kRoot / "models" / "scene" / "flat.xml",
          config.physics.timestep,
          2};
}

Identification IdentifiedBy(const Drawn& drawn, const Options& options, bool by_joint) {
  const config::Config known = Known("go2");
  const Replay replay = ReplayOf(known);
  const Basis basis(known.robots[0].spec, replay.bench(), by_joint);
  return *Identify(replay, basis, {&drawn.samples, 1}, {}, options,
                   {.line = [](const std::string&) {}, .progress = [](int, int) {}});
}

Drawn Draw(const std::string& robot, int seed, const ExcitationSpec& excitation) {
  test::FakePort port;
  test::FakeServices services;
  assembly::Simulation simulation(
      ConfigOf(robot,
               {"randomization.seed=" + std::to_string(seed), "randomization.armature=[0.7, 1.5]",
                "randomization.damping=[0.6, 1.6]", "randomization.frictionloss=[0.7, 1.4]",
                "randomization.delay=[0, 0.004]", "sensors.seed=" + std::to_string(seed)}),
      [&](std::size_t) {
        return emulator::Ports{&port, &services};
      });
  const config::Config& config = simulation.config();
  const config::Config known = Known(robot);
  const physics::Bench bench(
      {.spec = known.robots[0].spec, .file = kRoot / "models" / known.robots[0].spec.model},
      kRoot / "models" / "scene" / "flat.xml", known.physics.timestep);
  Drawn drawn{.samples = {.file = "drawn " + std::to_string(seed)}};
  const std::vector<robot::MotorSpec>& motors = config.robots[0].spec.motors;
  for (const robot::Drawn& one : simulation.draws().values) {
    if (one.quantity == "delay") {  // acts in whole steps
      const double steps =
          std::round(config.robots[0].spec.dynamics.delay / config.physics.timestep);
      drawn.truth["delay"] = steps * config.physics.timestep;
    }
    for (std::size_t i = 0; i < motors.size(); ++i) {
      if (motors[i].joint != one.element) continue;
      const physics::JointFigures joint = bench.Joint(i);
      const double figure = one.quantity == "armature"  ? joint.armature
                            : one.quantity == "damping" ? joint.damping
                                                        : joint.frictionloss;
      const std::string name = one.element.substr(0, one.element.size() - 6);
      drawn.truth[one.quantity + " " + name] = one.value * figure;
    }
  }

  const emulator::World& world = simulation.world();
  const physics::RobotBody& body = world.physics().robot();
  const Excitation program(config.robots[0].spec, excitation, body.q(), body.ranges());
  const auto ticks = std::lround(program.seconds() / config.physics.timestep);
  for (long i = 0; i < ticks; ++i) {
    const double t = static_cast<double>(i) * config.physics.timestep;
    if (i % 2 == 0) {
      port.Send(program.At(t));
      drawn.samples.command_times.push_back(t);
      drawn.samples.commands.push_back(program.At(t));
    }
    simulation.Step();
  }
  drawn.samples.q.resize(static_cast<Eigen::Index>(motors.size()),
                         static_cast<Eigen::Index>(port.samples().size()));
  for (Eigen::Index i = 0; i < drawn.samples.q.cols(); ++i) {
    const robot::RobotState& state = port.samples()[static_cast<std::size_t>(i)].state;
    drawn.samples.times.push_back(1e-3 * static_cast<double>(state.tick_ms));
    for (Eigen::Index j = 0; j < drawn.samples.q.rows(); ++j) {
      drawn.samples.q(j, i) = state.motors[static_cast<std::size_t>(j)].q;
    }
  }
  return drawn;
}

}  // namespace understudy::identify
