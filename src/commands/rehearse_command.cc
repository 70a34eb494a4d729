#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "base/errors.h"
#include "base/files.h"
#include "base/printed.h"
#include "base/signals.h"
#include "commands/campaign.h"
#include "commands/clock_options.h"
#include "commands/commands.h"
#include "commands/control_place.h"
#include "commands/evidence.h"
#include "commands/first_scenario.h"
#include "commands/log.h"
#include "commands/network_options.h"
#include "commands/rehearsal_before.h"
#include "commands/set_options.h"
#include "ctl/check.h"
#include "rehearse/outputs.h"
#include "rehearse/rehearse.h"
#include "rehearse/repeat.h"
#include "rehearse/run_campaign.h"
#include "rehearse/scenario.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastLimit = 1, kMostLimit = 1e9;  // of --run-limit, s

// Wall s in which it has to end unless --run-limit says otherwise.
double LimitOf(const config::Config& config) {
  const double speed = config.time.speed > 0 ? config.time.speed : 1;
  return rehearse::kRunLimit + std::max(0.0, config.time.duration) / speed;
}

// As rehearse::FirstDifference, of all robots.
std::optional<rehearse::Difference> FirstDifference(const std::vector<fs::path>& first,
                                                    const std::vector<fs::path>& second) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    auto found = rehearse::FirstDifference(*record::OpenRecording(first[i]),
                                           *record::OpenRecording(second[i]));
    if (found && i > 0) found->text = second[i].filename().string() + ": " + found->text;
    if (found) return found;
  }
  return std::nullopt;
}

// The line that does the same again, with the seed that was drawn.
std::string RepeatLine(const RehearseArguments& arguments, const rehearse::Judged& judged) {
  std::vector<std::string> words{"understudy", "rehearse", arguments.scenario};
  if (arguments.run > 0) words.insert(words.end(), {"--run", std::to_string(arguments.run)});
  for (const std::string& word : OptionsOf(arguments)) words.push_back(word);
  if (arguments.twice) words.emplace_back("--twice");
  const auto seed = judged.about.find("seed");
  const bool drawn = seed != judged.about.end() && !seed->second.empty();
  if (drawn && arguments.run == 0) words.insert(words.end(), {"--seed", seed->second});
  AddCommand(arguments.command, &words);
  return rehearse::ShellText(words);
}

std::string JudgeLine(const RehearseArguments& arguments, const fs::path& recording) {
  std::vector<std::string> words{"understudy", "judge", recording, arguments.scenario};
  if (arguments.run > 0) words.insert(words.end(), {"--run", std::to_string(arguments.run)});
  return rehearse::ShellText(words);
}

rehearse::ScenarioOptions ScenarioOptionsOf(const RehearseArguments& arguments) {
  return {.command = arguments.command,
          .sets = arguments.sets,
          .run = arguments.run,
          .simulated_clock = arguments.clock.simulated(),
          .typed = arguments.typed};
}

// One rehearsal, from its scenario to its report.
class OneRehearsal {
 public:
  // Throws ConfigError, and what SimulatedClock does.
  OneRehearsal(RehearseArguments arguments, const fs::path& file)
      : arguments_(std::move(arguments)),
        file_(file),
        scenario_(rehearse::LoadScenario(file, ScenarioOptionsOf(arguments_))) {
    if (scenario_.program && scenario_.program->command.empty()) {
      throw ConfigError(file.string() + ": program: this scenario needs one: understudy rehearse " +
                        arguments_.scenario + " -- CMD...");
    }
    if (scenario_.simulated_clock) TakeClock();
    folder_ = OwnFolder(FolderOf(arguments_.out, file, arguments_.run));
  }

