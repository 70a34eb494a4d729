// Small recordings of runs, for tests of what is made of them.
#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "record/cdr_field.h"
#include "record/truth.h"
#include "tests/record/mcap_files.h"

namespace understudy::record {

// A run in 10 ms steps: a base, and motor FR_hip in slot 3 of a go robot, as functions of time [s].
struct MadeRun {
  double seconds = 10;
  std::function<double(double)> height = [](double) { return 0.3; };
  std::function<double(double)> q = [](double) { return 0.0; };
  std::vector<RecordedEvent> events{};
  bool named = true;  // the recording names its motors
};

class RunsTest : public McapFilesTest {
 protected:
  std::filesystem::path Make(const std::string& name, const MadeRun& run) {
    const std::filesystem::path file = File(name);
    McapWriter writer(OutputFile(file, true), "ros2", "a test");
    StringMap about{{"robot", "go2"}, {"start_time_ns", "1000"}};
    if (run.named) {
      about["motors"] = "FR_hip_joint";
      about["slots"] = "3";
    }
    writer.AddMetadata("understudy", about);
    const auto channel = [&](const char* topic, const char* type, const char* text) {
      return writer.AddChannel(topic, writer.AddSchema(type, "ros2msg", text), "cdr", {});
    };
    const auto truth = channel(kTruthTopic, kTruthType, kTruthText);
    const auto event = channel(kEventTopic, kEventType, kEventText);
    const auto state = channel("/lowstate", "unitree_go/msg/LowState", "");
    const CdrField q = FindField("unitree_go/msg/LowState", "motor_state[3].q");
    BytesOut message;
    auto next = run.events.begin();
    for (int i = 0; i <= std::lround(run.seconds * 100); ++i) {
      const double at = i / 100.0;
      const std::uint64_t time = 1000 + static_cast<std::uint64_t>(i) * 10'000'000;
      EncodeTruth({.step = 10 * i,
                   .time = at,
                   .qpos = {0, 0, run.height(at), 1, 0, 0, 0},
                   .qvel = std::vector<double>(6)},
                  &message);
      writer.Write(truth, time, time, message.span());
      std::string bytes(2000, '\0');
      bytes[1] = 1;
      const auto value = static_cast<float>(run.q(at));
      std::memcpy(bytes.data() + 4 + q.offset, &value, sizeof value);
      writer.Write(state, time, time, AsBytes(bytes));
      for (; next != run.events.end() && next->time <= at; ++next) {
        EncodeEvent(*next, &message);
        writer.Write(event, time, time, message.span());
      }
    }
    writer.Finish();
    return file;
  }
};

}  // namespace understudy::record
