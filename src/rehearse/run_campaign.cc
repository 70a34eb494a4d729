#include "rehearse/run_campaign.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <memory>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/errors.h"
#include "base/files.h"
#include "base/printed.h"
#include "base/unique_fd.h"
#include "exec/child_process.h"
#include "exec/command.h"
#include "rehearse/scenario.h"

namespace understudy::rehearse {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

// All *assumed*.
constexpr std::chrono::milliseconds kGlance(2);       // between looks at the runs
constexpr std::chrono::milliseconds kTellEvery(200);  // progress
constexpr std::chrono::milliseconds kWindDown(2000);  // of a run that is interrupted
constexpr double kLastWill = 10;                      // s for a run to judge itself at its limit
constexpr std::size_t kMostShards = 100'000;
constexpr std::size_t kLongestWords = 300;  // letters of a log's last line

constexpr char kHeadFile[] = "campaign.json";
constexpr char kLogFile[] = "log.txt";

// Without the time, which differs each time.
std::string LastWords(const fs::path& log) {
  std::istringstream lines(FileText(log));
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) last = line;
  }
  if (last.starts_with('[') && last.find("] ") != std::string::npos) {
    last = last.substr(last.find("] ") + 2);
  }
  constexpr std::string_view kWho = "understudy: ";
  if (last.starts_with(kWho)) last = last.substr(kWho.size());
  return last.substr(0, kLongestWords);
}

// Whether the run ended because somebody ended it; before it could say so, by the signal itself.
bool WasInterrupted(const std::string& verdict, int exit_code) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (verdict.empty() && exit_code == 128 + signal) return true;
  }
  const auto told = nlohmann::json::parse(verdict, nullptr, false);
  return told.is_object() && told.value("stopped", "") == "interrupted";
}

// Whether a run failed to begin for a reason that all runs have in common.
bool IsOfAll(int exit_code) {
  for (const ExitCode code : {ExitCode::kUsage, ExitCode::kBus, ExitCode::kSocket}) {
    if (exit_code == static_cast<int>(code)) return true;
  }
  return exit_code >= exec::kExitOwnFailure && exit_code <= exec::kExitNotFound;
}

// The result of a run that did not even end by its own limit.
RunResult Overlong(std::size_t number, const std::vector<Setting>& settings, double limit,
                   const std::string& last_words) {
  RunResult result{.number = number, .settings = settings};
  result.outcome = judge::Outcome::kFailed;
  result.broken = OverlongText(limit);
  if (!last_words.empty()) result.broken += ": " + last_words;
  return result;
}

// A rehearsal that is being played.
class Running {
 public:
  Running(std::size_t number, const CampaignHead& head, const CampaignOptions& options)
      : number_(number), folder_(options.out / RunFolder(number)) {
    std::error_code error;
    fs::remove_all(folder_, error);
    MakeFolder(folder_);
    const UniqueFd log(::open((folder_ / kLogFile).c_str(),
                              O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666));
    if (!log.valid()) throw SetupError((folder_ / kLogFile).string() + ": cannot be written");
    std::vector<std::string> words{
        options.program,        "rehearse", head.scenario,    "--run",
        std::to_string(number), "--out",    folder_.string(), "--no-pictures"};
    words.insert(words.end(), {"--run-limit", Printed("%.9g", options.limit)});
    words.insert(words.end(), head.options.begin(), head.options.end());
    if (!head.command.empty()) {
      words.emplace_back("--");
      words.insert(words.end(), head.command.begin(), head.command.end());
    }
    child_ = std::make_unique<exec::ChildProcess>(words, exec::ChildProcess::Environment{},
                                                  log.get(), log.get());
    child_->Release();
  }

  std::size_t number() const { return number_; }
  // Its exit code once it has ended. It ends itself after `limit` [wall s]; one that is stuck is
  // ended.
  std::optional<int> Poll(double limit) {
    const double wall = std::chrono::duration<double>(steady_clock::now() - begun_).count();
    if (!too_long_ && wall > limit + kLastWill) {
      too_long_ = true;
      child_->Terminate(kWindDown);
    }
    return child_->Poll();
  }

  // Its result; nullopt if it was interrupted. Throws CommandError.
  std::optional<RunResult> Result(int exit_code, const std::vector<Setting>& settings,
                                  double limit) const {
    const std::string verdict = FileText(folder_ / "verdict.json");
    const std::string last_words = LastWords(folder_ / kLogFile);
    if (too_long_) return Overlong(number_, settings, limit, last_words);
    if (WasInterrupted(verdict, exit_code)) return std::nullopt;
    if (verdict.empty() && IsOfAll(exit_code)) {
      throw exec::CommandError("run " + std::to_string(number_) + " could not begin: " + last_words,
                               exit_code);
    }
    return ReadRun(number_, settings, exit_code, verdict, last_words);
  }

