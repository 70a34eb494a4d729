#include "commands/run_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <spdlog/spdlog.h>
#include <unistd.h>

#include "commands/log.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/reference.h"
#include "config/script.h"
#include "control/control_folder.h"
#include "exec/child_process.h"
#include "exec/private_network.h"
#include "robot/errors.h"
#include "run.h"
#include "signals.h"

namespace understudy {
namespace {

void AddRunOptions(CLI::App* app, RunArguments* arguments) {
  app->add_option("robot", arguments->robot, "A robot's name (see `understudy robots`) or its YAML")
      ->required()
      ->type_name("ROBOT");
  AddShortOption(app, arguments, "--interface", "network.interface", "NAME",
                 "Network interface to speak on [lo]");
  AddShortOption(app, arguments, "--domain", "network.domain", "N", "DDS domain [0]");
  AddShortOption(app, arguments, "--scene", "scene", "NAME|FILE",
                 "Ground to stand on: a kind of terrain, MJCF or YAML [flat]");
  AddShortOption(app, arguments, "--model", "robot.model", "FILE",
                 "MJCF to play instead of the robot's own, with the same joint names")
      ->transform([](const std::string& file) { return std::filesystem::absolute(file).string(); });
  AddShortOption(app, arguments, "--revision", "robot.revision", "NAME",
                 "Hardware revision, as `understudy robots` lists them [the robot's own]");
  AddShortOption(app, arguments, "--dynamics", "robot.dynamics.use", "WHOSE",
                 "Joint friction, damping and armature: catalogue, as in the model's file, or "
                 "fitted to real robots [the better evidence; with --model catalogue]");
  AddShortOption(app, arguments, "--speed", "time.speed", "X",
                 "Simulated seconds per wall second; max = as fast as possible [1]")
      ->transform([](const std::string& speed) { return speed == "max" ? "0" : speed; });
  AddShortOption(app, arguments, "--duration", "time.duration", "S",
                 "End after so many simulated seconds [never]");
  AddShortOption(app, arguments, "--start", "start.pose", "POSE",
                 "damped, standing, hanging or clamped [the robot's own]");
  AddShortOption(app, arguments, "--seed", "randomization.seed", "N",
                 "Seed of all that randomization draws [one is drawn and said]");
  app->add_flag_callback(
      "--released",
      [arguments] {
        arguments->sets.insert(arguments->sets.begin(),
                               std::string("motion.service=") + kNoService);
      },
      "Begin as after ReleaseMode: no motion service on, rt/lowcmd moves the motors");
  app->add_option(
         "--script", arguments->script,
         "YAML file of what happens to the robot and when: remote controller, crane, pushes")
      ->type_name("FILE");
  AddSetOptions(app, arguments, "YAML file laid over the robot's own", "gate.timeout=0.5");
  app->add_option("--name", arguments->name, "Name by which `understudy ctl` finds this robot");
  app->add_option("--log-level", arguments->log_level,
                  "debug, info, warn or error [info; exec: warn]")
      ->check(CLI::IsMember({"debug", "info", "warn", "error"}));
  app->add_flag("--print-config", arguments->print_config,
                "Print the configuration in effect as YAML and exit");
  app->add_flag("--help-config", arguments->help_config, "Print every configuration key and exit");
  app->add_flag("--json", arguments->json, "Log as one JSON object a line");
}

Config Load(const RunArguments& arguments) {
  return LoadConfig(
      {.robot = arguments.robot, .files = arguments.config_files, .sets = arguments.sets},
      DataDir());
}

std::vector<ScriptEvent> LoadEvents(const RunArguments& arguments) {
  return arguments.script.empty() ? std::vector<ScriptEvent>() : LoadScript(arguments.script);
}

std::filesystem::path MakeControlSocket(const RunArguments& arguments, const Config& config) {
  MakeControlFolder(ControlFolder());
  return ControlSocket(arguments.name.empty() ? DefaultName(config.robot.name) : arguments.name);
}

}  // namespace

CLI::App* AddRunCommand(CLI::App* app, RunArguments* arguments) {
  CLI::App* run = app->add_subcommand("run", "Play a robot on the network until Ctrl-C");
  AddRunOptions(run, arguments);
  run->footer(
      "Examples:\n"
      "  understudy run go2                        a Go2, lying, on lo and domain 0\n"
      "  understudy run g1 --start clamped         a G1 whose pelvis is held in the air\n"
      "  understudy run g1 --revision 6            the one with a locked waist (mode_machine 6)\n"
      "  understudy run go2 --released             for programs that do not release it themselves\n"
      "  understudy run go2 --speed 0.2            in slow motion\n"
      "  understudy run go2 --set gate=lenient     take commands whose form is wrong\n"
      "  understudy run go2 --scene rough --set terrain.difficulty=0.7\n"
      "In another terminal: understudy ctl status --watch");
  return run;
}

CLI::App* AddExecCommand(CLI::App* app, RunArguments* arguments) {
  CLI::App* exec = app->add_subcommand(
      "exec", "Play a robot in a private network, run a command beside it, exit with its code");
  AddRunOptions(exec, arguments);
  exec->add_option("--network", arguments->network,
                   "private: a network namespace of its own; host: the machine's network")
      ->check(CLI::IsMember({"private", "host"}));
  exec->add_option("command", arguments->command, "The command and its arguments, after --")
      ->type_name("CMD...")
      ->required();
  exec->footer(
      "The command starts when the first LowState is out and finds the robot on domain 0 and lo.\n"
      "Any number of these run side by side; none hears another, nor any real robot.\n"
      "Examples:\n"
      "  understudy exec go2 -- python3 go2_stand_example.py lo\n"
      "  understudy exec g1 --start clamped -- ./g1_ankle_swing_example lo\n"
      "Exits with the command's code, 128+n when signal n ended it, 126 or 127 when it could not\n"
      "be run, or with one of our own codes when the robot could not be played.");
  return exec;
}

int RunCommand(const RunArguments& arguments) {
  if (arguments.help_config) {
    std::fputs(ConfigReference().c_str(), stdout);
    return 0;
  }
  const Config config = Load(arguments);
  if (arguments.print_config) {
    std::fputs(PrintConfig(config, true).c_str(), stdout);
    return 0;
  }
  RunOptions options;
  options.script = LoadEvents(arguments);
  options.control_socket = MakeControlSocket(arguments, config);
  options.status_line = !arguments.json && isatty(STDERR_FILENO) == 1;
  StartLog({.level = arguments.log_level.empty() ? "info" : arguments.log_level,
            .json = arguments.json,
            .status_line = options.status_line});
  options.should_stop = [] { return StopSignal() != 0; };
  CatchStopSignals();
  return static_cast<int>(RunRobot(config, options));
}

int ExecCommand(const RunArguments& arguments) {
  if (arguments.help_config || arguments.print_config) return RunCommand(arguments);
  const Config config = Load(arguments);
  RunOptions options;
  options.script = LoadEvents(arguments);
  if (arguments.network == "private") EnterPrivateNetwork();

  // The command is forked before any thread exists, and runs nothing until the robot is ready.
  const std::filesystem::path control = MakeControlSocket(arguments, config);
  ChildProcess child(arguments.command, {{"UNDERSTUDY_CONTROL", control}});

  StartLog({.level = arguments.log_level.empty() ? "warn" : arguments.log_level,
            .json = arguments.json,
            .status_line = false});
  CatchStopSignals();
  constexpr std::chrono::milliseconds kGrace(500);
  std::optional<int> code;
  bool terminating = false;
  options.control_socket = control;
  options.on_ready = [&child] { child.Release(); };
  options.should_stop = [&] {
    if (StopSignal() != 0 && !terminating) {
      terminating = true;
      child.Terminate(kGrace);  // the robot goes on until the command has ended
    }
    code = child.Poll();
    return code.has_value();
  };
  const ExitCode robot = RunRobot(config, options);
  if (!code) {
    child.Terminate(kGrace);
    code = child.Wait();
  }
  return robot == ExitCode::kOk ? *code : static_cast<int>(robot);
}

}  // namespace understudy
