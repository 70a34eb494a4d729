#include "record/plot.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "base/nearest_word.h"
#include "record/cdr_field.h"
#include "record/player.h"
#include "record/ros2msg.h"
#include "record/truth.h"
#include "robot/robot_values.h"
#include "wire/imu_codec.h"

namespace understudy::record {
namespace {

constexpr std::size_t kMotorsUnasked = 6;
constexpr double kDegrees = 57.29577951308232;

struct MotorField {
  std::string name, label;
  std::string state;    // field of motor_state
  std::string command;  // field of motor_cmd; "" for none
};
const std::array<MotorField, 4>& MotorFields() {
  static const std::array<MotorField, 4> fields = {
      {{"q", "q [rad]", "q", "q"},
       {"dq", "dq [rad/s]", "dq", "dq"},
       {"tau", "tau [N·m]", "tau_est", ""},
       {"temperature", "temperature [°C]", "temperature", ""}}};
  return fields;
}

struct Motor {
  std::string name;
  int slot = 0;
};

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

// A line that is collected while the recording is read.
struct Gathered {
  std::string topic;  // on the wire
  CdrField field;
  // Larger values are skipped: kNoPosition and kNoVelocity of commands.
  double most = std::numeric_limits<double>::infinity();
  // For the line of a motor: indices of its field and of the motor, and whether it is commanded.
  std::size_t of = 0, motor = 0;
  bool commanded = false;
  Trace trace{};
};

// Returns the name without its side: "FR_calf" and "RL_calf" are of the kind "calf".
std::string KindOf(const std::string& motor) {
  for (const std::string_view side : {"FR_", "FL_", "RR_", "RL_", "left_", "right_"}) {
    if (motor.starts_with(side)) return motor.substr(side.size());
  }
  return motor;
}

double Range(const TracePoints& points) {
  if (points.empty()) return 0;
  const auto [least, most] =
      std::ranges::minmax_element(points, {}, &TracePoints::value_type::second);
  return most->second - least->second;
}

// Collects everything for a page in one pass over the recording.
class PageMaker {
 public:
  PageMaker(const McapReader& reader, const PlotOptions& options)
      : reader_(reader), options_(options) {
    const McapContents& contents = reader.contents();
    page_.from = options.from;
    beginning_ = contents.first_time;
    const auto about = contents.metadata.find("understudy");
    if (about != contents.metadata.end()) about_ = about->second;
    const std::string& start = about_["start_time_ns"];
    std::from_chars(start.data(), start.data() + start.size(), beginning_);
    beginning_ = std::min(beginning_, contents.first_time);
    const double end = static_cast<double>(contents.last_time - beginning_) * 1e-9;
    page_.to = options.to > 0 ? std::min(options.to, end) : end;
    if (!(page_.from < page_.to)) {
      throw RecordError(reader.path().string() + ": there is nothing from " +
                        std::to_string(page_.from) + " to " + std::to_string(page_.to) + " s");
    }
    for (const auto& [id, channel] : contents.channels) {
      if (const McapSchema* schema = reader.SchemaOf(channel); schema != nullptr) {
        types_[TopicOnWire(channel)] = schema->name;
      }
    }
  }

  PlotPage Make() {
    FindMotors();
    AskForMotors();
    AskForSignals();
    Read();
    AddBase();
    AddMotors();
    AddSignals();
    if (page_.panels.empty()) {
      throw RecordError(reader_.path().string() + ": has no data of a robot that can be drawn");
    }
    page_.title = reader_.path().filename().string();
    if (about_.contains("robot")) page_.title = about_["robot"] + ", " + page_.title;
    if (about_.contains("started")) page_.title += ", " + about_["started"];
    page_.width = options_.width;
    page_.height =
        options_.height > 0 ? options_.height : 150 + 230 * static_cast<int>(page_.panels.size());
    return std::move(page_);
  }

 private:
  void FindMotors() {
    const auto type = types_.find("rt/lowstate");
    if (type == types_.end()) return;
    const std::vector<std::string> joints = WordsOf(about_["motors"]);
    const std::vector<std::string> slots = WordsOf(about_["slots"]);
    for (std::size_t i = 0; i < joints.size() && i < slots.size(); ++i) {
      std::string name = joints[i];
      if (name.ends_with("_joint")) name.erase(name.size() - 6);
      known_.push_back({.name = name, .slot = SlotOf(slots[i])});
    }
    if (!known_.empty()) return;
    // Not our recording: its slots have no names.
    const int count = type->second.starts_with("unitree_hg") ? 35 : 20;
    for (int slot = 0; slot < count; ++slot) {
      known_.push_back({.name = std::to_string(slot), .slot = slot});
    }
  }