  void Interrupt() { child_->Terminate(kWindDown); }
  void Discard() {
    child_->Wait();
    RemoveFolder();
  }
  void RemoveFolder() const {
    std::error_code error;
    fs::remove_all(folder_, error);
  }

 private:
  std::size_t number_;
  fs::path folder_;
  steady_clock::time_point begun_ = steady_clock::now();
  bool too_long_ = false;  // it did not end within the limit
  std::unique_ptr<exec::ChildProcess> child_;
};

// The result of a run that is there; nullopt if there is none, or it is damaged.
std::optional<RunResult> ResultIn(const fs::path& folder, std::size_t number, const Plan& plan) {
  const std::string text = FileText(folder / RunFile(number));
  if (text.empty()) return std::nullopt;
  std::optional<RunResult> result = ParseRun(text);
  if (!result || result->number != number || result->settings != plan.Of(number)) {
    return std::nullopt;
  }
  return result;
}

// Takes a folder for this campaign, or throws if it is another's.
void ClaimFolder(const CampaignHead& head, const CampaignOptions& options) {
  std::error_code error;
  const std::string there = FileText(options.out / kHeadFile);
  const std::string text = HeadText(head);
  const fs::path runs = options.out / "runs";
  if (there.empty() && fs::exists(runs, error) && !fs::is_empty(runs, error)) {
    throw ConfigError(runs.string() + ": is not of a campaign; use another --out");
  }
  if (options.again && there != text) {
    // What campaigns have made: 000001 and 000001.json.
    std::vector<fs::path> old;
    for (const fs::directory_entry& entry : fs::directory_iterator(runs, error)) {
      const std::string stem = entry.path().stem();
      const bool is_run = stem.find_first_not_of("0123456789") == std::string::npos;
      if (is_run && (entry.is_directory() || entry.path().extension() == ".json")) {
        old.push_back(entry.path());
      }
    }
    for (const fs::path& run : old) fs::remove_all(run, error);
  }
  MakeFolder(runs);
  if (there == text) return;
  if (!there.empty() && !options.again) {
    throw ConfigError(options.out.string() +
                      ": has results of another campaign: its scenario, options, program or "
                      "version differ; use another --out, or --again to forget them");
  }
  WriteFile(options.out / kHeadFile, text);
}

CampaignHead HeadIn(const fs::path& folder) {
  std::optional<CampaignHead> head = ParseHead(FileText(folder / kHeadFile));
  if (!head) throw ConfigError(folder.string() + ": has no campaign.json of a campaign");
  return *std::move(head);
}

bool IsKept(Keep keep, judge::Outcome outcome) {
  return keep == Keep::kAll || (keep == Keep::kFailures && outcome != judge::Outcome::kPassed);
}

// "53 s", "12 min", "3 h 20 min".
std::string DurationText(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 120) return std::to_string(whole) + " s";
  const long minutes = (whole + 59) / 60;
  if (minutes < 120) return std::to_string(minutes) + " min";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

}  // namespace

Shard ReadShard(const std::string& text) {
  Shard shard{.index = 0, .count = 0};
  const std::size_t slash = text.find('/');
  const auto read = [&text](std::size_t begin, std::size_t end, std::size_t* number) {
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, *number);
    return error == std::errc() && stop == text.data() + end;
  };
  const bool numbers = slash != std::string::npos && read(0, slash, &shard.index) &&
                       read(slash + 1, text.size(), &shard.count);
  if (!numbers || shard.count < 1 || shard.count > kMostShards || shard.index < 1 ||
      shard.index > shard.count) {
    throw ConfigError("--shard " + text +
                      ": expected I/N with I from 1 to N, as 2/8 for the second of eight");
  }
  return shard;
}

std::string ProgressText(const Progress& progress) {
  std::string text = std::to_string(progress.done) + " of " + std::to_string(progress.of) + ": " +
                     std::to_string(progress.tally.passed) + " passed, " +
                     std::to_string(progress.tally.failed) + " failed";
  if (progress.tally.open > 0) {
    text += ", " + std::to_string(progress.tally.open) + " not judged";
  }
  text += "; " + DurationText(progress.elapsed);
  return text + (progress.left ? ", about " + DurationText(*progress.left) + " left"
                               : ", time left not known yet");
}

