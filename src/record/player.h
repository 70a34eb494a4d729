// Plays the messages of a recording at their recorded times.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "record/recording_reader.h"
#include "time/clock.h"

namespace understudy::record {

// Whose messages are played.
enum class PlayedSide { kRobot, kClients };

struct PlayOptions {
  PlayedSide side = PlayedSide::kRobot;
  double from = 0, to = 0;            // s since its first message; `to` 0: its last
  double speed = 1;                   // recorded seconds per wall second; 0 = as fast as possible
  bool loop = false;                  // repeats without end
  std::vector<std::string> topics{};  // ROS or DDS names; empty: all
};

// A topic to be played.
struct PlayedTopic {
  std::string topic;  // on the wire: "rt/lowstate"
  std::string type;   // on the wire
  std::uint64_t messages = 0;
};

// Returns whether the channel has messages of that side. Our recordings say so; for others the
// topic's name decides. False for channels that were not on the wire, such as the truth.
bool IsOf(const McapChannel& channel, PlayedSide side);

// Returns the DDS name of a channel's topic: "rt/lowstate" for "/lowstate". What the simulation
// says itself is not on the wire and keeps its name: "/tf".
std::string TopicOnWire(const McapChannel& channel);

// Returns the time [s] from the first to the last message.
double Duration(const McapContents& contents);

class Player {
 public:
  // Throws RecordError, with the nearest topic, if the recording has none of the requested
  // messages. `reader` and `clock` must outlive the player.
  Player(const RecordingReader* reader, PlayOptions options, time::Clock* clock);

  // By channel id.
  const std::map<std::uint16_t, PlayedTopic>& topics() const { return topics_; }

  // Is called with each message when it is due and, with nullptr, at least every 20 ms while
  // waiting and at the end. `at` is s since the recording's first message. Returning false ends the
  // playing.
  using Say = std::function<bool(double at, const McapMessage* message)>;
  void Play(const Say& say);

 private:
  bool PlayOnce(const Say& say);  // false if `say` ended it

  const RecordingReader* reader_;
  PlayOptions options_;
  time::Clock* clock_;
  std::map<std::uint16_t, PlayedTopic> topics_;
};

}  // namespace understudy::record
