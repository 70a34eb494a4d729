#include "commands/evidence.h"

#include <cstdio>
#include <system_error>

#include <unistd.h>

#include "base/errors.h"
#include "base/files.h"
#include "base/nearest_word.h"
#include "commands/report_pictures.h"
#include "config/data_dir.h"
#include "run/recording.h"
#include "schema/yaml_document.h"

namespace understudy::commands {

namespace fs = std::filesystem;

void AddJudgeOptions(CLI::App* app, JudgeArguments* arguments) {
  app->add_option("--out", arguments->out,
                  "Folder for report.html, junit.xml, verdict.json [rehearsals/NAME]")
      ->type_name("DIR");
  app->add_flag("--json", arguments->json, "Print the verdicts as JSON");
  app->add_flag_callback(
      "--no-pictures", [arguments] { arguments->pictures = false; },
      "Put no pictures of the robot, and of what it saw, into the report");
  app->add_option("--run", arguments->run,
                  "Only this run of a scenario with `vary`; the first is 1")
      ->type_name("NUMBER")
      ->check(CLI::PositiveNumber);
}

fs::path FindScenario(const std::string& written) {
  if (written.find('/') != std::string::npos || fs::path(written).has_extension()) return written;
  const fs::path folder = config::DataDir() / "config" / "scenarios";
  fs::path file = folder / (written + ".yaml");
  std::error_code error;
  if (fs::is_regular_file(file, error)) return file;
  throw ConfigError("no scenario '" + written + "'" +
                    DidYouMean(written, schema::YamlNames(folder)));
}

fs::path FolderOf(const std::string& out, const fs::path& scenario, std::size_t run) {
  if (!out.empty()) return out;
  // A bag's folder may be written with a slash.
  const std::string name = (scenario.has_filename() ? scenario : scenario.parent_path()).stem();
  return fs::path("rehearsals") / (run == 0 ? name : name + "-" + std::to_string(run));
}

fs::path OwnFolder(const fs::path& folder) {
  std::error_code error;
  for (const char* name : {"report.html", "junit.xml"}) {
    if (!fs::exists(folder / name, error) || fs::exists(folder / "verdict.json", error)) continue;
    throw ConfigError((folder / name).string() + ": is not of a rehearsal; use another --out");
  }
  return MakeFolder(folder);
}

int TellVerdicts(const rehearse::Occasion& occasion, const rehearse::Expectations& expect,
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
  if (judged.failed() > 0) return static_cast<int>(ExitCode::kFailed);
  if (judged.Count(judge::Outcome::kNotJudged) > 0) return static_cast<int>(ExitCode::kOpen);
  return 0;
}

std::optional<rehearse::Ladder> Climb(const rehearse::Recordings& recordings,
                                      const std::vector<rehearse::StageSpec>& stages,
                                      const config::Config& config, const rehearse::Judged& judged,
                                      const fs::path& folder) {
  if (stages.empty()) return std::nullopt;
  rehearse::Ladder ladder = rehearse::JudgeLadder(recordings, stages, config, judged);
  if (!ladder.next_settings.empty()) WriteFile(folder / "next_stage.yaml", ladder.next_settings);
  return ladder;
}

rehearse::Pictures PicturesFor(const JudgeArguments& arguments,
                               const rehearse::Expectations& expect, const rehearse::Judged& judged,
                               const config::Config& config,
                               const std::vector<fs::path>& recordings, const fs::path& folder) {
  if (!arguments.pictures || judged.about.empty()) return {};
  return DrawPictures(expect, judged, config, recordings, folder);
}

std::string RobotsText(const config::Config& config) {
  if (config.robots.size() == 1) return config.robots[0].spec.name;
  std::string names;
  for (const config::RobotConfig& robot : config.robots) {
    names += (names.empty() ? "" : ", ") + robot.name + " (" + robot.spec.name + ")";
  }
  return names;
}

std::vector<fs::path> RecordingsOf(const fs::path& file, const config::Config& config) {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < config.robots.size(); ++i) {
    files.push_back(run::RecordingOf(file, config, i));
  }
  return files;
}

}  // namespace understudy::commands
