#include <algorithm>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>

#include <spdlog/spdlog.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/signals.h"
#include "bus/interfaces.h"
#include "commands/browser.h"
#include "commands/commands.h"
#include "commands/companion.h"
#include "commands/control_place.h"
#include "commands/detach.h"
#include "commands/log.h"
#include "commands/run_options.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/reference.h"
#include "exec/child_process.h"
#include "exec/program_output.h"
#include "exec/robot_address.h"
#include "objects/object_kinds.h"
#include "remote/arguments.h"
#include "run/run.h"
#include "script/script.h"
#include "viewer/arguments.h"

namespace understudy::commands {
namespace {

constexpr std::size_t kMostRobots = 16;  // *assumed*: the numbers of requests and events hold 255

config::Config Load(const RunArguments& arguments) {
  return config::LoadConfig({.robot = arguments.robots.front(),
                             .others = {arguments.robots.begin() + 1, arguments.robots.end()},
                             .files = arguments.config_files,
                             .sets = arguments.sets,
                             .typed = arguments.typed},
                            config::DataDir());
}

script::Script LoadScript(const RunArguments& arguments, const config::Config& config) {
  if (arguments.script.empty()) return {};
  std::vector<signals::Names> names;
  for (const config::RobotConfig& robot : config.robots) {
    signals::Names& one = names.emplace_back(signals::RunningNames(robot.spec));
    one.program = !arguments.command.empty();
    one.robot = robot.name;
    one.objects = objects::MovingNamesOf(config.objects);
  }
  return script::LoadScript(arguments.script, signals::Joined(std::move(names)));
}

void SayWhatIsMissing(const std::string& panel) {
  if (!panel.empty()) spdlog::info("there is no panel: {}", panel);
}

run::RecordingOptions RecordingOf(const RunArguments& arguments) {
  return {.file = arguments.record, .overwrite = arguments.overwrite};
}

// Forks the companions before any thread exists; they start at Release().
std::deque<CompanionProcess> CompanionsOf(const RunArguments& arguments,
                                          const std::string& socket) {
  std::deque<CompanionProcess> companions;
  if (arguments.view) {
    companions.emplace_back("the window", "understudy-view", viewer::kViewerMissing,
                            std::vector<std::string>{"view", "--socket", socket});
  }
  if (arguments.gamepad) {
    companions.emplace_back(
        "the gamepad's program", "understudy-remote", remote::kRemoteMissing,
        std::vector<std::string>{"remote", "--no-keyboard", "--socket", socket});
  }
  return companions;
}

// The card that gets the robot's address. Throws ConfigError and BusError.
std::string CardOf(const config::Config& config) {
  if (config.robots.size() > 1) {
    throw ConfigError("--as-robot: there are several robots, and the address is of one");
  }
  const std::string& interface = config.robots.front().network.interface;
  if (interface == config::NetworkConfig{}.interface) {
    throw ConfigError("network.interface: '" + interface +
                      "', and --as-robot needs the card that the program's computer is at, as in "
                      "--interface eth0");
  }
  return bus::FindCard(interface).name;
}

// Throw SetupError. ExecCommand returns the exit code of the command.
int RunCommand(const RunArguments& arguments) {
  if (arguments.help_config) {
    std::fputs(config::ConfigReference().c_str(), stdout);
    return 0;
  }
  const config::Config config = Load(arguments);
  if (arguments.print_config) {
    std::fputs(config::PrintConfig(config, true).c_str(), stdout);
    return 0;
  }
  run::RunOptions options;
  options.script = LoadScript(arguments, config);
  options.recording = RecordingOf(arguments);
  std::optional<Background> background;
  if (arguments.detach) {
    background.emplace(
        Detach([&] { return ControlName(arguments.name, config, config.robots.front()); }));
  }
  if (background) options.log = background->log();
  ControlPlace place(arguments.name, config);
  place.AddPanels(config);
  options.access = place.access();
  options.status_line = !arguments.json && isatty(STDERR_FILENO) == 1;
  std::deque<CompanionProcess> companions = CompanionsOf(arguments, place.socket());
  StartLog({.level = arguments.log_level.empty() ? "info" : arguments.log_level,
            .json = arguments.json,
            .status_line = options.status_line});
  SayWhatIsMissing(place.missing());
  CatchStopSignals();
  std::optional<exec::RobotAddress> address;
  if (arguments.as_robot) address.emplace(CardOf(config));
  std::optional<Browser> browser;
  if (arguments.open) {
    browser.emplace(std::filesystem::path(place.socket()).replace_extension(".html"));
  }
  options.on_ready = [&](const std::string& url) {
    for (CompanionProcess& companion : companions) companion.Release();
    if (browser) browser->Open(url);
    if (background) background->Ready();
  };
  options.should_stop = [&companions, &browser](std::int64_t, emulator::EventRing*) {
    for (CompanionProcess& companion : companions) companion.Watch();
    if (browser) browser->Watch();
    return StopSignal() != 0;
  };
  return static_cast<int>(run::RunWorld(config, options));
}

int ExecCommand(RunArguments arguments) {
  if (arguments.help_config || arguments.print_config) return RunCommand(arguments);
  run::RunOptions options;
  std::optional<SimulatedClock> clock;
  if (arguments.clock.simulated()) {
    RequireTakesClock(arguments.command);
    const double think = ThinkFor(arguments.clock);
    clock.emplace(think);
    options.recording.late_messages = think > 0;
    if (Measures()) arguments.record = "", arguments.view = arguments.gamepad = false;
  }
  config::Config config = Load(arguments);
  options.script = LoadScript(arguments, config);
  options.recording.file = arguments.record;
  options.recording.overwrite = arguments.overwrite;
  // The panels listen in the machine's network, where the browser is.
  ControlPlace place(arguments.name, config);
  place.AddPanels(config);
  options.access = place.access();
  const std::filesystem::path& control = place.socket();
  RunNetwork network(arguments.network, &config);
  options.private_network = network.is_private();

  exec::ChildProcess::Environment environment = place.environment();
  if (clock) {
    clock->Start(config.time.realtime);
    clock->AddTo(&environment);
    options.programs = clock->coordinator();
  }

  // The command is forked before any thread exists and waits until the robot is ready.
  const std::vector<std::string> printed = signals::PrintedTexts(options.script.conditions.signals);
  std::optional<exec::ProgramOutput> output;
  if (!printed.empty()) output.emplace(printed);
  exec::ChildProcess child(arguments.command, environment, -1, output ? output->descriptor() : -1,
                           network.program_rights());
  network.Settle();
  if (arguments.clock.trace) clock->Trace();
  std::deque<CompanionProcess> companions = CompanionsOf(arguments, control);
  StartLog({.level = arguments.log_level.empty() ? "warn" : arguments.log_level,
            .json = arguments.json,
            .status_line = false});
  SayWhatIsMissing(place.missing());
  CatchStopSignals();
  // The command starts when the robot is ready; its end ends the run.
  constexpr std::chrono::milliseconds kGrace(500);
  std::optional<int> code;
  bool terminating = false;
  options.on_ready = [&](const std::string&) {
    if (output) output->Start();
    child.Release();
    if (clock) clock->coordinator()->ProgramStarts();
    for (CompanionProcess& companion : companions) companion.Release();
  };
  options.should_stop = [&](std::int64_t, emulator::EventRing* events) {
    for (CompanionProcess& companion : companions) companion.Watch();
    if (output) {
      output->TakeFound([events](const std::string& text) {
        events->Add(emulator::EventKind::kProgramPrints, 0, {}, text);
      });
    }
    const bool off_clock = clock && clock->coordinator()->program_is_missing();
    if ((StopSignal() != 0 || off_clock) && !terminating) {
      terminating = true;
      child.Terminate(kGrace);  // the robot runs until the command has ended
    }
    code = child.Poll();
    return code.has_value();
  };
  const ExitCode robot = run::RunWorld(config, options);
  if (!code) {
    child.Terminate(kGrace);
    code = child.Wait();
  }
  if (clock) {
    clock->RequireProgram(arguments.command);
    clock->TellComputed();
  }
  return robot == ExitCode::kOk ? *code : static_cast<int>(robot);
}

void RequireFewRobots(const std::vector<std::string>& robots) {
  if (robots.size() <= kMostRobots) return;
  throw CLI::ValidationError("robot", "expected " + std::to_string(kMostRobots) + " at most, got " +
                                          std::to_string(robots.size()));
}

// CLI11 gives the robots all words. Those after -- are the command; without it, those after the
// first.
void SplitCommand(std::size_t after_dashes, RunArguments* arguments) {
  std::vector<std::string>& words = arguments->robots;
  const std::size_t robots =
      after_dashes > 0 ? words.size() - std::min(after_dashes, words.size()) : 1;
  if (robots == 0) throw CLI::RequiredError("robot");
  if (robots >= words.size()) throw CLI::RequiredError("command");
  const auto command = words.begin() + static_cast<std::ptrdiff_t>(robots);
  arguments->command.assign(command, words.end());
  words.erase(command, words.end());
}

}  // namespace

void AddRunCommands(CLI::App* app, Chosen* chosen, const std::size_t* after_dashes) {
  const auto run_arguments = std::make_shared<RunArguments>();
  CLI::App* run = app->add_subcommand("run", "Simulate a robot on the network until Ctrl-C");
  AddRunOptions(run, run_arguments.get());
  run->add_flag(
      "--gamepad", run_arguments->gamepad,
      "Use a gamepad as the remote controller, as `understudy remote --no-keyboard` does");
  run->add_flag("--open", run_arguments->open,
                "Open the panel in a browser by xdg-open; where that fails, print its address");
  run->add_flag(
      "--detach", run_arguments->detach,
      "Return when the robot is ready and let it run in the background; see ctl log, ctl stop");
  run->add_flag("--as-robot", run_arguments->as_robot,
                "Give the interface the robot's address, 192.168.123.161, until the run ends; as "
                "root, for a program on another computer");
  run->footer(
      "Examples:\n"
      "  understudy run go2                        a Go2, which stands up, on lo and domain 0\n"
      "  understudy run g1 --start clamped         a G1 whose pelvis is fixed in the air\n"
      "  understudy run g1 --revision 6            the one with a locked waist (mode_machine 6)\n"
      "  understudy run go2 --released             for programs that do not call ReleaseMode\n"
      "  understudy run go2 --speed 0.2            in slow motion\n"
      "  understudy run go2 --detach               in the background; ctl log --follow, ctl stop\n"
      "  understudy run go2 --view                 with a window to look at it and push it\n"
      "  understudy run go2 --set gate=lenient     take commands whose form is wrong\n"
      "  understudy run go2 --interface eth0 --as-robot   for the computer at that card's cable\n"
      "  understudy run go2 --record walk.mcap     all topics, truth and events: "
      "docs/recording.md\n"
      "  understudy run go2 --scene rough --set terrain.difficulty=0.7\n"
      "Robots named together share a world, on domains 0, 1 ...: docs/reference/several.md\n"
      "In another terminal: understudy ctl status --watch");
  run->callback([=] {
    RequireFewRobots(run_arguments->robots);
    *chosen = [=] { return RunCommand(*run_arguments); };
  });

  const auto exec_arguments = std::make_shared<RunArguments>();
  CLI::App* exec = app->add_subcommand(
      "exec", "Simulate a robot in a private network, run a command with it, exit with its code");
  AddRunOptions(exec, exec_arguments.get());
  AddNetworkOptions(exec, &exec_arguments->network);
  AddClockOptions(exec, &exec_arguments->clock);
  exec->get_option("--interface-name")->excludes(exec->get_option("--interface"));
  exec->add_option("command", exec_arguments->command, "The command and its arguments, after --")
      ->type_name("CMD...");
  exec->footer(
      "The command starts after the first LowState and finds the robot on domain 0 and lo.\n"
      "Many programs take lo for a simulation and omit what they do on a robot, or have the\n"
      "name of a network card in their source: --interface-name gives them a card of that name\n"
      "with multicast and the address 192.168.123.99/24; the robot is at the other end of its\n"
      "cable and has 192.168.123.161. docs/network.md has more.\n"
      "Any number of these can run side by side, isolated from each other and from real robots.\n"
      "Examples:\n"
      "  understudy exec go2 -- python3 go2_stand_example.py lo\n"
      "  understudy exec go2 --interface-name eth0 -- python3 go2_stand_example.py eth0\n"
      "  understudy exec g1 --start clamped -- ./g1_ankle_swing_example lo\n"
      "  understudy exec go2 --clock simulated -- python3 walk.py lo     docs/clock.md\n"
      "Robots named together share a world, on domains 0, 1 ...: docs/reference/several.md\n"
      "Exits with the command's code, 128+n if signal n ended it, 126 or 127 if it could not\n"
      "be run, or with one of Understudy's codes if the robot could not be started.");
  exec->callback([=] {
    RequireConsistent(exec_arguments->network);
    RequireConsistent(exec_arguments->clock, exec_arguments->network);
    if (exec_arguments->clock.simulated()) {  // unless --speed says otherwise
      exec_arguments->sets.insert(exec_arguments->sets.begin(), "time.speed=0");
    }
    SplitCommand(*after_dashes, exec_arguments.get());
    RequireFewRobots(exec_arguments->robots);
    *chosen = [=] { return ExecCommand(*exec_arguments); };
  });
}

}  // namespace understudy::commands
