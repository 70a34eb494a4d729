#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/exit_code.h"
#include "base/signals.h"
#include "base/standard_error.h"
#include "bus/cdr.h"
#include "bus/cyclone_log.h"
#include "commands/commands.h"
#include "commands/log.h"
#include "config/config.h"
#include "idl/type_table.h"
#include "record/player.h"
#include "run/alone.h"
#include "time/clock.h"
#include "time/pace.h"
#include "wire/robot_rank.h"
#include "wire/strangers.h"

namespace understudy::commands {
namespace {

// The command line.
struct PlayArguments {
  std::string file;
  bool commands = false;
  std::string speed = "1";
  record::PlayOptions options;
  config::NetworkConfig network;
  bool json = false;
};

using std::chrono::milliseconds;

// How long to wait for readers; *assumed*, several times the duration of discovery.
constexpr milliseconds kMatchPatience(1000);
// A reader that we have discovered may not have discovered us yet, which DDS does not report;
// *assumed*, several times the difference between the two sides.
constexpr milliseconds kMutual(200);
constexpr milliseconds kDrawEvery(200);

double SpeedOf(const std::string& text) { return text == "max" ? 0 : std::stod(text); }

std::string CheckSpeed(const std::string& text) {
  double speed = 0;
  const bool number = CLI::detail::lexical_cast(text, speed) && time::IsSpeed(speed);
  if (text == "max" || number) return {};
  return std::string("expected ") + time::kSpeedRange + ", found '" + text + "'";
}

// A progress line on a terminal.
class Progress {
 public:
  Progress(bool shown, double to) : shown_(shown), to_(to) {}
  ~Progress() {
    if (drawn_) WriteToStandardError("\r\033[K");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Update(double at, std::uint64_t messages, time::Clock::Time now) {
    if (!shown_ || (drawn_ && now - drawn_at_ < kDrawEvery)) return;
    WriteToStandardError(fmt::format("\r\033[K{:.1f} of {:.1f} s  {} messages", at, to_, messages));
    drawn_ = true;
    drawn_at_ = now;
  }

 private:
  bool shown_;
  double to_;
  bool drawn_ = false;
  time::Clock::Time drawn_at_{};
};

// The writers of all played topics, by channel.
class Wire {
 public:
  Wire(const bus::Participant& participant, const record::Player& player) {
    for (const auto& [channel, topic] : player.topics()) {
      const MessageType* type = FindMessageType(topic.type);
      if (type == nullptr) {
        spdlog::warn("{} is left out: its type is not one of the vendor's", topic.topic);
        continue;
      }
      writers_.emplace(channel, bus::CdrWriter(participant, topic.topic, *type->descriptor));
    }
  }

  // Waits until every topic has a reader (`all`) or any topic has. Later readers miss the
  // beginning.
  void WaitForReaders(bool all, time::Clock* clock) const {
    const time::Clock::Time end = clock->Now() + kMatchPatience;
    const auto is_heard = [](const auto& writer) { return writer.second.matched_readers() > 0; };
    while (clock->Now() < end && StopSignal() == 0 &&
           !(all ? std::ranges::all_of(writers_, is_heard)
                 : std::ranges::any_of(writers_, is_heard))) {
      clock->SleepUntil(clock->Now() + milliseconds(10));
    }
    clock->SleepUntil(clock->Now() + kMutual);
  }

  void Write(const record::McapMessage& message) {
    const auto writer = writers_.find(message.channel_id);
    if (writer == writers_.end()) return;
    if (writer->second.Write(message.data)) {
      ++sent_;
    } else {
      ++damaged_;
    }
  }
  std::uint64_t sent() const { return sent_; }
  std::uint64_t damaged() const { return damaged_; }

