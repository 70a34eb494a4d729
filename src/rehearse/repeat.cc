#include "rehearse/repeat.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "base/printed.h"
#include "record/cdr_field.h"

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
  std::string type{};      // its ROS name
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
        if (schema != nullptr) topic.type = schema->name;
        topic.said.push_back(
            {.at = message.log_time - start, .bytes = {message.data.begin(), message.data.end()}});
        return true;
      });
}

std::string TimeText(std::uint64_t ns) { return Printed("%.6g s", 1e-9 * static_cast<double>(ns)); }

// "motor_cmd[3].q was 0.67, then 0.68", or "byte 52".
std::string BytesText(const std::string& type, const std::vector<std::byte>& first,
                      const std::vector<std::byte>& second) {
  if (first.size() != second.size()) {
    return Printed("was %zu bytes long, then %zu", first.size(), second.size());
  }
  const auto at =
      static_cast<std::size_t>(std::ranges::mismatch(first, second).in1 - first.begin());
  const std::string path = record::FieldAt(type, at);
  if (path.empty()) return Printed("byte %zu differs", at);
  const record::CdrField field = record::FindField(type, path);
  const std::optional<double> was = record::ReadField(field, first);
  const std::optional<double> is = record::ReadField(field, second);
  if (!was || !is) return path + " differs";
  return path + Printed(" was %.9g, then %.9g", *was, *is);
}

struct Difference {
  std::uint64_t at = 0;
  std::string text{};
};

// The first of one topic in this window.
std::optional<Difference> Between(const std::string& name, const Topic& first,
                                  const Topic& second) {
  const auto [one, other] = std::ranges::mismatch(first.said, second.said);
  const bool in_first = one != first.said.end(), in_second = other != second.said.end();
  if (!in_first && !in_second) return std::nullopt;
  const std::string which =
      "message " +
      std::to_string(first.before + static_cast<std::size_t>(one - first.said.begin()) + 1) +
      " of " + name;
  if (!in_first || !in_second) {
    const std::uint64_t at = in_first ? one->at : other->at;
    return Difference{at, which + " at " + TimeText(at) + " is only in the " +
                              (in_first ? "first" : "second") + " run"};
  }
  if (one->at != other->at) {
    return Difference{std::min(one->at, other->at),
                      which + " was at " + TimeText(one->at) + ", then at " + TimeText(other->at)};
  }
  return Difference{one->at, which + " at " + TimeText(one->at) + ": " +
                                 BytesText(first.type, one->bytes, other->bytes)};
}

}  // namespace

std::string FirstDifference(const RecordingReader& first, const RecordingReader& second) {
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
      if (one && (!found || one->at < found->at)) found = one;
    }
    if (found) return found->text;
  }
  return "";
}

}  // namespace understudy::rehearse
