#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/errors.h"
#include "base/files.h"
#include "commands/commands.h"
#include "commands/evidence.h"
#include "record/recording_reader.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;

// The recordings of all robots, of which one is named on the command line.
std::vector<fs::path> RecordingsBeside(const fs::path& one, const config::Config& config) {
  if (config.robots.size() == 1) return {one};
  for (const config::RobotConfig& robot : config.robots) {
    const std::string stem = one.stem(), end = "_" + robot.name;
    if (!stem.ends_with(end)) continue;
    const std::string base = stem.substr(0, stem.size() - end.size());
    return RecordingsOf(one.parent_path() / (base + one.extension().string()), config);
  }
  throw ConfigError(one.string() + ": expected the recording of one of " + RobotsText(config) +
                    ", as in recording_" + config.robots[0].name + ".mcap");
}

int JudgeCommand(const JudgeArguments& arguments) {
  const fs::path file = FindScenario(arguments.scenario);
  record::StringMap about;
  {
    const auto opened = record::OpenRecording(arguments.recording);
    const auto found = opened->contents().metadata.find("understudy");
    if (found != opened->contents().metadata.end()) about = found->second;
  }
  const rehearse::Standard standard =
      rehearse::LoadStandard(file, about["robot"], about["revision"], arguments.run);
  const std::vector<fs::path> files = RecordingsBeside(arguments.recording, standard.config);
  const rehearse::Recordings recordings = rehearse::OpenRecordings(files);
  const rehearse::Judged judged = rehearse::JudgeRecordings(recordings, standard.expect);
  if (!judged.cut_short.empty()) {
    std::fprintf(stderr, "the recording was cut short: %s\n", judged.cut_short.c_str());
  }
  std::vector<std::string> words{"understudy", "judge", arguments.recording, arguments.scenario};
  if (arguments.run > 0) words.insert(words.end(), {"--run", std::to_string(arguments.run)});
  const std::string repeat = rehearse::ShellText(words);
  const fs::path folder = OwnFolder(FolderOf(arguments.out, arguments.recording));
  const rehearse::Occasion occasion{
      .title = fs::path(arguments.recording).filename(),
      .about = {},
      .robot = standard.config.robots.size() == 1 ? about["robot"] : RobotsText(standard.config),
      .source = file,
      .recording = arguments.recording,
      .judge = repeat,
      .repeat = repeat,
      .scenario = FileText(file),
      .script = {},
      .stopped = {},
      .clock = {},
      .think = 0,
      .computed = {},
      .unrepeatable = {},
      .repeats = {},
      .ladder = Climb(recordings, standard.stages, standard.config, judged, folder),
      .pictures = PicturesFor(arguments, standard.expect, judged, standard.config, files, folder),
      .wall = 0};
  return TellVerdicts(occasion, standard.expect, judged, folder, arguments.json);
}

}  // namespace

void AddJudgeCommand(CLI::App* app, Chosen* chosen) {
  const auto judged = std::make_shared<JudgeArguments>();
  CLI::App* judge = app->add_subcommand("judge", "Judge a recording by what a scenario expects");
  judge
      ->add_option("recording", judged->recording,
                   "The recording, MCAP or a ROS 2 bag; of several robots that of one of them")
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
