#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include <unistd.h>

#include "base/errors.h"
#include "base/files.h"
#include "base/nearest_word.h"
#include "base/signals.h"
#include "client/control_folder.h"
#include "commands/campaign.h"
#include "commands/commands.h"
#include "commands/log.h"
#include "commands/network_options.h"
#include "commands/report_pictures.h"
#include "commands/set_options.h"
#include "config/data_dir.h"
#include "ctl/check.h"
#include "rehearse/outputs.h"
#include "rehearse/rehearse.h"
#include "rehearse/run_campaign.h"
#include "rehearse/scenario.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastLimit = 1, kMostLimit = 1e9;  // of --run-limit, s

// The command line of both.
struct JudgeArguments {
  std::string scenario;
  std::string out;
  std::string recording;  // judge only
  std::size_t run = 0;    // of a campaign; 0: none was chosen
  bool json = false;
  bool pictures = true;
};

struct RehearseArguments : JudgeArguments, SetArguments {
  NetworkArguments network;
  std::string log_level = "warn";
  bool to_the_end = false;
  bool words = false;
  CampaignArguments campaign;
  std::vector<std::string> command;
};

// A file, or the name of one in config/scenarios.
fs::path FindScenario(const std::string& written) {
  if (written.find('/') != std::string::npos || fs::path(written).has_extension()) return written;
  const fs::path folder = config::DataDir() / "config" / "scenarios";
  fs::path file = folder / (written + ".yaml");
  std::error_code error;
  if (fs::is_regular_file(file, error)) return file;
  throw ConfigError("no scenario '" + written + "'" +
                    DidYouMean(written, config::YamlNames(folder)));
}

fs::path FolderOf(const std::string& out, const fs::path& scenario, std::size_t run = 0) {
  if (!out.empty()) return out;
  // A bag's folder may be written with a slash.
  const std::string name = (scenario.has_filename() ? scenario : scenario.parent_path()).stem();
  return fs::path("rehearsals") / (run == 0 ? name : name + "-" + std::to_string(run));
}

// Wall s in which it has to end unless --run-limit says otherwise.
double LimitOf(const config::Config& config) {
  const double speed = config.time.speed > 0 ? config.time.speed : 1;
  return rehearse::kRunLimit + std::max(0.0, config.time.duration) / speed;
}

// The options that a run of a campaign has as the campaign has them.
std::vector<std::string> OptionsOf(const RehearseArguments& arguments) {
  std::vector<std::string> words = WordsOf(arguments.network);
  for (const std::string& set : arguments.sets) words.insert(words.end(), {"--set", set});
  if (arguments.to_the_end) words.emplace_back("--to-the-end");
  return words;
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
  if (judged.Count(judge::Outcome::kFailed) > 0 || occasion.overlong) {
    return static_cast<int>(ExitCode::kFailed);
  }
  if (judged.Count(judge::Outcome::kNotJudged) > 0) return static_cast<int>(ExitCode::kOpen);
  return 0;
}

// Judges the stages, if there are any, and writes the settings of the next into the folder.
std::optional<rehearse::Ladder> Climb(const record::RecordingReader& reader,
                                      const std::vector<rehearse::StageSpec>& stages,
                                      const config::Config& config, const rehearse::Judged& judged,
                                      const fs::path& folder) {
  if (stages.empty()) return std::nullopt;
  rehearse::Ladder ladder = rehearse::JudgeLadder(reader, stages, config, judged);
  if (!ladder.next_settings.empty()) WriteFile(folder / "next_stage.yaml", ladder.next_settings);
  return ladder;
}

// Of a recording that has the simulation's truth, where they are asked for.
rehearse::Pictures PicturesFor(const JudgeArguments& arguments, const rehearse::Judged& judged,
                               const fs::path& recording, const fs::path& folder) {
  if (!arguments.pictures || judged.about.empty()) return {};
  return DrawPictures(judged, recording, folder);
}

