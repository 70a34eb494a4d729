// Says again what a recording holds, at the pace at which it was said.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "record/mcap_reader.h"
#include "time/clock.h"

namespace understudy::record {

// Who said it.
enum class PlayedSide { kRobot, kClients };

struct PlayOptions {
  PlayedSide side = PlayedSide::kRobot;
  double from = 0, to = 0;            // s since its first message; `to` 0: its last
  double speed = 1;                   // recorded seconds per wall second; 0 = as fast as possible
  bool loop = false;                  // from the beginning again at the end, for ever
  std::vector<std::string> topics{};  // as ROS or as DDS spells them; empty: all
};

// A topic to be played.
struct PlayedTopic {
  std::string topic;  // on the wire: "rt/lowstate"
  std::string type;   // on the wire
  std::uint64_t messages = 0;
};

// Whose messages a channel holds: as the recording says, or, where somebody else recorded it, by
// the name of its topic. False for what was never on the wire.
bool IsOf(const McapChannel& channel, PlayedSide side);

// A topic as it is on the wire, of a channel: "/lowstate" is rt/lowstate.
std::string TopicOnWire(const McapChannel& channel);

// Seconds of log time that a recording spans.
double Duration(const McapContents& contents);

class Player {
 public:
  // Throws RecordError when the recording holds nothing that was asked for, naming the nearest
  // topic; `reader` and `clock` must outlive the player.
  Player(const McapReader* reader, PlayOptions options, time::Clock* clock);

  // By channel.
  const std::map<std::uint16_t, PlayedTopic>& topics() const { return topics_; }

  // Called with each message when its time has come, and, with no message, at least every 20 ms of
  // waiting and at every end; `at` is s since the recording's first message. Playing ends when it
  // says false.
  using Say = std::function<bool(double at, const McapMessage* message)>;
  void Play(const Say& say);

 private:
  bool PlayOnce(const Say& say);  // false when it was ended

  const McapReader* reader_;
  PlayOptions options_;
  time::Clock* clock_;
  std::map<std::uint16_t, PlayedTopic> topics_;
};

}  // namespace understudy::record
