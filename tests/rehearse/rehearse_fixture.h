// A robot of two joints, and recordings of it that exist in memory only.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "record/cdr_field.h"
#include "record/truth.h"
#include "rehearse/expectations.h"
#include "rehearse/judged.h"
#include "schema/yaml_document.h"
#include "tests/config/config_fixture.h"

namespace understudy::rehearse {

inline Names TinyNames() {
  return {.joints = {"hip_joint", "knee_joint"},
          .slots = {0, 1},
          .torque_limits = {20, 40},
          .feet = {"left", "right"},
          .hands = {"left", "right"},
          .pads = {"left_tip", "right_tip"},
          .objects = {"cube", "cup"},
          .topics = {{"rt/lowcmd", "unitree_go::msg::dds_::LowCmd_"},
                     {"rt/lowstate", "unitree_go::msg::dds_::LowState_"}},
          .wrong_field = WrongField};
}

// Reads the expectation(s) of a list in YAML.
inline Expectations ReadExpect(const std::string& list) {
  return ReadExpectations(schema::ParseYaml(list, "e"), TinyNames());
}

// Gives messages to an audience, as a recorder or a file does.
class Stage {
 public:
  explicit Stage(record::Audience* audience) : audience_(audience) { audience_->Begin(kStart); }

  // A base at a height [m], turned about x by `roll` [rad].
  void Truth(double at, double height, double roll = 0) {
    record::Truth truth{.time = at,
                        .qpos = {1, 2, height, std::cos(roll / 2), std::sin(roll / 2), 0, 0, 0, 0},
                        .qvel = {3, 4, 0, 0, 0, 0, 0, 0},
                        .tau = {10, -20},
                        .foot_force = {50, 70},
                        .hand_force = {5, 7},
                        .touch = {0.25, 0.5}};
    Tell(truth);
  }
  // An object at a place [m], turned about x by `roll` [rad], beside a fixed base. The recording
  // says that its position begins at `address`; it does at 1.
  void Object(double at, const std::string& name, const std::array<double, 3>& p, double roll = 0,
              std::size_t address = 1) {
    record::BytesOut bytes;
    record::EncodeTruth(
        {.time = at,
         .qpos = {9, p[0], p[1], p[2], std::cos(roll / 2), std::sin(roll / 2), 0, 0},
         .qvel = {9, 2, 3, 6, 0, 0, 0}},
        &bytes);
    record::McapChannel channel = Channel(record::kTruthTopic);
    record::AddObjects({{name, {.qpos = address, .qvel = 1}}}, &channel.metadata);
    Tell(channel, record::kTruthType, at, bytes.span());
  }
  // Joints with these angles [rad] and torques [N·m] on a base that is fixed.
  void Joints(double at, const std::vector<double>& q, const std::vector<double>& tau) {
    Tell({.time = at, .qpos = q, .qvel = std::vector<double>(q.size()), .tau = tau});
  }
  void Event(double at, const std::string& kind, const std::string& detail = "{}") {
    record::BytesOut bytes;
    record::EncodeEvent({.time = at, .kind = kind, .text = kind, .detail = detail}, &bytes);
    Tell(Channel(record::kEventTopic), record::kEventType, at, bytes.span());
  }
  // A message of the go family in which these fields have values, and all others are 0.
  using Fields = std::vector<std::pair<std::string, float>>;
  void Go(double at, const std::string& topic, const std::string& type, const Fields& fields) {
    std::vector<std::byte> bytes(2048);
    bytes[1] = std::byte{1};  // little-endian
    for (const auto& [path, value] : fields) {
      const record::CdrField field = record::FindField(type, path);
      if (field.type == "float32") {
        std::memcpy(bytes.data() + 4 + field.offset, &value, sizeof value);
      } else {
        bytes[4 + field.offset] = static_cast<std::byte>(value);
      }
    }
    Tell(Channel("/" + topic), type, at, bytes);
  }
  // A LowState and a LowCmd with angles of both joints [rad].
  void State(double at, float hip, float knee) {
    Go(at, "lowstate", "unitree_go/msg/LowState",
       {{"motor_state[0].q", hip}, {"motor_state[1].q", knee}});
  }
  void Command(double at, float hip, float knee, float kp) {
    Go(at, "lowcmd", "unitree_go/msg/LowCmd",
       {{"motor_cmd[0].mode", 1},
        {"motor_cmd[0].q", hip},
        {"motor_cmd[0].kp", kp},
        {"motor_cmd[1].mode", 1},
        {"motor_cmd[1].q", knee},
        {"motor_cmd[1].kp", kp}});
  }
  // An empty message of a topic.
  void Message(double at, const std::string& topic) {
    Tell(Channel("/" + topic), "unitree_go/msg/LowState", at, {});
  }

 private:
  void Tell(const record::Truth& truth) {
    record::BytesOut bytes;
    record::EncodeTruth(truth, &bytes);
    Tell(Channel(record::kTruthTopic), record::kTruthType, truth.time, bytes.span());
  }
  static constexpr std::uint64_t kStart = 1'000'000'000'000;

  static record::McapChannel Channel(const std::string& topic) {
    record::McapChannel channel;
    channel.topic = topic;
    return channel;
  }

  void Tell(const record::McapChannel& channel, std::string_view type, double at,
            record::ByteSpan data) {
    const auto since = static_cast<std::uint64_t>(std::llround(at * 1e9));
    audience_->Hear(channel, type, {.log_time = kStart + since, .data = data});
  }

  record::Audience* audience_;
};

}  // namespace understudy::rehearse