int RehearseCommand(const RehearseArguments& arguments) {
  if (arguments.words) {
    std::printf("%s\n%s\n%s", rehearse::ScenarioReference().c_str(),
                rehearse::ExpectationsReference().c_str(), signals::SignalsReference().c_str());
    return 0;
  }
  if (!arguments.campaign.merge.empty())
    return MergeCommand(arguments.campaign, arguments.out, arguments.json);
  const fs::path file = FindScenario(arguments.scenario);
  const rehearse::ScenarioOptions options{.command = arguments.command,
                                          .sets = arguments.sets,
                                          .run = arguments.run,
                                          .typed = arguments.typed};
  if (arguments.run == 0) {
    if (const auto varied = rehearse::LoadVaried(file)) {
      return CampaignCommand({.file = file,
                              .written = arguments.scenario,
                              .varied = *varied,
                              .options = options,
                              .words = OptionsOf(arguments),
                              .out = FolderOf(arguments.out, file),
                              .host_network = arguments.network.network == "host",
                              .json = arguments.json},
                             arguments.campaign);
    }
    RequireNone(arguments.campaign, file);
  }
  rehearse::Scenario scenario = rehearse::LoadScenario(file, options);
  if (scenario.program && scenario.program->command.empty()) {
    throw ConfigError(file.string() + ": program: this scenario needs one: understudy rehearse " +
                      arguments.scenario + " -- CMD...");
  }
  const fs::path folder = MakeFolder(FolderOf(arguments.out, file, arguments.run));
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
                          .limit = arguments.campaign.limit.value_or(LimitOf(scenario.config)),
                          .output = output ? &*output : nullptr},
                         program ? &*program : nullptr);

  // The line that does the same again has the seed that was drawn.
  std::vector<std::string> words{"understudy", "rehearse", arguments.scenario};
  if (arguments.run > 0) words.insert(words.end(), {"--run", std::to_string(arguments.run)});
  for (const std::string& word : OptionsOf(arguments)) words.push_back(word);
  const auto seed = rehearsal.judged.about.find("seed");
  const bool drawn = seed != rehearsal.judged.about.end() && !seed->second.empty();
  if (drawn && arguments.run == 0) words.insert(words.end(), {"--seed", seed->second});
  if (!arguments.command.empty()) {
    words.emplace_back("--");
    words.insert(words.end(), arguments.command.begin(), arguments.command.end());
  }
  std::vector<std::string> script;
  for (const emulator::ScriptEvent& event : scenario.script.events) {
    script.push_back(emulator::Describe(event.request));
  }
  const std::string recording = folder / "recording.mcap";
  std::vector<std::string> again{"understudy", "judge", recording, arguments.scenario};
  std::string title = scenario.name;
  if (arguments.run > 0) {
    again.insert(again.end(), {"--run", std::to_string(arguments.run)});
    title += ", run " + std::to_string(arguments.run) + ": " + SettingsText(scenario.settings);
  }
  const rehearse::Occasion occasion{
      .title = title,
      .about = scenario.about,
      .robot = scenario.config.robot.name,
      .source = file,
      .recording = recording,
      .judge = rehearse::ShellText(again),
      .repeat = rehearse::ShellText(words),
      .scenario = FileText(file),
      .script = script,
      .stopped = rehearsal.stopped,
      .overlong = rehearsal.overlong,
      .ladder = Climb(*record::OpenRecording(recording), scenario.stages, scenario.config,
                      rehearsal.judged, folder),
      .pictures = PicturesFor(arguments, rehearsal.judged, recording, folder),
      .wall = rehearsal.wall};
  const int code = Tell(occasion, scenario.expect, rehearsal.judged, folder, arguments.json);
  return rehearsal.robot == ExitCode::kOk ? code : static_cast<int>(rehearsal.robot);
}

