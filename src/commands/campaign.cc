#include "commands/campaign.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/files.h"
#include "base/signals.h"
#include "version.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

// Without a terminal, progress is printed this often; *assumed*.
constexpr std::chrono::seconds kQuietEvery(60);

// The cores that this process may use, as in a job of a cluster.
std::size_t Cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return 1;
  return static_cast<std::size_t>(std::max(1, CPU_COUNT(&set)));
}

std::size_t JobsOf(const CampaignRequest& request, const CampaignArguments& arguments,
                   bool has_program) {
  if (request.host_network) {
    if (arguments.jobs > 1) {
      throw ConfigError("--jobs " + std::to_string(arguments.jobs) +
                        ": robots side by side need private networks; leave out --network host");
    }
    return 1;
  }
  if (arguments.jobs > 0) return arguments.jobs;
  return has_program ? std::max<std::size_t>(1, Cores() / 2) : Cores();
}

rehearse::Keep KeepOf(const std::string& word) {
  if (word == "all") return rehearse::Keep::kAll;
  return word == "none" ? rehearse::Keep::kNone : rehearse::Keep::kFailures;
}

// Tells progress on standard error: a line that is redrawn on a terminal, else one now and then.
class Teller {
 public:
  ~Teller() { Clear(); }

  void Tell(const rehearse::Progress& progress) {
    const std::string text = rehearse::ProgressText(progress);
    if (terminal_) {
      std::fprintf(stderr, "\r\033[K%s", text.c_str());
      drawn_ = true;
      return;
    }
    const auto now = steady_clock::now();
    if (now < told_ + kQuietEvery) return;
    told_ = now;
    std::fprintf(stderr, "%s\n", text.c_str());
  }

  // Runs that passed are printed at the end.
  void Tell(const rehearse::RunResult& result) {
    if (result.outcome == judge::Outcome::kPassed) return;
    Clear();
    std::fprintf(stderr, "%s\n", rehearse::RunText(result, terminal_).c_str());
  }

  void Clear() {
    if (drawn_) std::fputs("\r\033[K", stderr);
    drawn_ = false;
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  bool drawn_ = false;
  steady_clock::time_point told_ = steady_clock::now();
};

// Programs side by side cannot share a terminal's input, and each is to have the signals that it
// has by itself: ours are inherited where they are ignored.
void PrepareForRuns() {
  CatchStopSignals();
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing < 0) return;
  ::dup2(nothing, STDIN_FILENO);
  ::close(nothing);
}

int CodeOf(const rehearse::Tally& tally, std::size_t missing) {
  if (tally.failed > 0) return static_cast<int>(ExitCode::kFailed);
  return tally.open + missing > 0 ? static_cast<int>(ExitCode::kOpen) : 0;
}

// Writes the reports of a folder and prints what they say.
rehearse::Campaign Tell(const fs::path& out, bool json) {
  rehearse::Campaign campaign = rehearse::ReadCampaign(out);
  rehearse::WriteReports(campaign, out);
  if (json) {
    std::fputs(rehearse::CampaignJson(campaign).c_str(), stdout);
  } else {
    const bool colored = isatty(STDOUT_FILENO) == 1;
    std::fputs(rehearse::CampaignText(campaign, colored, true).c_str(), stdout);
    std::printf("%s\n", (out / "report.html").c_str());
  }
  return campaign;
}

}  // namespace

void AddCampaignOptions(CLI::App* app, CampaignArguments* arguments) {
  constexpr char kGroup[] = "Campaigns (scenarios with `vary`)";
  app->add_option("--jobs", arguments->jobs,
                  "Runs side by side [one per core; with a program half as many]")
      ->type_name("N")
      ->check(CLI::Range(1, 4096))
      ->group(kGroup);
  app->add_option(
         "--shard", arguments->shard,
         "Play only every Nth run, from the Ith on, as in 2/8; --merge puts the shards together")
      ->type_name("I/N")
      ->group(kGroup);
  app->add_option("--keep", arguments->keep,
                  "Runs whose recording and report are kept: failures, all or none [failures]")
      ->check(CLI::IsMember({"failures", "all", "none"}))
      ->group(kGroup);
  app->add_flag("--again", arguments->again,
                "Play all runs anew, also those whose results are in --out already")
      ->group(kGroup);
  app->add_option("--merge", arguments->merge,
                  "Put the shards in these folders together, into --out")
      ->type_name("DIR...")
      ->group(kGroup);
}

void RequireNone(const CampaignArguments& arguments, const fs::path& file) {
  const CampaignArguments usual;
  const char* option = arguments.jobs != usual.jobs     ? "--jobs"
                       : !arguments.shard.empty()       ? "--shard"
                       : arguments.keep != usual.keep   ? "--keep"
                       : arguments.again != usual.again ? "--again"
                                                        : nullptr;
  if (option == nullptr) return;
  throw ConfigError(file.string() +
                    ": vary: missing, so this is one rehearsal and not a campaign, "
                    "and " +
                    option + " means nothing");
}

int CampaignCommand(const CampaignRequest& request, const CampaignArguments& arguments) {
  const rehearse::Shard shard =
      arguments.shard.empty() ? rehearse::Shard{} : rehearse::ReadShard(arguments.shard);
  rehearse::CheckRuns(request.file, request.varied.plan, request.options);
  const rehearse::Scenario first = rehearse::LoadScenario(request.file, request.options);
  if (first.program && first.program->command.empty()) {
    throw ConfigError(request.file.string() +
                      ": program: this scenario needs one: understudy rehearse " + request.written +
                      " -- CMD...");
  }
  const rehearse::CampaignHead head{.title = request.varied.name,
                                    .about = request.varied.about,
                                    .scenario = request.written,
                                    .options = request.words,
                                    .command = request.options.command,
                                    .version = kVersion,
                                    .text = FileText(request.file)};
  PrepareForRuns();
  Teller teller;
  const rehearse::Played played = rehearse::PlayCampaign(
      head, request.varied.plan,
      {.out = request.out,
       .jobs = JobsOf(request, arguments, first.program.has_value()),
       .shard = shard,
       .keep = KeepOf(arguments.keep),
       .limit = arguments.limit.value_or(rehearse::kRunLimit),
       .again = arguments.again,
       .interrupted = [] { return StopSignal() != 0; },
       .on_result = [&teller](const rehearse::RunResult& result) { teller.Tell(result); },
       .on_progress = [&teller](const rehearse::Progress& now) { teller.Tell(now); }});
  teller.Clear();
  Tell(request.out, request.json);
  if (played.found > 0) {
    std::fprintf(stderr, "%zu runs have results already; --again plays them anew\n", played.found);
  }
  if (played.missing > 0) {
    std::fprintf(stderr, "interrupted before %zu runs; the same command plays them\n",
                 played.missing);
  }
  return CodeOf(played.tally, played.missing);
}

int MergeCommand(const CampaignArguments& arguments, const std::string& out, bool json) {
  if (out.empty()) throw ConfigError("--merge: expected --out DIR, the folder for the whole");
  const std::vector<fs::path> folders(arguments.merge.begin(), arguments.merge.end());
  rehearse::MergeCampaigns(folders, out);
  const rehearse::Campaign campaign = Tell(out, json);
  return CodeOf(campaign.summary.tally, campaign.missing());
}

}  // namespace understudy::commands
