#include "rehearse/repeat.h"

#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "record/cdr_field.h"
#include "record/mcap_reader.h"
#include "record/mcap_writer.h"
#include "record/ros2msg.h"
#include "record/truth.h"
#include "tests/support/temporary_folder.h"

namespace understudy::rehearse {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
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
  std::size_t heard = 10'000;  // in this state the robot is another
  std::size_t again = 10'000;  // this state is said also beyond `states`
  std::size_t size = 2000;     // bytes of the last state, more than its type has
  char end = 0;                // its byte 1999
  std::string ends = "0.5 s";  // what an event says of the program's end, at 1 s
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
    const auto event = writer.AddChannel(
        record::kEventTopic, writer.AddSchema(record::kEventType, "ros2msg", record::kEventText),
        "cdr", {{"from", "simulation"}});
    const auto cmd = channel("/lowcmd", kCmd, "client");
    const record::CdrField q = record::FindField(kCmd, "motor_cmd[3].q");
    for (std::size_t i = 0; i < 1500; ++i) {
      std::string message(2000, '\0');
      message[1] = 1;  // little-endian
      const std::uint64_t at = play.start + i * kPeriod;
      if (i == play.heard) message[5] = 1;
      if (i == 500) {
        record::BytesOut ended;
        record::EncodeEvent({.kind = "program_end", .text = play.ends}, &ended);
        writer.Write(event, at, at, ended.span());
      }
      if (i == 1499) message[1999] = play.end;
      if (i == 1499) message.resize(play.size);
      if (i < play.states || i == play.again) {
        writer.Write(state, at, at, record::AsBytes(message));
      }
      message.resize(2000);
      message[5] = message[1999] = 0;
      if (i >= play.commands) continue;
      const float angle = i == play.other ? 0.75F : 0.5F;
      std::memcpy(&message[4 + q.offset], &angle, sizeof(angle));
      writer.Write(cmd, i == play.late ? at + kPeriod : at, at, record::AsBytes(message));
    }
    writer.Finish();
    return file;
  }
  std::string Difference(const Talk& first, const Talk& second) {
    const auto found = Found(first, second);
    return found ? found->text : "";
  }
  std::optional<rehearse::Difference> Found(const Talk& first, const Talk& second) {
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
  EXPECT_EQ(Difference({}, {.late = 1000, .heard = 1000}),
            "message 1001 of /lowcmd from client was at 2 s, then at 2.002 s");
  EXPECT_EQ(Difference({.states = 0}, {.late = 0, .states = 0}),
            "message 1 of /lowcmd from client was at 0 s, then at 0.002 s");
}

TEST_F(RepeatTest, NamesWhatOneRunAloneSays) {
  EXPECT_EQ(Difference({.states = 1499}, {}),
            "message 1500 of /lowstate from robot at 2.998 s is only in the second run");
  EXPECT_EQ(Difference({}, {.commands = 0}),
            "message 1 of /lowcmd from client at 0 s is only in the first run");
  EXPECT_EQ(Difference({.commands = 0, .states = 0}, {.commands = 0, .states = 0, .again = 1450}),
            "message 1 of /lowstate from robot at 2.9 s is only in the second run");
}

TEST_F(RepeatTest, NamesBytesThatAreOfNoField) {
  EXPECT_EQ(Difference({}, {.end = 1}),
            "message 1500 of /lowstate from robot at 2.998 s: byte 1999 differs");
  EXPECT_EQ(Difference({}, {.size = 2001}),
            "message 1500 of /lowstate from robot at 2.998 s: was 2000 bytes long, then 2001");
}

TEST_F(RepeatTest, NamesATextThatDiffers) {
  EXPECT_EQ(
      Difference({}, {.ends = "0.6 s"}),
      "message 1 of understudy/events from simulation at 1 s: text was '0.5 s', then '0.6 s'");
}

TEST_F(RepeatTest, OfTwoAtOneInstantNamesWhatTheProgramSaid) {
  const auto found = Found({}, {.other = 800, .heard = 800});
  ASSERT_TRUE(found);
  EXPECT_THAT(found->text, HasSubstr("/lowcmd"));
  EXPECT_TRUE(found->of_program);
  EXPECT_FALSE(Found({}, {.other = 801, .heard = 800})->of_program);
  EXPECT_TRUE(Found({}, {.ends = ""})->of_program);
}

TEST(CauseTest, IsWhatIsKnownTheSurest) {
  const Difference of_program{.of_program = true}, of_robot{};
  const Repeated clocked{.with_program = true, .simulated_clock = true};
  Repeated stalled = clocked;
  stalled.unrepeatable = "thread 7 of python3 (7) computes";
  EXPECT_EQ(CauseOf(of_program, stalled), "thread 7 of python3 (7) computes");
  EXPECT_THAT(CauseOf(of_program, {.with_program = true}), HasSubstr("the computer's clock"));
  EXPECT_THAT(CauseOf(of_robot, {.private_network = false}), HasSubstr("others on the network"));
  EXPECT_THAT(CauseOf(of_program, clocked), HasSubstr("had no real-time priority"));
  Repeated prior = clocked;
  prior.realtime_priority = true;
  EXPECT_THAT(CauseOf(of_program, prior), EndsWith("or its threads race"));
  EXPECT_THAT(CauseOf(of_robot, clocked), HasSubstr("the program has no part in it"));
}

}  // namespace
}  // namespace understudy::rehearse
