#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/signals.h"
#include "client/control_folder.h"
#include "commands/commands.h"
#include "commands/log.h"
#include "commands/network_options.h"
#include "commands/set_options.h"
#include "config/data_dir.h"
#include "rehearse/outputs.h"
#include "rehearse/rehearse.h"
#include "rehearse/scenario.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;

// The command line of both.
struct JudgeArguments {
  std::string scenario;
  std::string out;
  std::string recording;  // judge only
  bool json = false;
};

struct RehearseArguments : JudgeArguments, SetArguments {
  NetworkArguments network;
  std::string log_level = "warn";
  bool to_the_end = false;
  bool words = false;
  std::vector<std::string> command;
};

// A file, or the name of one in config/scenarios.
fs::path FindScenario(const std::string& written) {
  if (written.find('/') != std::string::npos || fs::path(written).has_extension()) return written;
  const fs::path folder = config::DataDir() / "config" / "scenarios";
  fs::path file = folder / (written + ".yaml");
  std::error_code error;
  if (fs::is_regular_file(file, error)) return file;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    names.push_back(entry.path().stem());
  }
  throw ConfigError("no scenario '" + written + "'" + DidYouMean(written, names));
}

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void WriteFile(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) throw SetupError(file.string() + ": cannot be written");
}

fs::path MakeFolder(const std::string& out, const fs::path& scenario) {
  fs::path folder = out.empty() ? fs::path("rehearsals") / scenario.stem() : fs::path(out);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw SetupError(folder.string() + ": cannot be made: " + error.message());
  return folder;
}

// Prints the verdicts and writes those for CI, programs and people. Returns the exit code.
int Tell(const rehearse::Occasion& occasion, const rehearse::Expectations& expect,
         const rehearse::Judged& judged, const fs::path& folder, bool as_json) {
  const std::string told = rehearse::TellJson(occasion, expect, judged);
  WriteFile(folder / "verdict.json", told);
  WriteFile(folder / "junit.xml", rehearse::TellJunit(occasion, expect, judged));
  WriteFile(folder / "report.html", rehearse::TellHtml(occasion, expect, judged));
  if (as_json) {
    std::fputs(told.c_str(), stdout);
  } else {
    const bool colored = isatty(STDOUT_FILENO) == 1;
    std::fputs(rehearse::TellLines(occasion, expect, judged, colored).c_str(), stdout);
    std::printf("%s\n", (folder / "report.html").c_str());
  }
  if (judged.Count(judge::Outcome::kFailed) > 0) return static_cast<int>(ExitCode::kFailed);
  if (judged.Count(judge::Outcome::kNotJudged) > 0) return static_cast<int>(ExitCode::kOpen);
  return 0;
}

int RehearseCommand(const RehearseArguments& arguments) {
  if (arguments.words) {
    std::printf("%s\n%s\n%s", rehearse::ScenarioReference().c_str(),
                rehearse::ExpectationsReference().c_str(), signals::SignalsReference().c_str());
    return 0;
  }
  const fs::path file = FindScenario(arguments.scenario);
  rehearse::Scenario scenario =
      rehearse::LoadScenario(file, {.command = arguments.command, .sets = arguments.sets});
  if (scenario.program && scenario.program->command.empty()) {
    throw ConfigError(file.string() + ": program: this scenario needs one: understudy rehearse " +
                      arguments.scenario + " -- CMD...");
  }
  const fs::path folder = MakeFolder(arguments.out, file);
  client::MakeControlFolder(client::ControlFolder());
  const fs::path control = client::ControlSocket(client::DefaultName(scenario.config.robot.name));
  RunNetwork network(arguments.network, &scenario.config);

  // The program is forked before any thread exists.
  std::optional<exec::ProgramOutput> output;
  std::optional<exec::ChildProcess> program;
  if (scenario.program) {
    std::vector<signals::Signal> heard = scenario.script.conditions.signals;
    heard.insert(heard.end(), scenario.expect.signals.begin(), scenario.expect.signals.end());
    const std::vector<std::string> printed = signals::PrintedTexts(heard);
    if (!printed.empty()) output.emplace(printed);
    program.emplace(scenario.program->command,
                    exec::ChildProcess::Environment{{"UNDERSTUDY_CONTROL", control}}, -1,
                    output ? output->descriptor() : -1, network.program_rights());
  }
  network.Settle();
  if (output) output->Start();
  StartLog({.level = arguments.log_level, .json = false, .status_line = false});
  CatchStopSignals();
  const rehearse::Rehearsal rehearsal =
      rehearse::Rehearse(scenario,
                         {.control_socket = control,
                          .recording = folder / "recording.mcap",
                          .private_network = network.is_private(),
                          .to_the_end = arguments.to_the_end,
                          .interrupted = [] { return StopSignal() != 0; },
                          .output = output ? &*output : nullptr},
                         program ? &*program : nullptr);

  // The line that does the same again has the seed that was drawn.
  std::vector<std::string> words{"understudy", "rehearse", arguments.scenario};
  for (const std::string& word : WordsOf(arguments.network)) words.push_back(word);
  for (const std::string& set : arguments.sets) {
    words.insert(words.end(), {"--set", set});
  }
  const auto seed = rehearsal.judged.about.find("seed");
  if (seed != rehearsal.judged.about.end() && !seed->second.empty()) {
    words.insert(words.end(), {"--seed", seed->second});
  }
  if (!arguments.command.empty()) {
    words.emplace_back("--");
    words.insert(words.end(), arguments.command.begin(), arguments.command.end());
  }
  std::vector<std::string> script;
  for (const emulator::ScriptEvent& event : scenario.script.events) {
    script.push_back(emulator::Describe(event.request));
  }
  const rehearse::Occasion occasion{.title = scenario.name,
                                    .about = scenario.about,
                                    .robot = scenario.config.robot.name,
                                    .source = file,
                                    .recording = folder / "recording.mcap",
                                    .repeat = rehearse::ShellText(words),
                                    .scenario = TextOf(file),
                                    .script = script,
                                    .stopped = rehearsal.stopped,
                                    .wall = rehearsal.wall};
  const int code = Tell(occasion, scenario.expect, rehearsal.judged, folder, arguments.json);
  return rehearsal.robot == ExitCode::kOk ? code : static_cast<int>(rehearsal.robot);
}

