#include "commands/rehearsal_before.h"

#include <chrono>
#include <cmath>
#include <optional>

#include <fcntl.h>

#include "base/errors.h"
#include "base/exit_code.h"
#include "base/files.h"
#include "base/printed.h"
#include "base/temporary_folder.h"
#include "base/unique_fd.h"
#include "exec/child_process.h"

namespace understudy::commands {

namespace fs = std::filesystem;

std::vector<std::string> OptionsOf(const RehearseArguments& arguments) {
  std::vector<std::string> words = WordsOf(arguments.network);
  for (const std::string& set : arguments.sets) words.insert(words.end(), {"--set", set});
  const std::vector<std::string> clock = WordsOf(arguments.clock);
  words.insert(words.end(), clock.begin(), clock.end());
  if (arguments.to_the_end) words.emplace_back("--to-the-end");
  return words;
}

void AddCommand(const std::vector<std::string>& command, std::vector<std::string>* words) {
  if (command.empty()) return;
  words->emplace_back("--");
  words->insert(words->end(), command.begin(), command.end());
}

int PlayBefore(const RehearseArguments& arguments, const fs::path& folder) {
  std::vector<std::string> words{"/proc/self/exe", "rehearse",         arguments.scenario,
                                 "--out",          folder.string(),    "--no-pictures",
                                 "--log-level",    arguments.log_level};
  if (arguments.run > 0) words.insert(words.end(), {"--run", std::to_string(arguments.run)});
  if (const auto limit = arguments.campaign.limit) {
    words.insert(words.end(), {"--run-limit", Printed("%.9g", *limit)});
  }
  for (const std::string& word : OptionsOf(arguments)) words.push_back(word);
  AddCommand(arguments.command, &words);
  const UniqueFd nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  exec::ChildProcess run(words, {}, -1, nowhere.get());
  run.Release();
  return run.Wait();
}

nlohmann::json VerdictOf(const fs::path& folder, const char* key) {
  return nlohmann::json::parse(FileText(folder / "verdict.json")).at(key);
}

bool IsJudged(int code) {
  return code == 0 || code == static_cast<int>(ExitCode::kFailed) ||
         code == static_cast<int>(ExitCode::kOpen);
}

double MeasureThink(RehearseArguments arguments) {
  arguments.clock.measures = false;
  const TemporaryFolder folder("think");
  const fs::path run = folder.path() / "run";
  if (const int code = PlayBefore(arguments, run); !IsJudged(code)) {
    throw SetupError("--think auto: the rehearsal that measures ended with exit code " +
                     std::to_string(code));
  }
  const nlohmann::json ms = VerdictOf(run, "computed_ms");
  if (ms.is_null()) return ThinkOf(std::nullopt);
  return ThinkOf(std::chrono::nanoseconds(std::llround(1e6 * ms.get<double>())));
}

}  // namespace understudy::commands