  void AskForMotors() {
    std::vector<std::string> names;
    for (const Motor& motor : known_) names.push_back(motor.name);
    for (std::string wanted : options_.motors) {
      if (wanted.ends_with("_joint")) wanted.erase(wanted.size() - 6);
      const auto found = std::ranges::find_if(known_, [&](const Motor& motor) {
        return motor.name == wanted || std::to_string(motor.slot) == wanted;
      });
      if (found == known_.end()) {
        throw RecordError("--motors: no motor '" + wanted + "'" + DidYouMean(wanted, names));
      }
      motors_.push_back(*found);
    }
    if (motors_.empty()) motors_ = known_;
    std::vector<std::string> valid;
    for (const MotorField& field : MotorFields()) valid.push_back(field.name);
    for (const std::string& wanted :
         options_.fields.empty() ? std::vector<std::string>{"q", "tau"} : options_.fields) {
      const auto found = std::ranges::find(MotorFields(), wanted, &MotorField::name);
      if (found == MotorFields().end()) {
        throw RecordError("--fields: no field '" + wanted + "'" + DidYouMean(wanted, valid));
      }
      fields_.push_back(*found);
    }
    for (std::size_t field = 0; field < fields_.size(); ++field) {
      for (std::size_t motor = 0; motor < motors_.size(); ++motor) {
        const std::string slot = "[" + std::to_string(motors_[motor].slot) + "].";
        Ask(field, motor, false, "rt/lowstate", "motor_state" + slot + fields_[field].state);
        if (fields_[field].command.empty()) continue;
        Ask(field, motor, true, "rt/lowcmd", "motor_cmd" + slot + fields_[field].command);
      }
    }
  }

  void Ask(std::size_t field, std::size_t motor, bool commanded, const std::string& topic,
           std::string path) {
    const auto type = types_.find(topic);
    if (type == types_.end()) return;
    if (path.ends_with("temperature") && type->second.starts_with("unitree_hg")) path += "[0]";
    gathered_.push_back({.topic = topic,
                         .field = FindField(type->second, path),
                         .most = commanded ? robot::kNoVelocity : Gathered{}.most,
                         .of = field,
                         .motor = motor,
                         .commanded = commanded});
  }

  void AskForSignals() {
    std::vector<std::string> topics;
    for (const auto& [topic, type] : types_) {
      if (RosMessages().contains(type)) topics.push_back(topic);
    }
    for (const std::string& signal : options_.signals) {
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
      signals_.push_back(
          {.topic = topic, .field = FindField(type->second, signal.substr(colon + 1))});
    }
  }

  void Read() {
    std::map<std::string, std::vector<Gathered*>> by_topic;
    for (std::vector<Gathered>* some : {&gathered_, &signals_}) {
      for (Gathered& one : *some) by_topic[one.topic].push_back(&one);
    }
    const auto from = beginning_ + static_cast<std::uint64_t>(page_.from * 1e9);
    const auto to = beginning_ + static_cast<std::uint64_t>(std::ceil(page_.to * 1e9));
    reader_.ReadMessages(from, to, [&](const McapChannel& channel, const McapMessage& message) {
      const double at = static_cast<double>(message.log_time - beginning_) * 1e-9;
      if (channel.topic == kTruthTopic) {
        NoteTruth(at, DecodeTruth(message.data));
      } else if (channel.topic == kEventTopic) {
        NoteEvent(at, DecodeEvent(message.data));
      } else if (const auto some = by_topic.find(TopicOnWire(channel)); some != by_topic.end()) {
        for (Gathered* one : some->second) {
          const std::optional<double> value = ReadField(one->field, message.data);
          if (value && std::abs(*value) < one->most) Note(at, *value, &one->trace);
        }
      }
      return true;
    });
  }

  void Note(double at, double value, Trace* trace) const {
    trace->Add(at, value, page_.from, page_.to);
  }

  // The free joint comes first: position and attitude (w, x, y, z).
  void NoteTruth(double at, const Truth& truth) {
    if (truth.qpos.size() < 7 || truth.qpos.size() == truth.qvel.size()) return;
    const Eigen::Quaterniond R_WB(truth.qpos[3], truth.qpos[4], truth.qpos[5], truth.qpos[6]);
    const Eigen::Vector3d rpy = kDegrees * wire::RollPitchYaw(R_WB);
    Note(at, truth.qpos[2], &height_);
    for (std::size_t i = 0; i < 3; ++i) Note(at, rpy[static_cast<int>(i)], &rpy_[i]);
  }

  // Events of one kind that follow each other closely become one mark.
  void NoteEvent(double at, const Event& event) {
    if (!IsForPictures(event.kind)) return;
    const double close = 0.02 * (page_.to - page_.from);
    const auto [last, is_new] = last_of_.try_emplace(event.kind, at, page_.marks.size());
    const bool follows = !is_new && at - last->second.first < close;
    last->second.first = at;
    if (follows) {
      ++page_.marks[last->second.second].times;
      return;
    }
    last->second.second = page_.marks.size();
    page_.marks.push_back({.at = at, .kind = event.kind, .text = event.text});
  }

