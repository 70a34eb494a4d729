// The signals that conditions speak of: what each is, and where it comes from.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "judge/condition.h"
#include "judge/margin.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::signals {

// The simulation's truth at an instant, as a recording has it (record/truth.h).
struct TruthView {
  // Of the base, as physics::RobotBody has them; empty if it is fixed.
  std::span<const double> base_position, base_velocity;
  std::span<const double> tau;                // N·m at the joints, in motor order
  std::span<const double> foot_force;         // N, in the order of robot.feet
  std::span<const double> hand_force;         // N, in the order of robot::HandNames
  std::span<const double> touch;              // N, in the order of robot::PadNames
  double crane_tension = 0;                   // N
  double nearest_obstacle = judge::kUnknown;  // m
};

// Where an object of the scene is, and how it moves: x, y, z [m] of its origin and the quaternion;
// linear velocity [m/s] in the world, angular [rad/s] in its own frame.
struct ObjectView {
  std::span<const double> position, velocity;
};

// What a recording must have for a signal to be known.
enum class Origin : std::uint8_t { kTruth, kMessages, kEvents };

// What a robot has, of whose run or recording conditions speak.
struct Names {
  // Returns what is wrong with the field of a message of a type, by its name on the wire; "" if
  // nothing is.
  using WrongField = std::string (*)(const std::string& type, const std::string& field);

  std::vector<std::string> joints{};    // in motor order
  std::vector<int> slots{};             // of those joints that have one
  std::vector<double> torque_limits{};  // N·m, of the joints
  bool hg = false;                      // of that family
  std::vector<std::string> feet{};
  std::vector<std::string> hands{};             // robot::HandNames
  std::vector<std::string> pads{};              // robot::PadNames
  std::vector<std::string> objects{};           // of the scene, that move
  std::map<std::string, std::string> topics{};  // type on the wire by name, as far as known
  // Null: of a running robot, which knows messages as it has them itself: those that it hears by
  // their arrival, its LowState by what it samples.
  WrongField wrong_field = nullptr;
  bool program = true;     // a program runs beside it, whose lines are heard
  bool any_robot = false;  // it is not known which: any joint, foot, hand and object will do
  // Where there are several: its name and number in the world, and the others.
  std::string robot{};
  std::size_t number = 0;
  std::vector<Names> others{};
  bool of_none = false;  // conditions are about no robot in particular: each signal names its own

  // Returns the same of another robot of the world, by its name; nullopt if there is none.
  std::optional<Names> Of(std::string_view name) const;
};

// Of a running robot. Its topics are those of commands.
Names RunningNames(const robot::RobotSpec& spec);
// The same where nobody knows yet which robot it will be, nor which others there are.
Names RunningNames();
// Of a recording, with the topics of commands and those of the robot's publications.
Names RecordedNames(const robot::RobotSpec& spec, Names::WrongField wrong_field);
// Returns the names of the first of the robots of a world, of which each has its name there.
Names Joined(std::vector<Names> robots);

// A signal that a condition names.
struct Signal {
  enum class Source : std::uint8_t {
    kTruth,
    kField,       // of a message
    kGap,         // between the messages of a topic
    kRate,        // of the messages of a topic (RecentArrivals)
    kFirstJump,   // of rt/lowcmd's first angles from those of rt/lowstate
    kArrival,     // of a message: their number at this instant
    kEventField,  // of the last event of a kind; a word is its number (judge::WordNumber)
    kEvent,       // their number at this instant
    kPrint,       // the same of those whose field is a word
    kEventCount,  // their number so far
  };

  std::string name;       // as the condition has it
  std::size_t robot = 0;  // its number in the world
  std::string unit{};
  Source source = Source::kTruth;
  double (*of)(const TruthView& truth, std::size_t index) = nullptr;                  // kTruth
  double (*of_sample)(const robot::RobotState& sample, std::size_t joint) = nullptr;  // kField
  bool of_obstacles = false;       // kTruth: that is measured only where it is asked for
  std::string_view why_unknown{};  // SignalRow::why_unknown
  double (*of_object)(const ObjectView& object) = nullptr;  // kTruth of an object, in place of `of`
  std::string object{};                                     // its name
  bool of_base = false;                                     // kTruth: of one that is free to move
  std::size_t index = 0;
  std::string topic{}, field{};  // of messages, on the wire; of events kind and field
  std::string printed{};         // kPrint
  double limit = 0;              // of whose share it is the size; 0: it is no share
  std::vector<int> slots{};      // kFirstJump: of the joints

  static Origin OriginOf(Source source);
  Origin origin() const { return OriginOf(source); }
  // Returns what is said of it in its own unit.
  double Told(double value) const { return limit > 0 ? std::abs(value) / limit : value; }
  bool of_one_instant() const {
    return source == Source::kArrival || source == Source::kEvent || source == Source::kPrint;
  }
};

// Finds what a comparison is about: NAME:WORD is of the robot of that name, else it is of the robot
// of `names`. An Error has the nearest word.
Result<Signal> FindSignal(const judge::Comparison& comparison, const Names& names);

// Whether one of them is the distance of the nearest obstacle of a robot, by its number.
bool AsksForObstacles(std::span<const Signal> signals, std::size_t robot);

// Returns the factor from the unit of a signal to another: 57.3 from rad to deg. An Error lists the
// units that there are.
Result<double> ScaleTo(const std::string& unit, const std::string& from);

// Returns the texts for which conditions look in what the program prints, each once.
std::vector<std::string> PrintedTexts(std::span<const Signal> signals);

// Returns all words as Markdown.
std::string SignalsReference();

}  // namespace understudy::signals