 private:
  std::map<std::uint16_t, bus::CdrWriter> writers_;
  std::uint64_t sent_ = 0, damaged_ = 0;
};

// Waits for a writer of rt/lowstate. Throws BusError if none is found in time.
void WaitForRobot(wire::StrangerWatch* watch, const bus::Participant& participant,
                  time::Clock* clock) {
  const time::Clock::Time end = clock->Now() + kMatchPatience;
  while (watch->Poll().spoke.empty() && watch->speaking().empty()) {
    if (clock->Now() > end) {
      throw BusError("no robot publishes on " + participant.interface() + ", domain " +
                     std::to_string(participant.domain()) +
                     "; start one (`understudy run`), then play the commands to it");
    }
    clock->SleepUntil(clock->Now() + milliseconds(10));
  }
}

// Opens the recording, joins the bus, waits for readers or a robot, and plays.
int PlayCommand(const PlayArguments& arguments) {
  // Options and recording.
  record::PlayOptions options = arguments.options;
  options.side = arguments.commands ? record::PlayedSide::kClients : record::PlayedSide::kRobot;
  options.speed = SpeedOf(arguments.speed);
  const auto opened = record::OpenRecording(arguments.file);
  const record::RecordingReader& reader = *opened;
  const double end = options.to > 0 ? options.to : record::Duration(reader.contents());
  if (!(options.from < end)) {  // also refuses NaN
    throw RecordError(arguments.file + ": --from is past the end, " + std::to_string(end) + " s");
  }
  // Player and log.
  time::SteadyClock clock;
  record::Player player(&reader, options, &clock);
  const bool terminal = isatty(STDERR_FILENO) == 1 && !arguments.json;
  StartLog({.level = "info", .json = arguments.json, .status_line = terminal});
  CatchStopSignals();
  const std::string known = reader.contents().cut_short;
  if (!known.empty()) spdlog::warn("the recording was cut short: {}", known);

  // Network: a robot for the commands, or no other robot.
  const std::int64_t since =
      std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  const bus::Participant participant(arguments.network.interface, arguments.network.domain,
                                     arguments.commands ? "" : wire::AnnounceRobot(since));
  wire::StrangerWatch watch(participant);
  if (arguments.commands) {
    WaitForRobot(&watch, participant, &clock);
  } else {
    run::RefuseToStartBeside(&watch, clock.Now(), participant, config::GuardConfig{}, false,
                             &clock);
  }
  Wire wire(participant, player);
  wire.WaitForReaders(arguments.commands, &clock);
  spdlog::info("playing {} on {}, domain {}", arguments.file, participant.interface(),
               participant.domain());

  // Play.
  Progress progress(terminal, end);
  ExitCode code = ExitCode::kOk;
  player.Play([&](double at, const record::McapMessage* message) {
    if (message != nullptr) wire.Write(*message);
    progress.Update(at, wire.sent(), clock.Now());
    if (StopSignal() != 0) return false;
    auto news = watch.Poll();
    std::erase_if(news.spoke, [&](const bus::Neighbour& one) {  // those yield
      return watch.KindOf(one) == wire::StrangerWatch::Kind::kYounger;
    });
    if (!arguments.commands && !news.spoke.empty()) {
      spdlog::critical("another robot publishes on this network: {}; stopping",
                       wire::Describe(news.spoke));
      code = ExitCode::kNeighbour;
      return false;
    }
    return true;
  });
  // Report.
  if (reader.contents().cut_short != known) {
    spdlog::warn("the recording was cut short: {}", reader.contents().cut_short);
  }
  for (const bus::CycloneNotice& notice : bus::TakeCycloneNotices()) {
    spdlog::warn("Cyclone DDS: {}", notice.text());
  }
  if (wire.damaged() > 0) {
    spdlog::warn("{} messages do not fit their type and were left out", wire.damaged());
  }
  spdlog::info("{} messages were played", wire.sent());
  return static_cast<int>(code);
}

}  // namespace

void AddPlayCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<PlayArguments>();
  CLI::App* play = app->add_subcommand(
      "play", "Replay a recording: the robot's messages, or those of its clients");
  play->add_option("file", arguments->file, "The recording, MCAP")->required()->type_name("FILE");
  play->add_flag("--commands", arguments->commands,
                 "Play the clients' commands and requests to a running robot");
  play->add_option("--speed", arguments->speed,
                   "Recorded seconds per wall second; max = as fast as possible [1]")
      ->type_name("X")
      ->check(CheckSpeed);
  play->add_flag("--loop", arguments->options.loop, "Again and again");
  play->add_option("--from", arguments->options.from, "Seconds to begin after [0]")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber);
  play->add_option("--to", arguments->options.to, "Seconds to end after [the recording's end]")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  play->add_option("--topics", arguments->options.topics, "Only these [all]")
      ->type_name("TOPIC,...")
      ->delimiter(',');
  play->add_option("--interface", arguments->network.interface, "Network interface [lo]")
      ->type_name("NAME");
  play->add_option("--domain", arguments->network.domain, "DDS domain [0]")->type_name("N");
  play->add_flag("--json", arguments->json, "Log as one JSON object a line");
  play->footer(
      "Messages of the robot are never played beside a live robot.\n"
      "Examples:\n"
      "  understudy play walk.mcap                          programs receive the recorded robot\n"
      "  understudy play walk.mcap --speed 0.2 --loop --topics rt/lowstate\n"
      "  understudy play walk.mcap --commands --from 3      the same commands, to a robot of "
      "today\n"
      "Contents of a recording: understudy recording FILE");
  play->callback([=] { *chosen = [=] { return PlayCommand(*arguments); }; });
}

}  // namespace understudy::commands