  PlotLine Line(std::string name, std::size_t color, const Trace& trace,
                bool dashed = false) const {
    return {.name = std::move(name),
            .color = static_cast<int>(color),
            .dashed = dashed,
            .points = Thinned(trace.points(), page_.from, page_.to)};
  }

  void AddBase() {
    if (height_.points().empty()) return;
    page_.panels.push_back({.label = "height [m]", .lines = {Line("base", 0, height_)}});
    page_.panels.push_back(
        {.label = "attitude [°]",
         .lines = {Line("roll", 0, rpy_[0]), Line("pitch", 1, rpy_[1]), Line("yaw", 2, rpy_[2])}});
  }

  // By default, of each kind of joint the one that moves most, and of the kinds those that move
  // most.
  std::set<std::size_t> Chosen() const {
    std::map<std::string, std::pair<double, std::size_t>> most;  // by kind: range, motor
    std::set<std::size_t> chosen;
    for (const Gathered& line : gathered_) {
      if (!options_.motors.empty()) chosen.insert(line.motor);
      if (line.of != 0 || line.commanded) continue;
      const double range = Range(line.trace.points());
      const auto [kind, is_new] =
          most.try_emplace(KindOf(motors_[line.motor].name), range, line.motor);
      if (range > kind->second.first) kind->second = {range, line.motor};
    }
    if (!chosen.empty()) return chosen;
    std::vector<std::pair<double, std::size_t>> moves;
    for (const auto& [kind, best] : most) moves.push_back(best);
    std::ranges::sort(moves, std::greater<>());
    for (std::size_t i = 0; i < std::min(moves.size(), kMotorsUnasked); ++i) {
      chosen.insert(moves[i].second);
    }
    return chosen;
  }

  void AddMotors() {
    const std::set<std::size_t> chosen = Chosen();
    for (std::size_t field = 0; field < fields_.size(); ++field) {
      PlotPanel panel{.label = fields_[field].label};
      for (const bool commanded : {true, false}) {
        std::size_t color = 0;
        for (const std::size_t motor : chosen) {
          const auto line = std::ranges::find_if(gathered_, [&](const Gathered& one) {
            return one.of == field && one.motor == motor && one.commanded == commanded;
          });
          const std::size_t its_color = color++;
          if (line == gathered_.end() || line->trace.points().empty()) continue;
          panel.lines.push_back(
              Line(commanded ? "" : motors_[motor].name, its_color, line->trace, commanded));
        }
      }
      if (!panel.lines.empty()) page_.panels.push_back(std::move(panel));
    }
  }

  void AddSignals() {
    for (std::size_t i = 0; i < options_.signals.size(); ++i) {
      const std::string& signal = options_.signals[i];
      const std::string path = signal.substr(signal.find(':') + 1);
      const Trace& trace = signals_[i].trace;
      if (trace.points().empty()) {
        throw RecordError("--signals: nothing says " + signal + " from " +
                          std::to_string(page_.from) + " to " + std::to_string(page_.to) + " s");
      }
      // A short label: gnuplot omits one that is longer than the axis.
      page_.panels.push_back(
          {.label = path.substr(path.rfind('.') + 1), .lines = {Line(path, 0, trace)}});
    }
  }

  const McapReader& reader_;
  const PlotOptions& options_;
  PlotPage page_;
  StringMap about_;
  std::uint64_t beginning_ = 0;
  std::map<std::string, std::string> types_;  // by topic on the wire
  std::vector<Motor> known_, motors_;
  std::vector<MotorField> fields_;
  std::vector<Gathered> gathered_, signals_;  // lines of motors, and of signals
  Trace height_;
  std::array<Trace, 3> rpy_;
  // The last event of each kind: its time and its mark.
  std::map<std::string, std::pair<double, std::size_t>> last_of_;
};

}  // namespace

PlotPage MakePage(const McapReader& reader, const PlotOptions& options) {
  return PageMaker(reader, options).Make();
}

TracePoints Thinned(const TracePoints& all, double from, double to) {
  if (all.size() <= 2 * kTraceColumns) return all;
  TracePoints thin;
  const double width = (to - from) / static_cast<double>(kTraceColumns);
  for (std::size_t begin = 0; begin < all.size();) {
    const double column = std::floor((all[begin].first - from) / width);
    std::size_t end = begin, least = begin, most = begin;
    for (; end < all.size() && std::floor((all[end].first - from) / width) == column; ++end) {
      if (all[end].second < all[least].second) least = end;
      if (all[end].second > all[most].second) most = end;
    }
    thin.push_back(all[std::min(least, most)]);
    if (least != most) thin.push_back(all[std::max(least, most)]);
    begin = std::max(end, begin + 1);
  }
  return thin;
}

void Trace::Add(double at, double value, double from, double to) {
  if (!std::isfinite(value)) return;
  points_.emplace_back(at, value);
  if (points_.size() < full_) return;
  points_ = Thinned(points_, from, to);
  full_ = std::max(kFull, 2 * points_.size());  // times that go back may keep it long
}

}  // namespace understudy::record
