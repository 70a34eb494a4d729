#include <algorithm>
#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "commands/commands.h"
#include "record/player.h"
#include "record/recording_reader.h"

namespace understudy::commands {
namespace {

using nlohmann::ordered_json;

ordered_json Describe(const record::RecordingReader& reader) {
  const record::McapContents& contents = reader.contents();
  ordered_json channels = ordered_json::array();
  for (const auto& [id, channel] : contents.channels) {
    const record::McapSchema* schema = reader.SchemaOf(channel);
    const auto count = contents.counts.find(id);
    const auto from = channel.metadata.find("from");
    channels.push_back({{"topic", record::TopicOnWire(channel)},
                        {"type", schema == nullptr ? "" : schema->name},
                        {"from", from == channel.metadata.end() ? "" : from->second},
                        {"messages", count == contents.counts.end() ? 0 : count->second}});
  }
  ordered_json attachments = ordered_json::array();
  for (const record::McapAttachment& attachment : contents.attachments) {
    attachments.push_back({{"name", attachment.name}, {"bytes", attachment.size}});
  }
  const auto about = contents.metadata.find("understudy");
  return {{"file", reader.path().string()},
          {"library", contents.library},
          {"about", about == contents.metadata.end() ? record::StringMap() : about->second},
          {"seconds", record::Duration(contents)},
          {"messages", contents.messages},
          {"cut_short", contents.cut_short},
          {"channels", channels},
          {"attachments", attachments}};
}

// Returns a text of the JSON, "" if there is none.
std::string TextOf(const ordered_json& object, const char* key) {
  return Printable(object.value(key, ""));
}

int RecordingCommand(const std::string& file, bool as_json) {
  const auto reader = record::OpenRecording(file);
  const ordered_json told = Describe(*reader);
  if (as_json) {
    std::puts(told.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
    return 0;
  }
  const auto& about = told["about"];
  const double seconds = told["seconds"];
  const std::string who =
      about.contains("robot") ? TextOf(about, "robot") : TextOf(told, "library");
  std::printf("%s: %s, %.3f s, %llu messages\n", file.c_str(), who.c_str(), seconds,
              static_cast<unsigned long long>(reader->contents().messages));
  if (about.contains("started")) {
    const std::string seed = TextOf(about, "seed");
    std::printf("  begun %s by understudy %s%s\n", TextOf(about, "started").c_str(),
                TextOf(about, "version").c_str(), seed.empty() ? "" : (", seed " + seed).c_str());
  }
  if (!reader->contents().cut_short.empty()) {
    std::printf("  cut short: %s\n", TextOf(told, "cut_short").c_str());
  }
  std::size_t width = 0;
  for (const auto& channel : told["channels"]) {
    width = std::max(width, TextOf(channel, "topic").size());
  }
  for (const auto& channel : told["channels"]) {
    const auto messages = channel["messages"].get<std::uint64_t>();
    std::printf("  %-*s %9llu %7.1f Hz  %-10s %s\n", static_cast<int>(width),
                TextOf(channel, "topic").c_str(), static_cast<unsigned long long>(messages),
                seconds > 0 ? static_cast<double>(messages) / seconds : 0,
                TextOf(channel, "from").c_str(), TextOf(channel, "type").c_str());
  }
  for (const auto& attachment : told["attachments"]) {
    std::printf("  %s, %llu bytes\n", TextOf(attachment, "name").c_str(),
                static_cast<unsigned long long>(attachment["bytes"].get<std::uint64_t>()));
  }
  return 0;
}

}  // namespace

void AddRecordingCommand(CLI::App* app, Chosen* chosen) {
  const auto file = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  CLI::App* recording = app->add_subcommand("recording", "Say what a recording holds");
  recording->add_option("file", *file, "The recording: MCAP, or a ROS 2 bag, .db3 or its folder")
      ->required()
      ->type_name("FILE");
  recording->add_flag("--json", *json, "As a JSON object");
  recording->footer(
      "Examples:\n"
      "  understudy recording walk.mcap         topics, counts, duration, robot\n"
      "  understudy recording walk.mcap --json\n"
      "A recording is made by understudy run ROBOT --record FILE.mcap.");
  recording->callback([=] { *chosen = [=] { return RecordingCommand(*file, *json); }; });
}

}  // namespace understudy::commands
