#include "record/run_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/nearest_word.h"
#include "record/player.h"
#include "record/ros2msg.h"
#include "robot/robot_values.h"
#include "wire/imu_codec.h"
#include "wire/robot_topics.h"

namespace understudy::record {
namespace {

constexpr double kDegrees = 57.29577951308232;

struct MotorField {
  const char* name;
  const char* unit;
  const char* state;    // field of motor_state
  const char* command;  // field of motor_cmd; "" for none
};
constexpr std::array<MotorField, 4> kMotorFields = {{{"q", "rad", "q", "q"},
                                                     {"dq", "rad/s", "dq", "dq"},
                                                     {"tau", "N·m", "tau_est", ""},
                                                     {"temperature", "°C", "temperature", ""}}};

const MotorField* FindMotorField(const std::string& name) {
  const auto found =
      std::ranges::find_if(kMotorFields, [&](const MotorField& one) { return name == one.name; });
  return found == kMotorFields.end() ? nullptr : &*found;
}

std::vector<std::string> WordsOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// Returns -1, which is no slot, if the text is not a number.
int SlotOf(const std::string& word) {
  int slot = -1;
  std::from_chars(word.data(), word.data() + word.size(), slot);
  return slot;
}

}  // namespace

RunReader::RunReader(const RecordingReader& reader, const RunChoice& choice) : reader_(reader) {
  const McapContents& contents = reader.contents();
  from_ = choice.from;
  beginning_ = contents.first_time;
  const auto about = contents.metadata.find("understudy");
  if (about != contents.metadata.end()) about_ = about->second;
  const std::string start = About("start_time_ns");
  std::from_chars(start.data(), start.data() + start.size(), beginning_);
  beginning_ = std::min(beginning_, contents.first_time);
  const double end = static_cast<double>(contents.last_time - beginning_) * 1e-9;
  to_ = choice.to > 0 ? std::min(choice.to, end) : end;
  if (!(from_ < to_)) {
    throw RecordError(reader.path().string() + ": there is nothing from " + std::to_string(from_) +
                      " to " + std::to_string(to_) + " s");
  }
  for (const auto& [id, channel] : contents.channels) {
    if (const McapSchema* schema = reader.SchemaOf(channel); schema != nullptr) {
      types_[TopicOnWire(channel)] = schema->name;
    }
  }
  columns_ = {{.name = "height", .quantity = "", .unit = "m"}};
  for (const char* angle : {"roll", "pitch", "yaw"}) {
    columns_.push_back({.name = angle, .quantity = "", .unit = "°"});
  }
  AskForMotors(choice);
  AskForSignals(choice);
}

std::string RunReader::About(const std::string& key) const {
  const auto found = about_.find(key);
  return found == about_.end() ? std::string() : found->second;
}

void RunReader::FindMotors(std::vector<RunMotor>* known) {
  const auto type = types_.find(wire::kLowStateName);
  if (type == types_.end()) return;
  const std::vector<std::string> joints = WordsOf(About("motors"));
  const std::vector<std::string> slots = WordsOf(About("slots"));
  for (std::size_t i = 0; i < joints.size() && i < slots.size(); ++i) {
    std::string name = joints[i];
    if (name.ends_with("_joint")) name.erase(name.size() - 6);
    known->push_back({.name = name, .slot = SlotOf(slots[i])});
  }
  if (!known->empty()) return;
  // Not our recording: its slots have no names.
  const int count = type->second.starts_with("unitree_hg") ? 35 : 20;
  for (int slot = 0; slot < count; ++slot) {
    known->push_back({.name = std::to_string(slot), .slot = slot});
  }
}

void RunReader::AskForMotors(const RunChoice& choice) {
  std::vector<RunMotor> known;
  FindMotors(&known);
  std::vector<std::string> names;
  for (const RunMotor& motor : known) names.push_back(motor.name);
  for (std::string wanted : choice.motors) {
    if (wanted.ends_with("_joint")) wanted.erase(wanted.size() - 6);
    const auto found = std::ranges::find_if(known, [&](const RunMotor& motor) {
      return motor.name == wanted || std::to_string(motor.slot) == wanted;
    });
    if (found == known.end()) {
      throw RecordError("--motors: no motor '" + wanted + "'" + DidYouMean(wanted, names));
    }
    motors_.push_back(*found);
  }
  if (motors_.empty()) motors_ = known;
  std::vector<std::string> valid;
  for (const MotorField& field : kMotorFields) valid.emplace_back(field.name);
  fields_ = choice.fields.empty() ? std::vector<std::string>{"q", "tau"} : choice.fields;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const MotorField* const field = FindMotorField(fields_[i]);
    if (field == nullptr) {
      throw RecordError("--fields: no field '" + fields_[i] + "'" + DidYouMean(fields_[i], valid));
    }
    for (std::size_t motor = 0; motor < motors_.size(); ++motor) {
      const std::string slot = "[" + std::to_string(motors_[motor].slot) + "].";
      Ask(i, motor, false, wire::kLowStateName, "motor_state" + slot + field->state);
      if (*field->command == '\0') continue;
      Ask(i, motor, true, wire::kLowCmdName, "motor_cmd" + slot + field->command);
    }
  }
}