Played PlayCampaign(const CampaignHead& head, const Plan& plan, const CampaignOptions& options) {
  ClaimFolder(head, options);
  Played played;
  std::vector<std::size_t> to_play;
  for (std::size_t run = options.shard.index; run <= plan.size(); run += options.shard.count) {
    const std::optional<RunResult> result =
        options.again ? std::nullopt : ResultIn(options.out, run, plan);
    if (result) {
      played.tally.Count(result->outcome);
      ++played.found;
    } else {
      to_play.push_back(run);
    }
  }
  const auto begun = steady_clock::now();
  auto told = begun - kTellEvery;
  std::size_t next = 0, ended = 0;
  const std::size_t of = played.found + to_play.size();
  const auto tell = [&] {
    if (!options.on_progress) return;
    const double elapsed = std::chrono::duration<double>(steady_clock::now() - begun).count();
    Progress progress{
        .done = played.found + ended, .of = of, .tally = played.tally, .elapsed = elapsed};
    if (ended > 0) {
      progress.left =
          elapsed / static_cast<double>(ended) * static_cast<double>(to_play.size() - ended);
    }
    options.on_progress(progress);
  };
  std::vector<std::unique_ptr<Running>> running;
  const auto finish = [&](const Running& run, int exit_code) {
    std::optional<RunResult> result = run.Result(exit_code, plan.Of(run.number()), options.limit);
    if (!result) {
      run.RemoveFolder();
      return;
    }
    result->repeat = head.Repeat(run.number());
    result->kept = IsKept(options.keep, result->outcome);
    if (!result->kept) run.RemoveFolder();
    WriteFile(options.out / RunFile(run.number()), RunLine(*result));
    played.tally.Count(result->outcome);
    ++ended;
    if (options.on_result) options.on_result(*result);
  };
  while (!(options.interrupted && options.interrupted())) {
    while (next < to_play.size() && running.size() < options.jobs) {
      running.push_back(std::make_unique<Running>(to_play[next++], head, options));
    }
    if (running.empty()) break;
    bool any = false;
    for (std::unique_ptr<Running>& run : running) {
      const std::optional<int> code = run->Poll(options.limit);
      if (!code) continue;
      any = true;
      finish(*run, *code);
      run.reset();
    }
    std::erase(running, nullptr);
    if (const auto now = steady_clock::now(); now >= told + kTellEvery) {
      told = now;
      tell();
    }
    if (!any) std::this_thread::sleep_for(kGlance);
  }
  for (const std::unique_ptr<Running>& run : running) run->Interrupt();
  for (const std::unique_ptr<Running>& run : running) run->Discard();
  tell();
  played.missing = to_play.size() - ended;
  return played;
}

Campaign ReadCampaign(const fs::path& folder) {
  CampaignHead head = HeadIn(folder);
  Plan plan = PlanOf(head.text, head.scenario);
  Campaign campaign{.head = std::move(head), .plan = std::move(plan)};
  for (std::size_t run = 1; run <= campaign.plan.size(); ++run) {
    if (std::optional<RunResult> result = ResultIn(folder, run, campaign.plan)) {
      campaign.results.push_back(*std::move(result));
    }
  }
  campaign.summary = Summarize(campaign.plan, campaign.results);
  return campaign;
}

void MergeCampaigns(const std::vector<fs::path>& from, const fs::path& out) {
  const CampaignHead head = HeadIn(from.front());
  for (const fs::path& folder : from) {
    if (HeadIn(folder) == head) continue;
    throw ConfigError(folder.string() + ": is of another campaign than " + from.front().string() +
                      ": scenario, options, program or version differ");
  }
  ClaimFolder(head, {.out = out});
  for (const fs::path& folder : from) {
    const Campaign part = ReadCampaign(folder);
    for (const RunResult& result : part.results) {
      const fs::path file = out / RunFile(result.number);
      const std::string line = RunLine(result), there = FileText(file);
      if (there == line) continue;
      if (!there.empty()) {
        throw ConfigError(folder.string() + ": run " + std::to_string(result.number) +
                          " has another result than in the folders before");
      }
      std::error_code error;
      if (result.kept) {
        fs::copy(folder / RunFolder(result.number), out / RunFolder(result.number),
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing, error);
      }
      if (error) {
        throw SetupError((out / RunFolder(result.number)).string() +
                         ": cannot be written: " + error.message());
      }
      WriteFile(file, line);
    }
  }
}

void WriteReports(const Campaign& campaign, const fs::path& folder) {
  WriteFile(folder / "report.html", CampaignHtml(campaign));
  WriteFile(folder / "verdict.json", CampaignJson(campaign));
  WriteFile(folder / "junit.xml", CampaignJunit(campaign));
  WriteFile(folder / "runs.txt", CampaignText(campaign, false, false));
  std::string lines;
  for (const RunResult& result : campaign.results) lines += RunLine(result);
  WriteFile(folder / "runs.jsonl", lines);
}

}  // namespace understudy::rehearse
