// The program `understudy`: parses the command line and runs the chosen command.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/catch_errors.h"
#include "base/exit_code.h"
#include "base/log_line.h"
#include "commands/command_path.h"
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
    "  understudy run go2                      simulate a Go2 on lo, domain 0\n"
    "  understudy exec go2 -- python3 prog.py  simulate one while a program runs\n"
    "  understudy rehearse stand_up            play a scenario and judge it\n"
    "  understudy ctl status --watch           show its state in another terminal\n"
    "  understudy view                         show it in a window\n"
    "  understudy remote                       use its remote controller\n"
    "  understudy doctor                       say what is wrong with machine and network\n"
    "`understudy help COMMAND` has details.\n"
    "Exit codes: 0 done; 1 a bug, a request refused, output not written; 2 command line;\n"
    "3 configuration; 4 model; 5 network; 6 another robot on the network; 7 the physics diverged;\n"
    "8 the robot's name or control socket is in use or unusable; 9 a recording that cannot be\n"
    "written or read; 10 an expectation failed; 11 one could not be judged; 12 the doctor found\n"
    "something wrong; exec: the command's code.";

// Prints what is wrong with the command line, if that was found.
bool Explained(const std::string& why) {
  if (why.empty()) return false;
  SayError(why + "\nRun with --help for more information.");
  return true;
}

// Prints what CLI11 says of the command line: help to standard output, errors to standard error.
// Returns its code, 0 for help.
int Explain(const CLI::App& app, const CLI::Error& error) {
  std::ostringstream wrong;
  const int code = app.exit(error, std::cout, wrong);
  const std::string text = wrong.str();
  if (!text.empty()) SayError(std::string_view(text).substr(0, text.find_last_not_of('\n') + 1));
  return code;
}

// Carries out `understudy help COMMAND...`; returns the exit code.
int Help(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  std::string parents;
  for (int i = 2; i < argc && !commands::CommandNames(*command).empty(); ++i) {
    parents += (parents.empty() ? "" : " ") + command->get_name();
    command = commands::FindCommand(*command, argv[i]);
    if (command != nullptr) continue;
    std::vector<const char*> words(argv, argv + argc);
    words.erase(words.begin() + 1);  // `help`
    Explained(commands::MissingCommand(app, argc - 1, words.data()));
    return static_cast<int>(ExitCode::kUsage);
  }
  std::cout << command->help(parents);
  return 0;
}

// How many words follow the first --; 0 if there is none.
std::size_t WordsAfterDashes(int argc, char** argv) {
  char** const end = argv + argc;
  char** const dashes = std::find(argv, end, std::string_view("--"));
  return dashes == end ? 0 : static_cast<std::size_t>(end - dashes - 1);
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Understudy simulates a Unitree robot: programs written with Unitree SDK 2 run against it\n"
      "unchanged.",
      "understudy");
  app.footer(kFooter);
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("understudy ") + kVersion);
  commands::Chosen chosen;

  // Commands of this program and of the companions.
  const std::size_t after_dashes = WordsAfterDashes(argc, argv);
  commands::AddRunCommands(&app, &chosen, &after_dashes);
  ctl::CtlCommand ctl(&app, &std::cout);
  commands::AddTerrainCommand(&app, &chosen);
  commands::AddRehearseCommand(&app, &chosen);
  commands::AddJudgeCommand(&app, &chosen);

  viewer::ViewArguments view;
  viewer::PictureArguments picture;
  viewer::FilmArguments film;
  remote::RemoteArguments remote;
  constexpr char kView[] = "understudy-view";
  const commands::Companion companions[] = {
      {viewer::AddViewCommand(&app, &view), kView, viewer::kViewerMissing},
      {viewer::AddPictureCommand(&app, &picture), kView, viewer::kViewerMissing},
      {viewer::AddFilmCommand(&app, &film), kView, viewer::kViewerMissing},
      {remote::AddRemoteCommand(&app, &remote), "understudy-remote", remote::kRemoteMissing},
  };

  commands::AddCameraCommand(&app, &chosen);
  commands::AddPlayCommand(&app, &chosen);
  commands::AddPlotCommand(&app, &chosen);
  commands::AddCompareCommand(&app, &chosen);
  commands::AddExciteCommand(&app, &chosen);
  commands::AddIdentifyCommand(&app, &chosen);
  commands::AddRecordingCommand(&app, &chosen);
  commands::AddNewCommand(&app, &chosen);
  commands::AddExportCommand(&app, &chosen);
  commands::AddPolicyCommand(&app, &chosen);
  commands::AddDoctorCommand(&app, &chosen);
  commands::AddInspectCommands(&app, &chosen);
  commands::AddCompletionsCommand(&app, &chosen);

  // Command line.
  try {
    if (argc > 1 && std::string_view(argv[1]) == "help") return Help(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (argc == 1) {
      SayErrorText(app.help());
    } else if (!Explained(commands::MissingCommand(app, argc, argv))) {
      Explain(app, error);
    }
    return static_cast<int>(ExitCode::kUsage);
  } catch (const CLI::ExtrasError& error) {
    if (!Explained(commands::UnknownOption(app, argc, argv))) Explain(app, error);
    return static_cast<int>(ExitCode::kUsage);
  } catch (const CLI::ParseError& error) {
    const int code = Explain(app, error);
    return code == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  // Run the chosen command.
  for (const commands::Companion& companion : companions) {
    if (companion.command->parsed()) commands::BecomeCompanion(companion, argv);
  }
  if (!ctl.chosen()) return chosen();
  return static_cast<int>(ctl.Run());
}

// Fails every command whose output could not be written completely, as to a full disk.
int CheckOutput() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return 0;
  SayError("standard output cannot be written; is its disk full?");
  return static_cast<int>(ExitCode::kInternal);
}

}  // namespace
}  // namespace understudy

int main(int argc, char** argv) {
  understudy::OpenClosedStreams();
  if (understudy::AsksForJson(argc, argv)) understudy::SpeakJson();
  const int code = understudy::CatchErrors([&] { return understudy::Main(argc, argv); });
  understudy::commands::StopLog();
  const int output = understudy::CheckOutput();
  return code == 0 ? output : code;
}
