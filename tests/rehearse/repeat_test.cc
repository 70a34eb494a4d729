#include "rehearse/repeat.h"

#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "record/cdr_field.h"
#include "record/mcap_reader.h"
#include "record/mcap_writer.h"
#include "record/ros2msg.h"
#include "tests/support/temporary_folder.h"

namespace understudy::rehearse {
namespace {

using testing::IsEmpty;

constexpr char kState[] = "unitree_go/msg/LowState", kCmd[] = "unitree_go/msg/LowCmd";
constexpr std::uint64_t kPeriod = 2'000'000;  // ns

// What a recording of 3 s says of a robot and its program.
struct Talk {
  std::uint64_t start = 5'000'000'000;
  std::size_t commands = 1500;
  std::size_t late = 10'000;   // this command comes a period later
  std::size_t other = 10'000;  // this one asks for another angle
  std::size_t states = 1500;
};

class RepeatTest : public testing::Test {
 protected:
  std::filesystem::path Recording(const std::string& name, const Talk& play) {
    const std::filesystem::path file = folder_.path() / name;
    record::McapWriter writer(record::OutputFile(file, true), "ros2", "a test");
    writer.AddMetadata("understudy", {{"start_time_ns", std::to_string(play.start)}});
    const auto channel = [&](const char* topic, const char* type, const char* from) {
      return writer.AddChannel(topic, writer.AddSchema(type, "ros2msg", record::Ros2MsgText(type)),
                               "cdr", {{"from", from}});
    };
    const auto state = channel("/lowstate", kState, "robot");
    const auto cmd = channel("/lowcmd", kCmd, "client");
    const record::CdrField q = record::FindField(kCmd, "motor_cmd[3].q");
    for (std::size_t i = 0; i < 1500; ++i) {
      std::string message(2000, '\0');
      message[1] = 1;  // little-endian
      const std::uint64_t at = play.start + i * kPeriod;
      if (i < play.states) writer.Write(state, at, at, record::AsBytes(message));
      if (i >= play.commands) continue;
      const float angle = i == play.other ? 0.75F : 0.5F;
      std::memcpy(&message[4 + q.offset], &angle, sizeof(angle));
      writer.Write(cmd, i == play.late ? at + kPeriod : at, at, record::AsBytes(message));
    }
    writer.Finish();
    return file;
  }
  std::string Difference(const Talk& first, const Talk& second) {
    return FirstDifference(record::McapReader(Recording("first.mcap", first)),
                           record::McapReader(Recording("second.mcap", second)));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(RepeatTest, RunsThatSayTheSameDoNotDifferWhenTheyBegan) {
  EXPECT_THAT(Difference({}, {.start = 7'000'000'000}), IsEmpty());
}

TEST_F(RepeatTest, NamesTheFieldThatDiffersFirst) {
  EXPECT_EQ(Difference({}, {.other = 951, .states = 1400}),
            "message 952 of /lowcmd from client at 1.902 s: motor_cmd[3].q was 0.5, then 0.75");
}

TEST_F(RepeatTest, NamesTheTimeThatDiffersFirst) {
  EXPECT_EQ(Difference({}, {.late = 1000, .other = 1001}),
            "message 1001 of /lowcmd from client was at 2 s, then at 2.002 s");
}

TEST_F(RepeatTest, NamesWhatOneRunAloneSays) {
  EXPECT_EQ(Difference({.states = 1499}, {}),
            "message 1500 of /lowstate from robot at 2.998 s is only in the second run");
  EXPECT_EQ(Difference({}, {.commands = 0}),
            "message 1 of /lowcmd from client at 0 s is only in the first run");
}

}  // namespace
}  // namespace understudy::rehearse
