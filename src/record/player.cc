#include "record/player.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/nearest_word.h"
#include "record/ros2msg.h"
#include "robot/command_topics.h"

namespace understudy::record {
namespace {

constexpr time::Clock::Time kSayEvery = std::chrono::milliseconds(20);

// Clamped to a century, which is longer than any recording and does not overflow.
time::Clock::Time Nanoseconds(double seconds) {
  constexpr double kMost = 3e9;  // s
  return time::Clock::Time(
      static_cast<std::int64_t>(seconds > 0 ? std::min(seconds, kMost) * 1e9 : 0));
}

// Topics that clients write on a real robot's network.
bool IsCommandTopic(const std::string& topic) {
  return robot::IsBodyCommandTopic(topic) || robot::IsHandCommandTopic(topic) ||
         (topic.starts_with("rt/api/") && topic.ends_with("/request"));
}

}  // namespace

bool IsOf(const McapChannel& channel, PlayedSide side) {
  const auto from = channel.metadata.find("from");
  if (from != channel.metadata.end()) {
    return from->second == (side == PlayedSide::kRobot ? "robot" : "client");
  }
  if (channel.encoding != "cdr" || !channel.topic.starts_with('/')) return false;
  return IsCommandTopic(TopicOnWire(channel)) == (side == PlayedSide::kClients);
}

std::string TopicOnWire(const McapChannel& channel) {
  const auto topic = channel.metadata.find("dds_topic");
  if (topic != channel.metadata.end()) return topic->second;
  const auto from = channel.metadata.find("from");
  if (from != channel.metadata.end() && from->second == "simulation") return channel.topic;
  return (channel.topic.starts_with('/') ? "rt" : "") + channel.topic;
}

double Duration(const McapContents& contents) {
  return static_cast<double>(contents.last_time - contents.first_time) * 1e-9;
}

Player::Player(const RecordingReader* reader, PlayOptions options, time::Clock* clock)
    : reader_(reader), options_(std::move(options)), clock_(clock) {
  std::set<std::string> known;
  std::set<std::string> asked(options_.topics.begin(), options_.topics.end());
  std::set<std::string> missing = asked;
  for (const auto& [id, channel] : reader_->contents().channels) {
    const McapSchema* schema = reader_->SchemaOf(channel);
    if (schema == nullptr || !IsOf(channel, options_.side)) continue;
    const std::string topic = TopicOnWire(channel);
    known.insert(topic);
    const bool wanted = asked.empty() || asked.contains(topic) || asked.contains(channel.topic);
    missing.erase(topic);
    missing.erase(channel.topic);
    const auto count = reader_->contents().counts.find(id);
    if (!wanted || count == reader_->contents().counts.end()) continue;
    topics_[id] = {.topic = topic, .type = TypeOnWire(schema->name), .messages = count->second};
  }
  const std::string who = options_.side == PlayedSide::kRobot ? "the robot" : "a client";
  if (!missing.empty()) {
    throw RecordError(reader_->path().string() + ": holds nothing that " + who + " said on '" +
                      *missing.begin() + "'" +
                      DidYouMean(*missing.begin(), {known.begin(), known.end()}));
  }
  if (topics_.empty()) {
    throw RecordError(reader_->path().string() + ": holds nothing that " + who + " said");
  }
}

void Player::Play(const Say& say) {
  while (PlayOnce(say) && options_.loop) {
  }
}

bool Player::PlayOnce(const Say& say) {
  const std::uint64_t beginning = reader_->contents().first_time;
  const std::uint64_t end = reader_->contents().last_time;
  const auto log_time = [=](double seconds) {
    const auto since = static_cast<std::uint64_t>(Nanoseconds(seconds).count());
    return beginning + std::min(since, end - beginning);
  };
  const std::uint64_t from = log_time(options_.from);
  const std::uint64_t to = std::max(from, options_.to > 0 ? log_time(options_.to) : end);
  const time::Clock::Time start = clock_->Now();
  bool goes_on = true;
  // Waits until log time `until` is due; returns false if `say` ended it.
  const auto wait = [&](std::uint64_t until) {
    if (options_.speed <= 0) return true;
    const time::Clock::Time due =
        start + Nanoseconds(static_cast<double>(until - from) * 1e-9 / options_.speed);
    for (time::Clock::Time now = clock_->Now(); now < due; now = clock_->Now()) {
      clock_->SleepUntil(std::min(due, now + kSayEvery));
      const double at =
          options_.from +
          std::chrono::duration<double>(clock_->Now() - start).count() * options_.speed;
      if (clock_->Now() < due && !say(at, nullptr)) return false;
    }
    return true;
  };
  reader_->ReadMessages(from, to, [&](const McapChannel& channel, const McapMessage& message) {
    if (!topics_.contains(channel.id)) return true;
    const double at = static_cast<double>(message.log_time - beginning) * 1e-9;
    goes_on = wait(message.log_time) && say(at, &message);
    return goes_on;
  });
  // Waits also for the time after the last played message. The last call of `say` lets it end a
  // loop that plays no message and never waits.
  return goes_on && wait(to) && say(static_cast<double>(to - beginning) * 1e-9, nullptr);
}

}  // namespace understudy::record
