#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "assembly/command_port.h"
#include "assembly/simulation.h"
#include "base/exit_code.h"
#include "commands/commands.h"
#include "commands/set_options.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "emulator/status.h"
#include "motion/policy_drive.h"

namespace understudy::commands {
namespace {

constexpr double kSunk = 0.5;  // share of the standing height; *assumed*

// The command line.
struct PolicyArguments : SetArguments {
  std::string definition;
  std::string robot;
  double seconds = 5;
  std::vector<double> velocity{0, 0, 0};
};

// How a robot that a policy commands has fared.
struct Trial {
  std::uint64_t taken = 0, refused = 0;  // commands
  double lowest = 0, highest = 0;        // m, height of the base
  robot::DamageTotals damage{};
};

// A humanoid that stands with slack motors falls before the first command: a clamp holds it until
// then.
config::Config StandingConfig(const PolicyArguments& arguments) {
  config::Config config = config::LoadConfig({.robot = arguments.robot,
                                              .files = arguments.config_files,
                                              .sets = arguments.sets,
                                              .typed = arguments.typed},
                                             config::DataDir());
  config::RobotConfig& robot = config.robots[0];
  robot.motion.service = authority::kNoService;
  robot.start.pose = "clamped";
  robot.spec.hanging = robot.spec.standing;
  return config;
}

void PrintDefinition(const policy::Policy& policy, const std::string& robot) {
  const policy::Definition& definition = policy.definition();
  std::printf("%s fits %s\n", definition.name.c_str(), robot.c_str());
  std::printf("network       %td numbers in, %td out, every %g s\n", policy.network().inputs(),
              policy.network().outputs(), static_cast<double>(definition.step_dt));
  std::printf("observations ");
  for (const policy::Term& term : definition.terms) {
    std::printf(" %s %zu%s", std::string(term.row->name).c_str(), Width(term, definition),
                term.history > 1 ? (" x " + std::to_string(term.history)).c_str() : "");
  }
  std::printf("\n%-28s %4s %8s %15s %8s %6s %6s %6s\n", "joint", "slot", "default", "range",
              "scale", "kp", "kd", "N·m");
}

// Prints the joints in the policy's order; returns what does not fit the robot.
std::vector<std::string> CompareJoints(const policy::Policy& policy, const robot::RobotSpec& spec,
                                       const std::vector<std::array<double, 2>>& ranges) {
  const policy::Definition& definition = policy.definition();
  std::vector<std::string> wrong;
  for (std::size_t i = 0; i < policy.targets().size(); ++i) {
    const policy::Target& target = policy.targets()[i];
    const robot::MotorSpec& motor = spec.motors[target.motor];
    const auto& [least, most] = ranges[target.motor];
    const double q = definition.default_q[i];
    const auto action = std::ranges::find(definition.action.joints, i);
    const bool acts = action != definition.action.joints.end();
    const double scale =
        acts ? definition.action
                   .scale[static_cast<std::size_t>(action - definition.action.joints.begin())]
             : 0;
    std::printf("%-28s %4d %8.3f %7.2f %7.2f %8.3f %6g %6g %6g\n", motor.joint.c_str(), motor.slot,
                q, least, most, scale, static_cast<double>(target.kp),
                static_cast<double>(target.kd), motor.torque_limit);
    if (q < least || q > most) {
      wrong.push_back(motor.joint + ": default_joint_pos is outside of the joint's range");
    }
    if (acts && target.kp <= 0) {
      wrong.push_back(motor.joint + ": has an action, and its stiffness is 0");
    }
  }
  return wrong;
}

void Sense(const robot::RobotState& state, motion::PolicyDrive* drive) {
  for (std::size_t i = 0; i < drive->motors(); ++i) {
    drive->Sense(i, state.motors[i].q, state.motors[i].dq);
  }
  drive->Sense(state.imu.R_WI, state.imu.w_WI_I);
}

// Lets the policy command the robot by LowCmds, as a program does.
Trial Try(const PolicyArguments& arguments, motion::PolicyDrive* drive, assembly::CommandPort* port,
          assembly::Simulation* simulation) {
  const double period = drive->policy().definition().step_dt;
  const auto steps = static_cast<int>(std::lround(period / simulation->config().physics.timestep));
  const physics::RobotBody& body = simulation->world().physics().robot(0);
  simulation->Step();
  Sense(port->lowstate(), drive);
  drive->Ask({arguments.velocity[0], arguments.velocity[1], arguments.velocity[2]});
  drive->Begin();
  simulation->Request("clamp", {{"on", false}});
  Trial trial{.lowest = body.base().p_WB.z(), .highest = body.base().p_WB.z()};
  robot::RobotCommand command{.motors = std::vector<robot::MotorCommand>(drive->motors())};
  while (simulation->world().time() < arguments.seconds) {
    drive->Step(period, &command);
    port->Give(robot::kLowCmdTopic, command);
    simulation->Step(steps);
    Sense(port->lowstate(), drive);
    trial.lowest = std::min(trial.lowest, body.base().p_WB.z());
    trial.highest = std::max(trial.highest, body.base().p_WB.z());
  }
  emulator::Status status;
  simulation->world().robot(0).Report(simulation->world().time(), &status);
  trial.taken = status.commands.accepted;
  const auto& refused = status.commands.refused;
  trial.refused = std::accumulate(refused.begin(), refused.end(), std::uint64_t{0});
  trial.damage = simulation->world().robot(0).damage();
  return trial;
}

void Print(const Trial& trial, const robot::RobotSpec& spec) {
  const robot::DamageTotals& damage = trial.damage;
  std::printf(
      "%.1f s: %llu commands taken, %llu refused; tilt at most %.1f deg, height %.2f to "
      "%.2f m\n",
      damage.time, static_cast<unsigned long long>(trial.taken),
      static_cast<unsigned long long>(trial.refused), damage.worst_tilt * 180 / M_PI, trial.lowest,
      trial.highest);
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const robot::MotorDamage& motor = damage.motors[i];
    if (motor.at_torque_limit > 0 || motor.hardest_stop > 0) {
      std::printf("%-28s %.2f s at its torque limit, meets its stop at %.1f rad/s\n",
                  spec.motors[i].joint.c_str(), motor.at_torque_limit, motor.hardest_stop);
    }
  }
}

int CheckPolicy(const PolicyArguments& arguments) {
  const config::Config config = StandingConfig(arguments);
  const robot::RobotSpec& spec = config.robots[0].spec;
  motion::PolicyDrive drive(spec, arguments.definition);
  assembly::CommandPort port(spec, config.physics.timestep);
  assembly::Simulation simulation(config, [&](std::size_t) { return emulator::Ports{&port}; });
  PrintDefinition(drive.policy(), spec.name);
  std::vector<std::string> wrong =
      CompareJoints(drive.policy(), spec, simulation.world().physics().robot(0).ranges());
  if (wrong.empty()) {
    const Trial trial = Try(arguments, &drive, &port, &simulation);
    Print(trial, spec);
    if (trial.refused > 0) wrong.emplace_back("commands were refused");
    if (trial.damage.falls > 0) wrong.emplace_back("the robot fell");
    if (trial.lowest < kSunk * spec.standing.height) wrong.emplace_back("the robot sank down");
  }
  for (const std::string& what : wrong) std::printf("wrong: %s\n", what.c_str());
  return static_cast<int>(wrong.empty() ? ExitCode::kOk : ExitCode::kFailed);
}

}  // namespace

