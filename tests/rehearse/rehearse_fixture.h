// A robot of two joints, and recordings of it that exist in memory only.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/yaml_document.h"
#include "record/truth.h"
#include "rehearse/expectations.h"
#include "rehearse/judged.h"
#include "tests/config/config_fixture.h"

namespace understudy::rehearse {

inline Names TinyNames() {
  return {.joints = {"hip_joint", "knee_joint"},
          .slots = {0, 1},
          .feet = {"left", "right"},
          .topics = {{"rt/lowcmd", "unitree_go::msg::dds_::LowCmd_"},
                     {"rt/lowstate", "unitree_go::msg::dds_::LowState_"}},
          .wrong_field = WrongField};
}

// Reads the expectation(s) of a list in YAML.
inline Expectations ReadExpect(const std::string& list) {
  return ReadExpectations(config::ParseYaml(list, "e"), TinyNames());
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
                        .foot_force = {50, 70}};
    record::BytesOut bytes;
    record::EncodeTruth(truth, &bytes);
    Tell(Channel(record::kTruthTopic), record::kTruthType, at, bytes.span());
  }
  void Event(double at, const std::string& kind, const std::string& detail = "{}") {
    record::BytesOut bytes;
    record::EncodeEvent({.time = at, .kind = kind, .text = kind, .detail = detail}, &bytes);
    Tell(Channel(record::kEventTopic), record::kEventType, at, bytes.span());
  }
  // An empty message of a topic.
  void Message(double at, const std::string& topic) {
    Tell(Channel("/" + topic), "unitree_go/msg/LowState", at, {});
  }

 private:
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