int JudgeCommand(const JudgeArguments& arguments) {
  const fs::path file = FindScenario(arguments.scenario);
  const auto opened = record::OpenRecording(arguments.recording);
  const record::RecordingReader& reader = *opened;
  record::StringMap about;
  const auto found = reader.contents().metadata.find("understudy");
  if (found != reader.contents().metadata.end()) about = found->second;
  const rehearse::Standard standard =
      rehearse::LoadStandard(file, about["robot"], about["revision"], arguments.run);
  const rehearse::Judged judged = rehearse::JudgeRecording(reader, standard.expect);
  if (!judged.cut_short.empty()) {
    std::fprintf(stderr, "the recording was cut short: %s\n", judged.cut_short.c_str());
  }
  std::vector<std::string> words{"understudy", "judge", arguments.recording, arguments.scenario};
  if (arguments.run > 0) words.insert(words.end(), {"--run", std::to_string(arguments.run)});
  const std::string repeat = rehearse::ShellText(words);
  const fs::path folder = MakeFolder(FolderOf(arguments.out, arguments.recording));
  const rehearse::Occasion occasion{
      .title = fs::path(arguments.recording).filename(),
      .about = {},
      .robot = about["robot"],
      .source = file,
      .recording = arguments.recording,
      .judge = repeat,
      .repeat = repeat,
      .scenario = FileText(file),
      .script = {},
      .stopped = {},
      .overlong = false,
      .ladder = Climb(reader, standard.stages, standard.config, judged, folder),
      .pictures = PicturesFor(arguments, judged, arguments.recording, folder),
      .wall = 0};
  return Tell(occasion, standard.expect, judged, folder, arguments.json);
}

void AddJudgeOptions(CLI::App* app, JudgeArguments* arguments) {
  app->add_option("--out", arguments->out,
                  "Folder for report.html, junit.xml, verdict.json [rehearsals/NAME]")
      ->type_name("DIR");
  app->add_flag("--json", arguments->json, "Print the verdicts as JSON");
  app->add_flag_callback(
      "--no-pictures", [arguments] { arguments->pictures = false; },
      "Put no pictures of the robot into the report");
  app->add_option("--run", arguments->run,
                  "Only this run of a scenario with `vary`; the first is 1")
      ->type_name("NUMBER")
      ->check(CLI::PositiveNumber);
}

}  // namespace

void AddRehearseCommands(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<RehearseArguments>();
  CLI::App* rehearse =
      app->add_subcommand("rehearse", "Play a scenario and judge what was expected of it");
  rehearse
      ->add_option("scenario", arguments->scenario,
                   "File of a scenario, or the name of one that is shipped")
      ->type_name("SCENARIO");
  rehearse->add_flag("--words", arguments->words,
                     "Print keys, operators and signals as Markdown and exit");
  AddJudgeOptions(rehearse, arguments.get());
  AddShortOption(rehearse, arguments.get(), "--seed", "randomization.seed", "N",
                 "Seed of randomization, in place of the scenario's");
  AddProfileOption(rehearse, arguments.get());
  AddSetOption(rehearse, arguments.get(),
               "one key of the configuration, e.g. --set terrain.friction=0.3");
  rehearse->add_flag("--to-the-end", arguments->to_the_end,
                     "Do not end early when an expectation has failed");
  rehearse
      ->add_option(
          "--run-limit", arguments->campaign.limit,
          "Wall time, s, after which a rehearsal, or a run of a campaign, is ended and has "
          "failed [3600 more than a rehearsal's duration]")
      ->type_name("S")
      ->check(ctl::NumberWithin(kLeastLimit, kMostLimit));
  AddCampaignOptions(rehearse, &arguments->campaign);
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
      "  understudy rehearse shoves.yaml --jobs 8        # a campaign: it has `vary`\n"
      "  understudy rehearse shoves.yaml --run 7         # its 7th run, with all evidence\n"
      "  understudy rehearse shoves.yaml --shard 2/4 --out part2\n"
      "  understudy rehearse --merge part1 part2 part3 part4 --out all\n"
      "Exits with 0 if all expectations hold, 10 if one failed, 11 if none failed and one could\n"
      "not be judged. docs/rehearsing.md has the words of scenarios.");
  rehearse->callback([=] {
    const bool merges = !arguments->campaign.merge.empty();
    if (arguments->scenario.empty() && !arguments->words && !merges) {
      throw CLI::RequiredError("SCENARIO");
    }
    RequireConsistent(arguments->network);
    *chosen = [=] { return RehearseCommand(*arguments); };
  });

  const auto judged = std::make_shared<JudgeArguments>();
  CLI::App* judge = app->add_subcommand("judge", "Judge a recording by what a scenario expects");
  judge->add_option("recording", judged->recording, "The recording, MCAP or a ROS 2 bag")
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