void AddPolicyCommand(CLI::App* app, Chosen* chosen) {
  CLI::App* group = app->add_subcommand("policy", "Look at a trained policy");
  group->require_subcommand(1);
  group->footer("Example: understudy policy check walk/deploy.yaml --robot go2");
  const auto arguments = std::make_shared<PolicyArguments>();
  CLI::App* check = group->add_subcommand(
      "check", "Hold a policy against a robot, then let it stand or walk in this process");
  check->add_option("definition", arguments->definition, "The policy's deploy.yaml")
      ->required()
      ->type_name("FILE");
  check->add_option("--robot", arguments->robot, "A robot's name or its YAML")
      ->required()
      ->type_name("ROBOT");
  check->add_option("--seconds", arguments->seconds, "Simulated time of the trial [5]")
      ->check(CLI::Range(0.1, 3600.0))
      ->type_name("S");
  check
      ->add_option("--velocity", arguments->velocity,
                   "Commanded velocity: forward, left m/s, turn rad/s [0 0 0]")
      ->expected(3)
      ->type_name("VX VY WZ");
  AddSetOptions(check, arguments.get(), "YAML file, as for a run", "terrain.friction=0.4");
  check->footer(
      "Compares widths, order of joints, default angles and gains with the robot, and refuses "
      "what\n"
      "does not fit before anything moves. Then the robot stands, and the policy commands it by\n"
      "LowCmds.\n"
      "Example:\n"
      "  understudy policy check walk/deploy.yaml --robot go2 --velocity 0.5 0 0\n"
      "Exits with 3 if files or widths do not fit, with 10 if something else is wrong: an angle\n"
      "out of range, a refused command, a fall.");
  check->callback([=] { *chosen = [=] { return CheckPolicy(*arguments); }; });
}

}  // namespace understudy::commands