int JudgeCommand(const JudgeArguments& arguments) {
  const fs::path file = FindScenario(arguments.scenario);
  const record::McapReader reader(arguments.recording);
  record::StringMap about;
  const auto found = reader.contents().metadata.find("understudy");
  if (found != reader.contents().metadata.end()) about = found->second;
  const rehearse::Expectations expect =
      rehearse::LoadExpectations(file, about["robot"], about["revision"]);
  const rehearse::Judged judged = rehearse::JudgeRecording(reader, expect);
  if (!judged.cut_short.empty()) {
    std::fprintf(stderr, "the recording was cut short: %s\n", judged.cut_short.c_str());
  }
  const rehearse::Occasion occasion{
      .title = fs::path(arguments.recording).filename(),
      .about = {},
      .robot = about["robot"],
      .source = file,
      .recording = arguments.recording,
      .repeat =
          rehearse::ShellText({"understudy", "judge", arguments.recording, arguments.scenario}),
      .scenario = TextOf(file),
      .script = {},
      .stopped = {},
      .wall = 0};
  return Tell(occasion, expect, judged, MakeFolder(arguments.out, arguments.recording),
              arguments.json);
}

void AddJudgeOptions(CLI::App* app, JudgeArguments* arguments) {
  app->add_option("--out", arguments->out,
                  "Folder for report.html, junit.xml, verdict.json [rehearsals/NAME]")
      ->type_name("DIR");
  app->add_flag("--json", arguments->json, "Print the verdicts as JSON");
}

}  // namespace

void AddRehearseCommands(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<RehearseArguments>();
  CLI::App* rehearse =
      app->add_subcommand("rehearse", "Play a scenario and judge what was expected of it");
  rehearse
      ->add_option("scenario", arguments->scenario,
                   "A scenario's file, or the name of a shipped one")
      ->type_name("SCENARIO");
  rehearse->add_flag("--words", arguments->words,
                     "Print keys, operators and signals as Markdown and exit");
  AddJudgeOptions(rehearse, arguments.get());
  AddShortOption(rehearse, arguments.get(), "--seed", "randomization.seed", "N",
                 "Seed of randomization, in place of the scenario's");
  rehearse
      ->add_option_function<std::vector<std::string>>(
          "--set",
          [arguments](const std::vector<std::string>& sets) {
            arguments->sets.insert(arguments->sets.end(), sets.begin(), sets.end());
          },
          "Sets one key of the configuration, e.g. --set terrain.friction=0.3; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  rehearse->add_flag("--to-the-end", arguments->to_the_end,
                     "Do not end early when an expectation has failed");
  AddNetworkOptions(rehearse, &arguments->network);
  rehearse->add_option("--log-level", arguments->log_level, "debug, info, warn or error [warn]")
      ->check(CLI::IsMember({"debug", "info", "warn", "error"}));
  rehearse
      ->add_option("command", arguments->command,
                   "The program under test and its arguments, after --")
      ->type_name("CMD...");
  rehearse->footer(
      "Examples:\n"
      "  understudy rehearse stand_up\n"
      "  understudy rehearse walk.yaml -- python3 walk.py lo\n"
      "  understudy rehearse walk.yaml --interface-name eth0 -- python3 walk.py eth0\n"
      "  understudy rehearse push.yaml --set terrain.friction=0.3 --out results\n"
      "Exits with 0 if all expectations hold, 10 if one failed, 11 if none failed and one could\n"
      "not be judged. docs/rehearsing.md has the words of scenarios.");
  rehearse->callback([=] {
    if (arguments->scenario.empty() && !arguments->words) throw CLI::RequiredError("SCENARIO");
    RequireConsistent(arguments->network);
    *chosen = [=] { return RehearseCommand(*arguments); };
  });

  const auto judged = std::make_shared<JudgeArguments>();
  CLI::App* judge = app->add_subcommand("judge", "Judge a recording by what a scenario expects");
  judge->add_option("recording", judged->recording, "The recording, MCAP")
      ->required()
      ->type_name("RECORDING");
  judge
      ->add_option("scenario", judged->scenario,
                   "A scenario, or a file with nothing but `expect` and `robot`")
      ->required()
      ->type_name("EXPECT");
  AddJudgeOptions(judge, judged.get());
  judge->footer(
      "Examples:\n"
      "  understudy judge rehearsals/stand_up/recording.mcap stand_up\n"
      "  understudy judge real_robot.mcap expect.yaml --json\n"
      "The exit codes are those of `rehearse`.");
  judge->callback([=] { *chosen = [=] { return JudgeCommand(*judged); }; });
}

}  // namespace understudy::commands
