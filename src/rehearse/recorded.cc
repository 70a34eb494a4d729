#include "rehearse/recorded.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "base/errors.h"
#include "base/printed.h"
#include "record/cdr_field.h"
#include "record/player.h"
#include "robot/robot_values.h"
#include "wire/robot_topics.h"
#include "wire/slots.h"

namespace understudy::rehearse {
namespace {

constexpr std::string_view kState = wire::kLowStateName, kCommand = wire::kLowCmdName;
constexpr std::string_view kBattery = wire::topic::kLfBmsState.name;  // of the hg family
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
// Longest time without a state [s]; *assumed*. A longer one is a clock that was set.
constexpr double kLongestGap = 60;

// A series that is read.
struct Reading {
  record::CdrField field;
  Series series;
};

std::string WithSlot(std::string_view field, int slot) {
  std::string text(field);
  if (const auto at = text.find('#'); at != std::string::npos) {
    text.replace(at, 1, std::to_string(slot));
  }
  return text;
}

std::map<int, std::string> JointsOf(const record::StringMap& about) {
  std::map<int, std::string> joints;
  const auto words = [&about](const char* key) {
    const auto found = about.find(key);
    return std::istringstream(found == about.end() ? std::string() : found->second);
  };
  std::istringstream names = words("motors"), slots = words("slots");
  int slot = 0;
  for (std::string name; names >> name && slots >> slot;) {
    if (name.ends_with("_joint")) name.erase(name.size() - 6);
    joints[slot] = name;
  }
  return joints;
}

// Calls visit(topic, type, message) with the messages of the robot and its clients.
template <class Visit>
void ReadTopics(const record::RecordingReader& reader, const Visit& visit) {
  reader.ReadMessages([&](const record::McapChannel& channel, const record::McapMessage& message) {
    const record::McapSchema* schema = reader.SchemaOf(channel);
    if (schema != nullptr) visit(record::TopicOnWire(channel), schema->name, message);
    return true;
  });
}

}  // namespace

const std::vector<Quantity>& Quantities() {
  static const std::vector<Quantity> rows = {
      {"q", "rad", kState, "motor_state[#].q", "motor_state[#].q", true},
      {"command", "rad", kCommand, "motor_cmd[#].q", "motor_cmd[#].q", true},
      {"dq", "rad/s", kState, "motor_state[#].dq", "motor_state[#].dq", true},
      {"tau", "N·m", kState, "motor_state[#].tau_est", "motor_state[#].tau_est", true},
      {"imu.roll", "rad", kState, "imu_state.rpy[0]", "imu_state.rpy[0]"},
      {"imu.pitch", "rad", kState, "imu_state.rpy[1]", "imu_state.rpy[1]"},
      {"imu.gyroscope.x", "rad/s", kState, "imu_state.gyroscope[0]", "imu_state.gyroscope[0]"},
      {"imu.gyroscope.y", "rad/s", kState, "imu_state.gyroscope[1]", "imu_state.gyroscope[1]"},
      {"imu.gyroscope.z", "rad/s", kState, "imu_state.gyroscope[2]", "imu_state.gyroscope[2]"},
      {"imu.accelerometer.x", "m/s²", kState, "imu_state.accelerometer[0]",
       "imu_state.accelerometer[0]"},
      {"imu.accelerometer.y", "m/s²", kState, "imu_state.accelerometer[1]",
       "imu_state.accelerometer[1]"},
      {"imu.accelerometer.z", "m/s²", kState, "imu_state.accelerometer[2]",
       "imu_state.accelerometer[2]"},
      {"battery.voltage", "V", kState, "power_v", "bmsvoltage[0]", false, kBattery, 1e-3F},
      {"battery.current", "A", kState, "power_a", "current", false, kBattery, 1e-3F},
      {"battery.soc", "%", kState, "bms_state.soc", "soc", false, kBattery},
  };
  return rows;
}

const Series* Recorded::Find(std::string_view quantity, int slot) const {
  for (const Series& one : series) {
    if (one.quantity->name == quantity && one.slot == slot) return &one;
  }
  return nullptr;
}

double SecondsOfStates(const record::RecordingReader& reader) {
  std::optional<std::uint64_t> first;
  std::uint64_t last = 0;
  ReadTopics(reader,
             [&](const std::string& topic, const std::string&, const record::McapMessage& message) {
               if (topic != kState) return;
               if (!first) first = message.log_time;
               last = std::max(last, message.log_time);
             });
  if (!first || last <= *first) {
    throw RecordError(reader.path().string() + ": has no messages of " + std::string(kState));
  }
  return 1e-9 * static_cast<double>(last - *first);
}

Recorded ReadRecorded(const record::RecordingReader& reader, double step) {
  Recorded recorded{.file = reader.path().filename().string(), .step = step};
  if (const auto about = reader.contents().metadata.find("understudy");
      about != reader.contents().metadata.end()) {
    recorded.joints = JointsOf(about->second);
    if (const auto robot = about->second.find("robot"); robot != about->second.end()) {
      recorded.robot = robot->second;
    }
  }
  std::map<std::string, std::vector<Reading>, std::less<>> by_topic;
  std::optional<std::uint64_t> begin;
  std::size_t steps = 0;  // that are over
  double last = 0;        // s of the newest state, from the first

  const auto begin_topic = [&](const std::string& topic, const std::string& type) {
    const bool hg = type.starts_with("unitree_hg");
    if (topic == kState) recorded.hg = hg;
    const auto slots = static_cast<int>(hg ? wire::kHgMotorSlots : wire::kGoMotorSlots);
    std::vector<Reading>& readings = by_topic[topic];
    for (const Quantity& quantity : Quantities()) {
      const std::string_view path = hg ? quantity.hg : quantity.go;
      if (quantity.TopicOf(hg) != topic || path.empty()) continue;
      for (int slot = quantity.of_motor ? 0 : -1; slot < (quantity.of_motor ? slots : 0); ++slot) {
        if (slot >= 0 && !recorded.joints.empty() && !recorded.joints.contains(slot)) continue;
        readings.push_back({.field = record::FindField(type, WithSlot(path, slot)),
                            .series = {.quantity = &quantity,
                                       .slot = slot,
                                       .values = std::vector<float>(steps, kUnknown)}});
      }
    }
  };
  // Those of a topic that begins later are filled up when it does.
  const auto fill_to = [&](std::size_t count) {
    for (auto& [topic, readings] : by_topic) {
      for (Reading& one : readings) {
        std::vector<float>& values = one.series.values;
        values.resize(count, values.empty() ? kUnknown : values.back());
      }
    }
    steps = count;
  };
  ReadTopics(reader, [&](const std::string& topic, const std::string& type,
                         const record::McapMessage& message) {
    if (topic != kState && topic != kCommand && topic != kBattery) return;
    if (!begin && topic != kState) return;
    if (!begin) begin = message.log_time;
    if (!by_topic.contains(topic)) begin_topic(topic, type);
    const double at =
        1e-9 * static_cast<double>(message.log_time - std::min(*begin, message.log_time));
    const auto now = static_cast<std::size_t>(std::llround(at / step)) + 1;
    // Commands and battery are known while there are states.
    if (now > steps && topic != kState) return;
    // In s: a step is longer than that where the other recording's clock was set.
    if (topic == kState && at - last > kLongestGap) {
      throw RecordError(reader.path().string() +
                        Printed(": at %.1f s its clock jumps by %.0f s", last, at - last));
    }
    if (topic == kState) last = std::max(last, at);
    if (now > steps) fill_to(now);
    for (Reading& one : by_topic.find(topic)->second) {
      const auto value = record::ReadField(one.field, message.data);
      const bool none = !value || !std::isfinite(*value) || *value == robot::kNoPosition;
      const float scale = recorded.hg ? one.series.quantity->hg_scale : 1;
      one.series.values.back() = none ? kUnknown : static_cast<float>(*value) * scale;
    }
  });
  for (auto& [topic, readings] : by_topic) {
    for (Reading& one : readings) recorded.series.push_back(std::move(one.series));
  }
  return recorded;
}

}  // namespace understudy::rehearse
