#include "signals/signals.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/nearest_word.h"
#include "emulator/event_table.h"
#include "emulator/request.h"
#include "robot/command_topics.h"
#include "robot/hand_law.h"
#include "robot/pads.h"
#include "services/api_names.h"
#include "signals/signal_rows.h"
#include "wire/robot_topics.h"

namespace understudy::signals {
namespace {

using emulator::EventField;
using emulator::EventRow;

struct UnitRow {
  std::string_view unit, of;
  double scale;
};
constexpr UnitRow kUnits[] = {{"deg", "rad", 57.29577951308232},
                              {"deg/s", "rad/s", 57.29577951308232},
                              {"cm", "m", 100},
                              {"mm", "m", 1000},
                              {"cm/s", "m/s", 100},
                              {"ms", "s", 1000},
                              {"kN", "N", 0.001}};

Error Unknown(const std::string& what, const std::string& word,
              const std::vector<std::string>& known) {
  constexpr std::size_t kFew = 12;
  if (known.size() <= kFew) return {"no " + what + " '" + word + "'" + DidYouMean(word, known)};
  return {"no " + what + " '" + word + "'" + NearestHint(word, known)};
}

const EventRow* FindEvent(std::string_view kind) {
  const auto row = std::ranges::find(emulator::EventTable(), kind, &EventRow::name);
  return row == emulator::EventTable().end() ? nullptr : &*row;
}

// What a recording calls events: the rows of the table, and requests by their own names.
std::vector<std::string> EventKinds() {
  std::vector<std::string> kinds;
  for (const EventRow& row : emulator::EventTable()) {
    if (row.kind != emulator::EventKind::kRequest) kinds.emplace_back(row.name);
  }
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    if (row.noted) kinds.emplace_back(row.name);
  }
  return kinds;
}

// "lowcmd" is rt/lowcmd, "/lowstate" the ROS name of rt/lowstate.
std::string OnWire(const std::string& topic) {
  if (topic.starts_with("rt/")) return topic;
  return (topic.starts_with('/') ? "rt" : "rt/") + topic;
}

Result<std::string> FindTopic(const std::string& written, const Names& names) {
  const std::string topic = OnWire(written);
  if (names.topics.contains(topic)) return topic;
  if (names.any_robot && robot::IsHandCommandTopic(topic)) return topic;
  // Programs may have topics of their own.
  if (names.wrong_field != nullptr && written.starts_with("rt/")) return topic;
  std::vector<std::string> topics;
  for (const auto& [name, type] : names.topics) topics.push_back(name);
  return Unknown(names.wrong_field == nullptr ? "topic of commands" : "topic", topic, topics);
}

Result<std::size_t> FindJoint(const std::string& joint, const Names& names) {
  if (names.any_robot) return std::size_t{0};
  auto found = std::ranges::find(names.joints, joint);
  if (found == names.joints.end()) found = std::ranges::find(names.joints, joint + "_joint");
  if (found == names.joints.end()) {
    std::vector<std::string> known = names.joints;
    for (std::string& name : known) {
      if (name.ends_with("_joint")) name.erase(name.size() - 6);
    }
    return Unknown("joint", joint, known);
  }
  return static_cast<std::size_t>(found - names.joints.begin());
}

// Parts of a robot by which signals are asked for.
struct PartRow {
  std::string_view argument;
  const char* what;
  std::vector<std::string> Names::*known;
};
constexpr PartRow kParts[] = {{"FOOT", "foot", &Names::feet},
                              {"HAND", "hand", &Names::hands},
                              {"PAD", "pad of a hand", &Names::pads}};

// Finds the place of a part among those of the robot.
Result<std::size_t> FindPart(const std::string& what, const std::string& name,
                             const std::vector<std::string>& known, const Names& names) {
  if (names.any_robot) return std::size_t{0};
  if (known.empty()) return Error{"no " + what + " '" + name + "': this robot has none"};
  const auto found = std::ranges::find(known, name);
  if (found == known.end()) return Unknown(what, name, known);
  return static_cast<std::size_t>(found - known.begin());
}

Result<std::string> FindObject(const std::string& object, const Names& names) {
  if (names.any_robot || std::ranges::find(names.objects, object) != names.objects.end()) {
    return object;
  }
  if (names.objects.empty())
    return Error{"no object '" + object + "'; `objects` has none that moves"};
  return Unknown("object", object, names.objects);
}

Result<Signal> EventValue(Signal signal, const std::string& kind, const std::string& field) {
  const EventRow* row = FindEvent(kind);
  if (row == nullptr) return Unknown("event", kind, EventKinds());
  std::vector<std::string> fields;
  for (const EventField& known : row->fields) {
    if (!known.name.empty()) fields.emplace_back(known.name);
  }
  if (std::ranges::find(fields, field) == fields.end()) {
    return Unknown("field of the event " + kind, field, fields);
  }
  signal.source = Signal::Source::kEventField;
  signal.topic = kind;
  signal.field = field;
  return signal;
}

Result<Signal> EventNumber(Signal signal, Signal::Source source, const std::string& kind) {
  const std::vector<std::string> kinds = EventKinds();
  if (std::ranges::find(kinds, kind) == kinds.end()) return Unknown("event", kind, kinds);
  signal.source = source;
  signal.topic = kind;
  return signal;
}

Result<Signal> FieldOf(Signal signal, const std::string& topic, const std::string& field,
                       const Names& names) {
  if (names.wrong_field == nullptr) {
    return Error{
        "a running robot is asked for q, dq, tau_est and temperature of a joint, not for '" +
        signal.name + "'"};
  }
  const auto found = FindTopic(topic, names);
  if (!found) return found.error();
  signal.source = Signal::Source::kField;
  signal.topic = *found;
  signal.field = field;
  const auto type = names.topics.find(*found);
  if (type == names.topics.end()) return signal;
  if (const std::string wrong = names.wrong_field(type->second, field); !wrong.empty()) {
    return Error{wrong};
  }
  return signal;
}

// Whether a signal is the same of all robots of a world.
bool IsOfWorld(const Signal& signal) {
  if (!signal.object.empty()) return true;
  const EventRow* row = signal.origin() == Origin::kEvents ? FindEvent(signal.topic) : nullptr;
  return row != nullptr && row->of_world;
}

// "word(argument)" in two; the argument is "" if there is none.
std::pair<std::string, std::string> Split(const std::string& subject) {
  const std::size_t open = subject.find('(');
  if (open == std::string::npos || !subject.ends_with(')')) return {subject, ""};
  return {subject.substr(0, open), subject.substr(open + 1, subject.size() - open - 2)};
}

// A joint's signal: of the truth by its index, of messages by the field of its motor too.
Result<Signal> OfJoint(const SignalRow& row, std::size_t joint, Signal signal, const Names& names) {
  signal.index = joint;
  if (row.share && !names.any_robot) signal.limit = names.torque_limits[joint];
  if (row.source != Signal::Source::kField) return signal;
  const bool winding = names.hg && row.of_hg_sample != nullptr;
  signal.of_sample = winding ? row.of_hg_sample : row.of_sample;
  if (names.any_robot) return signal;
  if (joint >= names.slots.size()) {
    return Error{signal.topic + " does not have " + names.joints[joint]};
  }
  signal.field = "motor_state[" + std::to_string(names.slots[joint]) + "]." +
                 std::string(row.field) + (winding ? "[1]" : "");
  return signal;
}

Result<Signal> OfRow(const SignalRow& row, const std::string& argument, Signal signal,
                     const Names& names) {
  signal.source = row.source;
  signal.unit = row.unit;
  signal.of = row.of;
  signal.of_object = row.of_object;
  signal.of_base = row.word.starts_with("base.");
  signal.of_obstacles = row.of_obstacles;
  signal.why_unknown = row.why_unknown;
  signal.topic = row.topic;
  if (row.source == Signal::Source::kFirstJump) signal.slots = names.slots;
  if (row.source == Signal::Source::kEventField) {
    return EventValue(std::move(signal), std::string(row.topic), std::string(row.field));
  }
  if (row.argument == "EVENT") return EventNumber(std::move(signal), row.source, argument);
  const auto kind = std::ranges::find(kParts, row.argument, &PartRow::argument);
  if (kind != std::end(kParts)) {
    const auto part = FindPart(kind->what, argument, names.*kind->known, names);
    if (!part) return part.error();
    signal.index = *part;
  }
  if (row.argument == "OBJECT") {
    const auto object = FindObject(argument, names);
    if (!object) return object.error();
    signal.object = *object;
  }
  if (row.argument == "TOPIC") {
    const auto topic = FindTopic(argument, names);
    if (!topic) return topic.error();
    signal.topic = *topic;
  }
  if (row.argument == "JOINT") {
    const auto joint = FindJoint(argument, names);
    if (!joint) return joint.error();
    return OfJoint(row, *joint, std::move(signal), names);
  }
  return signal;
}

// Finds a signal of the robot of `names`.
Result<Signal> FindOwn(const judge::Comparison& comparison, const Names& names) {
  const std::string& subject = comparison.subject;
  Signal signal{.name = subject, .robot = names.number};
  if (comparison.relation == judge::Relation::kHappens) {
    return EventNumber(std::move(signal), Signal::Source::kEvent, subject);
  }
  if (comparison.relation == judge::Relation::kArrives) {
    const auto topic = FindTopic(subject, names);
    if (!topic) return topic.error();
    signal.source = Signal::Source::kArrival;
    signal.topic = *topic;
    return signal;
  }
  if (comparison.relation == judge::Relation::kPrints) {
    if (!names.program)
      return Error{"no program runs beside this robot; exec and rehearse have one"};
    return Signal{.name = judge::Text(comparison),
                  .source = Signal::Source::kPrint,
                  .topic = "program_prints",
                  .field = "text",
                  .printed = comparison.word};
  }
  const auto [word, argument] = Split(subject);
  const std::span<const SignalRow> rows = SignalRows();
  const auto row = std::ranges::find_if(rows, [&word = word, &argument = argument](const auto& r) {
    return r.word == word && r.argument.empty() == argument.empty();
  });
  if (row != rows.end()) return OfRow(*row, argument, std::move(signal), names);
  if (const std::size_t colon = subject.find(':'); colon != std::string::npos) {
    return FieldOf(std::move(signal), subject.substr(0, colon), subject.substr(colon + 1), names);
  }
  if (const std::size_t dot = subject.rfind('.'); dot != std::string::npos) {
    const std::string kind = subject.substr(0, dot);
    if (FindEvent(kind) != nullptr) {
      return EventValue(std::move(signal), kind, subject.substr(dot + 1));
    }
  }
  const std::string hint = NearestHint(subject, SignalWords());
  return Error{
      "no signal '" + subject + "'" +
      (hint.empty() ? "; there are words such as base.height, TOPIC:FIELD, EVENT.FIELD" : hint)};
}

}  // namespace

