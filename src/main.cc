// Command line -> configuration -> run.
#include <cstdio>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>

#include "base/catch_errors.h"
#include "base/exit_code.h"
#include "base/standard_error.h"
#include "commands/companion.h"
#include "commands/completions.h"
#include "commands/inspect_commands.h"
#include "commands/log.h"
#include "commands/missing_command.h"
#include "commands/play_command.h"
#include "commands/plot_command.h"
#include "commands/recording_command.h"
#include "commands/run_command.h"
#include "commands/terrain_command.h"
#include "config/data_dir.h"
#include "config/robot_file.h"
#include "ctl/command.h"
#include "remote/arguments.h"
#include "server/request_docs.h"
#include "version.h"
#include "viewer/arguments.h"

namespace understudy {
namespace {

constexpr char kFooter[] =
    "First steps:\n"
    "  understudy run go2                      play a Go2 on lo, domain 0\n"
    "  understudy exec go2 -- python3 prog.py  play one for the time of a program\n"
    "  understudy ctl status --watch           look at it from another terminal\n"
    "  understudy view                         look at it in a window\n"
    "  understudy remote                       hold its remote controller\n"
    "`understudy COMMAND --help` tells more.\n"
    "Exit codes: 0 done; 1 a bug, or a request refused; 2 command line; 3 configuration; 4 model;\n"
    "5 network; 6 another robot is on the network; 7 the physics diverged;\n"
    "8 the robot's name is in use, or its control socket not to be had; 9 a recording that cannot\n"
    "be written or read; exec: the command's own.";

int Main(int argc, char** argv) {
  CLI::App app(
      "Understudy plays a Unitree robot: programs written with Unitree SDK 2 run against it\n"
      "without a change.",
      "understudy");
  app.footer(kFooter);
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("understudy ") + kVersion);
  std::function<int()> chosen;

  commands::RunArguments run_arguments, exec_arguments;
  commands::AddRunCommand(&app, &run_arguments)->callback([&] {
    chosen = [&] { return commands::RunCommand(run_arguments); };
  });
  commands::AddExecCommand(&app, &exec_arguments)->callback([&] {
    chosen = [&] { return commands::ExecCommand(exec_arguments); };
  });
  ctl::CtlCommand ctl(&app, &std::cout);
  commands::TerrainArguments terrain_arguments;
  commands::AddTerrainCommand(&app, &terrain_arguments)->callback([&] {
    chosen = [&] { return commands::TerrainCommand(terrain_arguments); };
  });

  viewer::ViewArguments view;
  viewer::SnapshotArguments snapshot;
  viewer::FilmArguments film;
  remote::RemoteArguments remote;
  constexpr char kView[] = "understudy-view";
  const commands::Companion companions[] = {
      {viewer::AddViewCommand(&app, &view), kView, viewer::kViewerMissing},
      {viewer::AddSnapshotCommand(&app, &snapshot), kView, viewer::kViewerMissing},
      {viewer::AddFilmCommand(&app, &film), kView, viewer::kViewerMissing},
      {remote::AddRemoteCommand(&app, &remote), "understudy-remote", remote::kRemoteMissing},
  };

  commands::PlayArguments play_arguments;
  commands::AddPlayCommand(&app, &play_arguments)->callback([&] {
    chosen = [&] { return commands::PlayCommand(play_arguments); };
  });
  commands::PlotArguments plot_arguments;
  commands::AddPlotCommand(&app, &plot_arguments)->callback([&] {
    chosen = [&] { return commands::PlotCommand(plot_arguments); };
  });

  bool json = false;
  std::string recording_file;
  CLI::App* recording = app.add_subcommand("recording", "Say what a recording holds");
  recording->add_option("file", recording_file, "The recording, MCAP")
      ->required()
      ->type_name("FILE");
  recording->add_flag("--json", json, "As a JSON object");
  recording->footer(
      "Examples:\n"
      "  understudy recording walk.mcap         topics, counts, duration, robot\n"
      "  understudy recording walk.mcap --json\n"
      "A recording is made by understudy run ROBOT --record FILE.mcap.");
  recording->callback(
      [&] { chosen = [&] { return commands::RecordingCommand(recording_file, json); }; });

  CLI::App* robots = app.add_subcommand("robots", "List the robots that can be played");
  robots->add_flag("--json", json, "As a JSON array");
  robots->footer(
      "Example: understudy robots --json\n"
      "A robot of your own: understudy run my_robot.yaml, checked by understudy check.");
  robots->callback([&] { chosen = [&] { return commands::RobotsCommand(json); }; });

  std::vector<std::string> files;
  CLI::App* check =
      app.add_subcommand("check", "Check robot descriptions (.yaml) and models (.xml)");
  check->add_option("files", files, "Files to check")->required()->type_name("FILE...");
  check->add_flag("--json", json, "As a JSON array");
  check->footer(
      "Example: understudy check my_robot.yaml my_robot.xml\n"
      "Exits with 3 or 4, as `run` would, when a file is unsound.");
  check->callback([&] { chosen = [&] { return commands::CheckCommand(files, json); }; });

  CLI::App* version = app.add_subcommand("version", "Say which version this is");
  version->add_flag("--json", json, "As a JSON object");
  version->footer("Example: understudy version --json");
  version->callback([&] { chosen = [&] { return commands::VersionCommand(json); }; });

  CLI::App* services =
      app.add_subcommand("services", "Print what every robot's services answer, as Markdown");
  services->footer("Example: understudy services > docs/services.md");
  services->callback([&] { chosen = [&] { return commands::ServicesCommand(); }; });

  CLI::App* requests = app.add_subcommand(
      "requests", "Print what can be asked of a running robot, as Markdown or for OpenAPI");
  bool openapi = false;
  requests->add_flag("--openapi", openapi, "The paths of docs/openapi.yaml");
  requests->footer("Example: understudy requests > docs/requests.md");
  requests->callback([&] {
    chosen = [&] {
      const std::string text = openapi ? server::RequestsOpenApi() : server::RequestsReference();
      std::fputs(text.c_str(), stdout);
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
      std::fputs(commands::Completions(app, shell, config::RobotNames(config::DataDir())).c_str(),
                 stdout);
      return 0;
    };
  });

  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (argc == 1) {
      std::fputs(app.help().c_str(), stderr);
    } else if (const std::string missing = commands::MissingCommand(app, argc, argv);
               !missing.empty()) {
      std::fprintf(stderr, "%s\nRun with --help for more information.\n", missing.c_str());
    } else {
      app.exit(error);
    }
    return static_cast<int>(ExitCode::kUsage);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  for (const commands::Companion& companion : companions) {
    if (companion.command->parsed()) commands::BecomeCompanion(companion, argv);
  }
  if (!ctl.chosen()) return chosen();
  ctl.Run();
  return 0;
}

// What a full disk has not taken of the output fails whatever command wrote it.
int CheckOutput() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return 0;
  WriteToStandardError("understudy: standard output cannot be written; is its disk full?\n");
  return static_cast<int>(ExitCode::kInternal);
}

}  // namespace
}  // namespace understudy

int main(int argc, char** argv) {
  understudy::OpenClosedStreams();
  const int code = understudy::CatchErrors([&] { return understudy::Main(argc, argv); });
  understudy::commands::StopLog();
  const int output = understudy::CheckOutput();
  return code == 0 ? output : code;
}
