// Command line -> configuration -> run.
#include <cstdio>
#include <iostream>

#include <CLI/CLI.hpp>

#include "base/catch_errors.h"
#include "base/exit_code.h"
#include "base/standard_error.h"
#include "commands/commands.h"
#include "commands/companion.h"
#include "commands/log.h"
#include "ctl/command.h"
#include "remote/arguments.h"
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
  commands::Chosen chosen;

  commands::AddRunCommands(&app, &chosen);
  ctl::CtlCommand ctl(&app, &std::cout);
  commands::AddTerrainCommand(&app, &chosen);

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

  commands::AddPlayCommand(&app, &chosen);
  commands::AddPlotCommand(&app, &chosen);
  commands::AddRecordingCommand(&app, &chosen);
  commands::AddInspectCommands(&app, &chosen);
  commands::AddCompletionsCommand(&app, &chosen);

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
