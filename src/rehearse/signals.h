// The signals that conditions speak of: what each is, and where it comes from.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "judge/condition.h"
#include "record/truth.h"
#include "robot/robot_spec.h"

namespace understudy::rehearse {

// What a recording must have for a signal to be known.
enum class Origin : std::uint8_t { kTruth, kMessages, kEvents };

// A word of conditions.
struct SignalRow {
  std::string_view word;      // "base.height"; of one with an argument what stands before it
  std::string_view argument;  // "", JOINT, FOOT, TOPIC or EVENT
  std::string_view unit;
  Origin origin;
  std::string_view says;
  // For Origin::kTruth: its value; `index` is that of the joint or foot.
  double (*of)(const record::Truth& truth, std::size_t index);
};

// All words, in the order of the documentation. TOPIC:FIELD and EVENT.FIELD are no rows: there are
// as many as messages and events have fields.
std::span<const SignalRow> SignalRows();

// What the robot of a scenario or a recording has.
struct Names {
  std::vector<std::string> joints{};  // in motor order
  std::vector<int> slots{};           // of those joints that have one
  std::vector<std::string> feet{};
  std::map<std::string, std::string> topics{};  // ROS type by name on the wire, as far as known
};

Names NamesOf(const robot::RobotSpec& spec);

// A signal that a condition names.
struct Signal {
  enum class Source : std::uint8_t {
    kTruth,
    kField,       // of a message
    kGap,         // between the messages of a topic
    kArrival,     // of a message: their number at this instant
    kEventField,  // of the last event of a kind; a word is its number (Evidence::WordNumber)
    kEvent,       // their number at this instant
    kEventCount,  // their number so far
  };

  std::string name;  // as the condition has it
  std::string unit{};
  Source source = Source::kTruth;
  double (*of)(const record::Truth& truth, std::size_t index) = nullptr;  // kTruth
  std::size_t index = 0;
  std::string topic{}, field{};  // of messages, on the wire; of events kind and field

  Origin origin() const;
};

// Finds what a comparison is about. An Error has the nearest word.
Result<Signal> FindSignal(const judge::Comparison& comparison, const Names& names);

// Returns the factor from the unit of a signal to another: 57.3 from rad to deg. An Error lists the
// units that there are.
Result<double> ScaleTo(const std::string& unit, const std::string& from);

// Returns all words as Markdown.
std::string SignalsReference();

}  // namespace understudy::rehearse