void RunReader::Ask(std::size_t field, std::size_t motor, bool commanded, std::string_view topic,
                    std::string path) {
  const auto type = types_.find(topic);
  if (type == types_.end()) return;
  if (path.ends_with("temperature") && type->second.starts_with("unitree_hg")) path += "[0]";
  columns_.push_back({.kind = RunColumn::Kind::kMotor,
                      .name = motors_[motor].name,
                      .quantity = fields_[field],
                      .unit = FindMotorField(fields_[field])->unit,
                      .field = field,
                      .motor = motor,
                      .commanded = commanded,
                      .topic = std::string(topic),
                      .place = FindField(type->second, path),
                      .most = commanded ? robot::kNoVelocity : RunColumn{}.most});
}

void RunReader::AskForSignals(const RunChoice& choice) {
  std::vector<std::string> topics;
  for (const auto& [topic, type] : types_) {
    if (RosMessages().contains(type)) topics.push_back(topic);
  }
  for (const std::string& signal : choice.signals) {
    const std::size_t colon = signal.find(':');
    if (colon == std::string::npos) {
      throw RecordError("--signals: '" + signal +
                        "': expected TOPIC:FIELD, such as rt/lowstate:imu_state.gyroscope[2]");
    }
    std::string topic = signal.substr(0, colon);
    if (topic.starts_with('/')) topic = "rt" + topic;  // a ROS name
    const auto type = types_.find(topic);
    if (type == types_.end() || !RosMessages().contains(type->second)) {
      throw RecordError("--signals: no topic '" + topic + "'" + DidYouMean(topic, topics));
    }
    columns_.push_back({.kind = RunColumn::Kind::kSignal,
                        .name = signal,
                        .quantity = "",
                        .unit = "",
                        .topic = topic,
                        .place = FindField(type->second, signal.substr(colon + 1))});
  }
}

void RunReader::Read() {
  std::map<std::string, std::vector<std::size_t>> by_topic;
  for (std::size_t i = kBaseColumns; i < columns_.size(); ++i) {
    by_topic[columns_[i].topic].push_back(i);
  }
  const auto from = beginning_ + static_cast<std::uint64_t>(from_ * 1e9);
  const auto to = beginning_ + static_cast<std::uint64_t>(std::ceil(to_ * 1e9));
  reader_.ReadMessages(from, to, [&](const McapChannel& channel, const McapMessage& message) {
    const double at = static_cast<double>(message.log_time - beginning_) * 1e-9;
    if (channel.topic == kTruthTopic) {
      NoteTruth(at, DecodeTruth(message.data), BaseAddress::Of(channel.metadata));
    } else if (channel.topic == kEventTopic) {
      NoteEvent(at, DecodeEvent(message.data));
    } else if (const auto some = by_topic.find(TopicOnWire(channel)); some != by_topic.end()) {
      for (const std::size_t i : some->second) {
        const std::optional<double> value = ReadField(columns_[i].place, message.data);
        if (value && std::abs(*value) < columns_[i].most) Tell(at, *value, i);
      }
    }
    return true;
  });
}

void RunReader::Tell(double at, double value, std::size_t column) {
  if (std::isfinite(value)) Note(at, value, column);
}

// Position and attitude (w, x, y, z) of the base.
void RunReader::NoteTruth(double at, const Truth& truth, const BaseAddress& base) {
  if (!HasFreeBase(truth, base)) return;
  const double* const q = truth.qpos.data() + base.qpos;
  const Eigen::Quaterniond R_WB(q[3], q[4], q[5], q[6]);
  const Eigen::Vector3d rpy = kDegrees * wire::RollPitchYaw(R_WB);
  Tell(at, q[2], 0);
  for (std::size_t i = 0; i < 3; ++i) Tell(at, rpy[static_cast<int>(i)], 1 + i);
}

namespace {

// A value has moved once it is further than `still` from where it was when it last had.
class BusyFinder final : public RunReader {
 public:
  explicit BusyFinder(const RecordingReader& reader)
      : RunReader(reader, {.fields = {"q"}}), rests_(columns().size()) {
    span_.end = to();
    Read();
  }
  const BusySpan& span() const { return span_; }

 private:
  struct Rest {
    double at = 0;
    bool known = false;
  };

  void Note(double at, double value, std::size_t column) override {
    const double still = column == 0             ? kStill.height
                         : column < kBaseColumns ? kStill.attitude
                                                 : kStill.q;
    Rest& rest = rests_[column];
    if (rest.known && std::abs(value - rest.at) <= still) return;
    if (rest.known) Busy(at);
    rest = {.at = value, .known = true};
  }
  void NoteEvent(double at, const RecordedEvent& event) override {
    if (event.step > 0 && IsForPictures(event.kind)) Busy(at);
  }
  void Busy(double at) {
    span_.from = span_.never ? at : std::min(span_.from, at);
    span_.to = span_.never ? at : std::max(span_.to, at);
    span_.never = false;
  }

  std::vector<Rest> rests_;
  BusySpan span_;
};

}  // namespace

BusySpan BusySpanOf(const RecordingReader& reader) { return BusyFinder(reader).span(); }

}  // namespace understudy::record