Names RunningNames(const robot::RobotSpec& spec) {
  Names names;
  for (const robot::MotorSpec* motor : robot::AllMotors(spec)) {
    names.joints.push_back(motor->joint);
    names.torque_limits.push_back(motor->torque_limit);
  }
  for (const robot::MotorSpec& motor : spec.motors) names.slots.push_back(motor.slot);
  for (const robot::FootSpec& foot : spec.feet) names.feet.push_back(foot.name);
  names.hands = robot::HandNames(spec);
  names.pads = robot::PadNames(spec);
  for (const std::string& topic : robot::CommandTopicNames(spec)) {
    if (!topic.empty()) names.topics.emplace(topic, "");
  }
  names.hg = spec.family == robot::WireFamily::kHg;
  return names;
}

Names RunningNames() {
  Names names{.any_robot = true};
  for (const std::string_view topic : robot::kCommandTopicNames) names.topics.emplace(topic, "");
  return names;
}

Names RecordedNames(const robot::RobotSpec& spec, Names::WrongField wrong_field) {
  Names names = RunningNames(spec);
  names.wrong_field = wrong_field;
  names.topics.clear();
  for (const wire::RobotTopic& topic : wire::CommandTopics(spec)) {
    if (!topic.name.empty()) names.topics.emplace(topic.name, topic.type);
  }
  const std::vector<std::string> services = services::ServiceNames(spec.apis);
  for (const wire::RobotTopic& topic : wire::PublishedTopics(spec, services)) {
    names.topics.emplace(topic.name, topic.type);
  }
  return names;
}

