// What a recording says of a robot, at equal steps of time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "record/recording_reader.h"

namespace understudy::rehearse {

// A number that robots publish or are commanded. The row has its place in the messages of both
// families; "#" stands for a motor's slot.
struct Quantity {
  std::string_view name;  // "q", "imu.roll", ...
  std::string_view unit;
  std::string_view topic;
  std::string_view go, hg;  // field; "" where the family has none
  bool of_motor = false;
  std::string_view hg_topic{};  // where the hg family has it in another topic
  float hg_scale = 1;           // to the unit

  std::string_view TopicOf(bool is_hg) const {
    return is_hg && !hg_topic.empty() ? hg_topic : topic;
  }
};

// All of them: first those of motors.
const std::vector<Quantity>& Quantities();

// The values of a quantity, of one motor where it is a motor's: by step, the last value said before
// or at its time; NaN before the first.
struct Series {
  const Quantity* quantity = nullptr;
  int slot = -1;  // of the motor; -1: of the robot
  std::vector<float> values{};
};

struct Recorded {
  std::string file{};
  std::string robot{};                  // "" if the recording does not say
  std::map<int, std::string> joints{};  // by slot, without _joint; empty if it does not say
  bool hg = false;
  double step = 0;               // s
  std::vector<Series> series{};  // those of which the recording has values

  // Returns null if the recording does not have it.
  const Series* Find(std::string_view quantity, int slot = -1) const;
};

// Returns the s from the first message of rt/lowstate to the last. Throws RecordError if there are
// not two.
double SecondsOfStates(const record::RecordingReader& reader);

// Reads a recording from its first message of rt/lowstate on, at steps of `step` [s]. A command's
// kNoPosition is no value. Throws RecordError.
Recorded ReadRecorded(const record::RecordingReader& reader, double step);

}  // namespace understudy::rehearse
