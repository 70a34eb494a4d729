// Command line -> configuration -> run. The only place that catches, and that picks the exit code.
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "commands/completions.h"
#include "commands/inspect_commands.h"
#include "commands/log.h"
#include "commands/missing_command.h"
#include "commands/run_command.h"
#include "commands/terrain_command.h"
#include "config/data_dir.h"
#include "config/robot_file.h"
#include "control/control_error.h"
#include "control/ctl_command.h"
#include "exec/command.h"
#include "exit_code.h"
#include "robot/errors.h"
#include "services/robot_services.h"
#include "version.h"

namespace understudy {
namespace {

constexpr char kFooter[] =
    "First steps:\n"
    "  understudy run go2                      play a Go2 on lo, domain 0\n"
    "  understudy exec go2 -- python3 prog.py  play one for the time of a program\n"
    "  understudy ctl status --watch           look at it from another terminal\n"
    "`understudy COMMAND --help` tells more.\n"
    "Exit codes: 0 done; 1 a bug, or an order refused; 2 command line; 3 configuration; 4 model;\n"
    "5 network; 6 another robot is on the network; 7 the physics diverged;\n"
    "8 the robot's name is in use, or its control socket not to be had; exec: the command's own.";

int Main(int argc, char** argv) {
  CLI::App app(
      "Understudy plays a Unitree robot: programs written with Unitree SDK 2 run against it\n"
      "without a change.",
      "understudy");
  app.footer(kFooter);
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("understudy ") + kVersion);
  std::function<int()> chosen;

  RunArguments run_arguments, exec_arguments;
  AddRunCommand(&app, &run_arguments)->callback([&] {
    chosen = [&] { return RunCommand(run_arguments); };
  });
  AddExecCommand(&app, &exec_arguments)->callback([&] {
    chosen = [&] { return ExecCommand(exec_arguments); };
  });
  CtlCommand ctl(&app, &std::cout);
  TerrainArguments terrain_arguments;
  AddTerrainCommand(&app, &terrain_arguments)->callback([&] {
    chosen = [&] { return TerrainCommand(terrain_arguments); };
  });

  bool json = false;
  CLI::App* robots = app.add_subcommand("robots", "List the robots that can be played");
  robots->add_flag("--json", json, "As a JSON array");
  robots->footer(
      "Example: understudy robots --json\n"
      "A robot of your own: understudy run my_robot.yaml, checked by understudy check.");
  robots->callback([&] { chosen = [&] { return RobotsCommand(json); }; });

  std::vector<std::string> files;
  CLI::App* check =
      app.add_subcommand("check", "Check robot descriptions (.yaml) and models (.xml)");
  check->add_option("files", files, "Files to check")->required()->type_name("FILE...");
  check->add_flag("--json", json, "As a JSON array");
  check->footer(
      "Example: understudy check my_robot.yaml my_robot.xml\n"
      "Exits with 3 or 4, as `run` would, when a file is unsound.");
  check->callback([&] { chosen = [&] { return CheckCommand(files, json); }; });

  CLI::App* version = app.add_subcommand("version", "Say which version this is");
  version->add_flag("--json", json, "As a JSON object");
  version->footer("Example: understudy version --json");
  version->callback([&] { chosen = [&] { return VersionCommand(json); }; });

  CLI::App* services =
      app.add_subcommand("services", "Print what every robot's services answer, as Markdown");
  services->footer("Example: understudy services > docs/services.md");
  services->callback([&] {
    chosen = [&] {
      std::fputs(ServicesReference().c_str(), stdout);
      return 0;
    };
  });

  std::string shell;
  CLI::App* completions = app.add_subcommand("completions", "Print completions for a shell");
  completions->add_option("shell", shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completions->footer(
      "Examples:\n"
      "  understudy completions bash > ~/.local/share/bash-completion/completions/understudy\n"
      "  understudy completions fish > ~/.config/fish/completions/understudy.fish\n"
      "  source <(understudy completions zsh)          in ~/.zshrc");
  completions->callback([&] {
    chosen = [&] {
      std::fputs(Completions(app, shell, RobotNames(DataDir())).c_str(), stdout);
      return 0;
    };
  });

  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (argc == 1) {
      std::fputs(app.help().c_str(), stderr);
    } else if (const std::string missing = MissingCommand(app, argc, argv); !missing.empty()) {
      std::fprintf(stderr, "%s\nRun with --help for more information.\n", missing.c_str());
    } else {
      app.exit(error);
    }
    return static_cast<int>(ExitCode::kUsage);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  if (!ctl.chosen()) return chosen();
  ctl.Run();
  return 0;
}

// A standard stream that our caller closed would give its number to the next socket, and the log
// would be written into that.
void OpenClosedStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is this stream's, as those below it are open by now.
    if (::fcntl(stream, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
  }
}

int Fail(const std::exception& error, ExitCode code) {
  std::fprintf(stderr, "understudy: %s\n", error.what());
  return static_cast<int>(code);
}

}  // namespace
}  // namespace understudy

int main(int argc, char** argv) {
  using understudy::ExitCode;
  using understudy::Fail;
  understudy::OpenClosedStreams();
  int code = 0;
  try {
    code = understudy::Main(argc, argv);
  } catch (const understudy::ConfigError& error) {
    code = Fail(error, ExitCode::kConfig);
  } catch (const understudy::ModelError& error) {
    code = Fail(error, ExitCode::kModel);
  } catch (const understudy::BusError& error) {
    code = Fail(error, ExitCode::kBus);
  } catch (const understudy::NeighbourError& error) {
    code = Fail(error, ExitCode::kNeighbour);
  } catch (const understudy::SocketError& error) {
    code = Fail(error, ExitCode::kSocket);
  } catch (const understudy::CommandError& error) {
    std::fprintf(stderr, "understudy: %s\n", error.what());
    code = error.exit_code();
  } catch (const std::exception& error) {
    code = Fail(error, ExitCode::kInternal);
  }
  understudy::StopLog();
  return code;
}