  // Returns the exit code.
  int Run() {
    if (arguments_.twice) {
      if (const int code = PlayBefore(arguments_, First()); !IsJudged(code)) return code;
      TakeStartOfFirst();
    }
    rehearse::Rehearsal rehearsal = Play();
    if (clock_) {
      clock_->RequireProgram(scenario_.program->command);
      unrepeatable_ = clock_->coordinator()->unrepeatable();
    }
    if (arguments_.twice) Compare(&rehearsal.judged);
    const int code = TellVerdicts(OccasionOf(rehearsal), scenario_.expect, rehearsal.judged,
                                  folder_, arguments_.json);
    return rehearsal.robot == ExitCode::kOk ? code : static_cast<int>(rehearsal.robot);
  }

 private:
  fs::path First() const { return folder_ / "first"; }
  std::vector<fs::path> RecordingsIn(const fs::path& folder) const {
    return RecordingsOf(folder / "recording.mcap", scenario_.config);
  }

  // The seed that it drew, and its date: the stamps of ROS's messages are dates.
  void TakeStartOfFirst() {
    const auto about = record::OpenRecording(RecordingsIn(First()).front())->contents().metadata;
    const record::StringMap& run = about.at("understudy");
    if (const std::string& seed = run.at("seed"); !seed.empty()) {
      scenario_.config.randomization.seed = std::stoi(seed);
    }
    start_ = std::stoull(run.at("start_time_ns"));
  }

  void TakeClock() {
    if (arguments_.network.network != "private") {
      throw ConfigError(file_.string() + ": clock: simulated needs --network private");
    }
    RequireTakesClock(scenario_.program->command);
    ClockArguments& clock = arguments_.clock;
    if (clock.measures) {
      const auto found = simclock::ThinkOfStart();
      clock.think = found ? 1e-6 * static_cast<double>(found->count()) : MeasureThink(arguments_);
      clock.measures = false;
    }
    think_ = clock.think > 0 ? clock.think : 1e3 * scenario_.program->think;
    clock_.emplace(think_);
  }

  rehearse::Rehearsal Play() {
    const ControlPlace place("", scenario_.config);
    RunNetwork network(arguments_.network, &scenario_.config);
    exec::ChildProcess::Environment environment = place.environment();
    if (clock_) {
      clock_->Start(scenario_.config.time.realtime);
      clock_->AddTo(&environment);
    }
    // The program is forked before any thread exists.
    std::optional<exec::ProgramOutput> output, errors;
    std::optional<exec::ChildProcess> program;
    if (scenario_.program) {
      if (const auto printed = PrintedTexts(); !printed.empty()) output.emplace(printed);
      errors.emplace(std::vector<std::string>{}, STDERR_FILENO);
      program.emplace(scenario_.program->command, environment, errors->descriptor(),
                      output ? output->descriptor() : -1, network.program_rights());
    }
    network.Settle();
    if (clock_ && arguments_.clock.trace) clock_->Trace();
    if (output) output->Start();
    if (errors) errors->Start();
    StartLog({.level = arguments_.log_level, .json = false, .status_line = false});
    CatchStopSignals();
    const auto interrupted = [this] {
      return StopSignal() != 0 || (clock_ && clock_->coordinator()->program_is_missing());
    };
    return rehearse::Rehearse(
        scenario_,
        {.access = place.access(),
         .recording = folder_ / "recording.mcap",
         .late_messages = think_ > 0,
         .start = start_,
         .private_network = network.is_private(),
         .to_the_end = arguments_.to_the_end,
         .interrupted = interrupted,
         .limit = arguments_.campaign.limit.value_or(LimitOf(scenario_.config)),
         .programs = clock_ ? clock_->coordinator() : nullptr,
         .output = output ? &*output : nullptr,
         .errors = errors ? &*errors : nullptr},
        program ? &*program : nullptr);
  }

  // What the program may print that script and expectations wait for.
  std::vector<std::string> PrintedTexts() const {
    std::vector<signals::Signal> heard = scenario_.script.conditions.signals;
    heard.insert(heard.end(), scenario_.expect.signals.begin(), scenario_.expect.signals.end());
    return signals::PrintedTexts(heard);
  }