Names Joined(std::vector<Names> robots) {
  for (std::size_t i = 0; i < robots.size(); ++i) robots[i].number = i;
  if (robots.size() == 1) robots.front().robot.clear();
  Names first = std::move(robots.front());
  robots.erase(robots.begin());
  first.others = std::move(robots);
  return first;
}

Origin Signal::OriginOf(Source source) {
  using enum Source;
  switch (source) {
    case kTruth:
      return Origin::kTruth;
    case kField:
    case kGap:
    case kRate:
    case kFirstJump:
    case kArrival:
      return Origin::kMessages;
    case kEventField:
    case kEvent:
    case kPrint:
    case kEventCount:
      break;
  }
  return Origin::kEvents;
}

std::optional<Names> Names::Of(std::string_view name) const {
  if (robot == name) return *this;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (others[i].robot != name) continue;
    Names found = others[i];
    found.others = others;
    found.others[i] = *this;
    found.others[i].others.clear();
    return found;
  }
  return std::nullopt;
}

Result<Signal> FindSignal(const judge::Comparison& comparison, const Names& names) {
  const std::string& subject = comparison.subject;
  const std::size_t end = subject.find(':');
  const std::string robot = subject.substr(0, end);
  // Any name may be that of another robot.
  const bool any = names.any_robot && robot.find('/') == std::string::npos;
  std::optional<Names> named;
  if (end != std::string::npos && any) named = names;
  if (end != std::string::npos && !names.robot.empty()) named = names.Of(robot);
  if (named) {
    judge::Comparison stripped = comparison;
    stripped.subject.erase(0, end + 1);
    auto found = FindOwn(stripped, *named);
    if (found) found->name = subject;
    return found;
  }
  auto found = FindOwn(comparison, names);
  if (!found || !names.of_none || IsOfWorld(*found)) return found;
  return Error{"'" + subject + "' is of which robot? expected such as " + names.robot + ":" +
               subject};
}

bool AsksForObstacles(std::span<const Signal> signals, std::size_t robot) {
  return std::ranges::any_of(signals, [robot](const Signal& signal) {
    return signal.of_obstacles && signal.robot == robot;
  });
}

Result<double> ScaleTo(const std::string& unit, const std::string& from) {
  if (unit.empty() || unit == from) return 1.0;
  std::vector<std::string> units;
  if (!from.empty()) units.push_back(from);
  for (const UnitRow& row : kUnits) {
    if (row.of != from) continue;
    if (row.unit == unit) return row.scale;
    units.emplace_back(row.unit);
  }
  if (units.empty()) return Error{"has no unit, got '" + unit + "'"};
  return Error{"no unit '" + unit + "'" + DidYouMean(unit, units)};
}

std::vector<std::string> PrintedTexts(std::span<const Signal> signals) {
  std::vector<std::string> texts;
  for (const Signal& signal : signals) {
    if (signal.source != Signal::Source::kPrint) continue;
    if (std::ranges::find(texts, signal.printed) == texts.end()) texts.push_back(signal.printed);
  }
  return texts;
}

}  // namespace understudy::signals
