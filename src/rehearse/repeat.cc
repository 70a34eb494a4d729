#include "rehearse/repeat.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/printed.h"
#include "record/schema_field.h"
#include "record/truth.h"

namespace understudy::rehearse {
namespace {

using record::RecordingReader;

constexpr std::uint64_t kWindow = 1'000'000'000;  // ns that are in memory at once

struct Said {
  std::uint64_t at = 0;  // ns since the start
  std::vector<std::byte> bytes;

  bool operator==(const Said&) const = default;
};

// What was said on one topic.
struct Topic {
  std::string schema{};  // of its type
  bool is_programs = false;
  std::size_t before = 0;  // messages before this window
  std::vector<Said> said{};
};
using Topics = std::map<std::string, Topic>;  // by "/lowcmd from client"

std::uint64_t StartOf(const RecordingReader& reader) {
  std::uint64_t start = reader.contents().first_time;
  if (const auto about = reader.contents().metadata.find("understudy");
      about != reader.contents().metadata.end()) {
    if (const auto text = about->second.find("start_time_ns"); text != about->second.end()) {
      std::from_chars(text->second.data(), text->second.data() + text->second.size(), start);
    }
  }
  return start;
}

// Reads the messages from `from` [ns since the start] on.
void ReadWindow(const RecordingReader& reader, std::uint64_t from, Topics* topics) {
  const std::uint64_t start = StartOf(reader);
  for (auto& [name, topic] : *topics) {
    topic.before += topic.said.size();
    topic.said.clear();
  }
  reader.ReadMessages(
      start + from, start + from + kWindow - 1,
      [&](const record::McapChannel& channel, const record::McapMessage& message) {
        const auto who = channel.metadata.find("from");
        Topic& topic = (*topics)[channel.topic +
                                 (who == channel.metadata.end() ? "" : " from " + who->second)];
        const record::McapSchema* const schema = reader.SchemaOf(channel);
        if (schema != nullptr) topic.schema = schema->data;
        topic.is_programs = who != channel.metadata.end() && who->second == "client";
        topic.said.push_back(
            {.at = message.log_time - start, .bytes = {message.data.begin(), message.data.end()}});
        return true;
      });
}

std::string TimeText(std::uint64_t ns) { return Printed("%.6g s", 1e-9 * static_cast<double>(ns)); }

// "motor_cmd[3].q was 0.67, then 0.68", or "byte 52".
std::string BytesText(const std::string& schema, const std::vector<std::byte>& first,
                      const std::vector<std::byte>& second) {
  const auto at =
      static_cast<std::size_t>(std::ranges::mismatch(first, second).in1 - first.begin());
  // Up to there both are the same: in both the value is at one place.
  const std::optional<record::SchemaField> field = record::FieldWithByte(schema, first, at);
  if (field) {
    return field->path + " was " + ValueText(*field, first) + ", then " + ValueText(*field, second);
  }
  if (first.size() != second.size()) {
    return Printed("was %zu bytes long, then %zu", first.size(), second.size());
  }
  return Printed("byte %zu differs", at);
}

// Whether a message is the program's, or an event that says something of it.
bool IsOfProgram(const std::string& name, const Topic& topic, const Said& said) {
  if (name.starts_with(record::kEventTopic)) {
    return record::DecodeEvent(said.bytes).kind.starts_with("program_");
  }
  return topic.is_programs;
}

// The first of one topic in this window.
std::optional<Difference> Between(const std::string& name, const Topic& first,
                                  const Topic& second) {
  const auto places = std::ranges::mismatch(first.said, second.said);
  const auto one = places.in1, other = places.in2;
  const bool in_first = one != first.said.end(), in_second = other != second.said.end();
  if (!in_first && !in_second) return std::nullopt;
  const auto difference = [&](std::uint64_t at, const std::string& text) {
    const std::size_t number =
        first.before + static_cast<std::size_t>(one - first.said.begin()) + 1;
    return Difference{.at = 1e-9 * static_cast<double>(at),
                      .text = "message " + std::to_string(number) + " of " + name + text,
                      .of_program = (in_first && IsOfProgram(name, first, *one)) ||
                                    (in_second && IsOfProgram(name, second, *other))};
  };
  if (!in_first || !in_second) {
    const std::uint64_t at = in_first ? one->at : other->at;
    return difference(
        at, " at " + TimeText(at) + " is only in the " + (in_first ? "first" : "second") + " run");
  }
  if (one->at != other->at) {
    return difference(std::min(one->at, other->at),
                      " was at " + TimeText(one->at) + ", then at " + TimeText(other->at));
  }
  return difference(one->at, " at " + TimeText(one->at) + ": " +
                                 BytesText(first.schema, one->bytes, other->bytes));
}

}  // namespace

std::optional<Difference> FirstDifference(const RecordingReader& first,
                                          const RecordingReader& second) {
  const auto length = [](const RecordingReader& reader) {
    return std::max(reader.contents().last_time, StartOf(reader)) - StartOf(reader);
  };
  const std::uint64_t end = std::max(length(first), length(second));
  Topics of_first, of_second;
  for (std::uint64_t from = 0; from <= end; from += kWindow) {
    ReadWindow(first, from, &of_first);
    ReadWindow(second, from, &of_second);
    for (const auto& [name, topic] : of_first) of_second[name];
    std::optional<Difference> found;
    for (const auto& [name, topic] : of_second) {
      const std::optional<Difference> one = Between(name, of_first[name], topic);
      if (!one) continue;
      // What the program says comes before what the robot makes of it.
      const auto order = [](const Difference& of) { return std::pair(of.at, !of.of_program); };
      if (!found || order(*one) < order(*found)) found = one;
    }
    if (found) return found;
  }
  return std::nullopt;
}

std::string CauseOf(const Difference& difference, const Repeated& runs) {
  if (!runs.unrepeatable.empty()) return runs.unrepeatable;
  if (runs.with_program && !runs.simulated_clock) {
    return "the program is on the computer's clock: --clock simulated puts it on the robot's";
  }
  if (!runs.private_network) return "others on the network are on the computer's clock";
  if (difference.of_program) {
    return std::string("the program itself: it draws chance from the system, or its threads race") +
           (runs.realtime_priority ? "" : ", as they had no real-time priority");
  }
  return "a request by ctl or the panel, or a fault of Understudy: the program has no part in it";
}

}  // namespace understudy::rehearse