  void Compare(rehearse::Judged* judged) {
    const auto differs = FirstDifference(RecordingsIn(First()), RecordingsIn(folder_));
    repeats_ = !differs;
    if (!differs) return;
    judged->failures.push_back({"the second run", "differs from the first: " + differs->text});
    if (unrepeatable_.empty()) {
      unrepeatable_ = VerdictOf(First(), "unrepeatable").get<std::string>();
    }
    unrepeatable_ = rehearse::CauseOf(
        *differs, {.with_program = scenario_.program.has_value(),
                   .simulated_clock = clock_.has_value(),
                   .realtime_priority = clock_ && clock_->coordinator()->has_priority(),
                   .private_network = arguments_.network.network == "private",
                   .unrepeatable = unrepeatable_});
  }

  std::optional<double> ComputedMs() const {
    const auto time = clock_ ? clock_->computed() : std::nullopt;
    return time ? std::optional(1e-6 * static_cast<double>(time->count())) : std::nullopt;
  }

  rehearse::Occasion OccasionOf(const rehearse::Rehearsal& rehearsal) {
    const std::vector<fs::path> recordings = RecordingsIn(folder_);
    std::string title = scenario_.name;
    if (arguments_.run > 0) {
      title += ", run " + std::to_string(arguments_.run) + ": " + SettingsText(scenario_.settings);
    }
    std::vector<std::string> script;
    for (const emulator::ScriptEvent& event : scenario_.script.events) {
      script.push_back(emulator::Describe(event.request));
    }
    return {.title = title,
            .about = scenario_.about,
            .robot = RobotsText(scenario_.config),
            .source = file_,
            .recording = recordings.front(),
            .judge = JudgeLine(arguments_, recordings.front()),
            .repeat = RepeatLine(arguments_, rehearsal.judged),
            .scenario = FileText(file_),
            .script = script,
            .stopped = rehearsal.stopped,
            .clock = !scenario_.program          ? ""
                     : scenario_.simulated_clock ? "simulated"
                                                 : "real",
            .think = think_,
            .computed = ComputedMs(),
            .unrepeatable = unrepeatable_,
            .repeats = repeats_,
            .ladder = Climb(rehearse::OpenRecordings(recordings), scenario_.stages,
                            scenario_.config, rehearsal.judged, folder_),
            .pictures = PicturesFor(arguments_, scenario_.expect, rehearsal.judged,
                                    scenario_.config, recordings, folder_),
            .wall = rehearsal.wall};
  }

  RehearseArguments arguments_;  // with the `think` that was measured
  double think_ = 0;             // ms
  fs::path file_;
  rehearse::Scenario scenario_;
  std::optional<SimulatedClock> clock_;
  fs::path folder_;
  std::optional<std::uint64_t> start_;  // of the second run of --twice
  std::optional<bool> repeats_;         // of --twice
  std::string unrepeatable_;            // why two runs differ, or may; "": no cause is known
};

int RehearseCommand(const RehearseArguments& arguments) {
  if (arguments.words) {
    std::printf("%s\n%s\n%s", rehearse::ScenarioReference().c_str(),
                rehearse::ExpectationsReference().c_str(), signals::SignalsReference().c_str());
    return 0;
  }
  if (!arguments.init.empty()) return WriteFirstScenario(arguments.init, arguments.command);
  if (!arguments.campaign.merge.empty())
    return MergeCommand(arguments.campaign, arguments.out, arguments.json);
  const fs::path file = FindScenario(arguments.scenario);
  if (arguments.run > 0) return OneRehearsal(arguments, file).Run();
  if (const auto varied = rehearse::LoadVaried(file)) {
    if (arguments.twice) {
      throw ConfigError("--twice plays one run of a scenario with `vary`: which, --run says");
    }
    RehearseArguments of_runs = arguments;
    if (of_runs.clock.measures) {  // once, of the first run, for all
      of_runs.run = 1;
      of_runs.clock.think = MeasureThink(of_runs);
    }
    return CampaignCommand({.file = file,
                            .written = arguments.scenario,
                            .varied = *varied,
                            .options = ScenarioOptionsOf(arguments),
                            .words = OptionsOf(of_runs),
                            .out = FolderOf(arguments.out, file),
                            .host_network = arguments.network.network == "host",
                            .json = arguments.json},
                           arguments.campaign);
  }
  RequireNone(arguments.campaign, file);
  return OneRehearsal(arguments, file).Run();
}

}  // namespace

void AddRehearseCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<RehearseArguments>();
  CLI::App* rehearse =
      app->add_subcommand("rehearse", "Play a scenario and judge what was expected of it");
  rehearse
      ->add_option("scenario", arguments->scenario,
                   "File of a scenario, or the name of one that is shipped")
      ->type_name("SCENARIO");
  rehearse
      ->add_option("--init", arguments->init,
                   "Write a first scenario of the program after --, with the standard set, and "
                   "exit")
      ->type_name("NAME.yaml");
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
  rehearse->add_flag("--twice", arguments->twice,
                     "Play it twice and fail if the second run says another thing than the first");
  rehearse
      ->add_option(
          "--run-limit", arguments->campaign.limit,
          "Wall time, s, after which a rehearsal, or a run of a campaign, is ended and has "
          "failed [3600 more than a rehearsal's duration]")
      ->type_name("S")
      ->check(ctl::NumberWithin(kLeastLimit, kMostLimit));
  AddCampaignOptions(rehearse, &arguments->campaign);
  AddNetworkOptions(rehearse, &arguments->network);
  AddClockOptions(rehearse, &arguments->clock);
  rehearse->add_option("--log-level", arguments->log_level, "debug, info, warn or error [warn]")
      ->check(CLI::IsMember({"debug", "info", "warn", "error"}));
  rehearse
      ->add_option("command", arguments->command,
                   "The program under test and its arguments, after --")
      ->type_name("CMD...");
  rehearse->footer(
      "Examples:\n"
      "  understudy rehearse stand_up\n"
      "  understudy rehearse --init first.yaml -- python3 walk.py lo\n"
      "  understudy rehearse walk.yaml -- python3 walk.py lo\n"
      "  understudy rehearse walk.yaml --interface-name eth0 -- python3 walk.py eth0\n"
      "  understudy rehearse walk.yaml --clock simulated --twice -- python3 walk.py lo\n"
      "  understudy rehearse push.yaml --set terrain.friction=0.3 --out results\n"
      "  understudy rehearse shoves.yaml --jobs 8        # a campaign: it has `vary`\n"
      "  understudy rehearse shoves.yaml --run 7         # its 7th run, with all evidence\n"
      "  understudy rehearse shoves.yaml --shard 2/4 --out part2\n"
      "  understudy rehearse --merge part1 part2 part3 part4 --out all\n"
      "Exits with 0 if all expectations hold, 10 if one failed, 11 if none failed and one could\n"
      "not be judged. docs/reference/scenarios.md has the words of scenarios.");
  rehearse->callback([=] {
    const bool merges = !arguments->campaign.merge.empty();
    if (!arguments->init.empty()) {
      // CLI11 gives the first word of the command to the scenario.
      if (arguments->scenario.empty()) throw CLI::RequiredError("CMD");
      arguments->command.insert(arguments->command.begin(), std::exchange(arguments->scenario, ""));
    } else if (arguments->scenario.empty() && !arguments->words && !merges) {
      throw CLI::RequiredError("SCENARIO");
    }
    RequireConsistent(arguments->network);
    RequireConsistent(arguments->clock, arguments->network);
    *chosen = [=] { return RehearseCommand(*arguments); };
  });
}

}  // namespace understudy::commands
