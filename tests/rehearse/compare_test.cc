#include "rehearse/compare.h"

#include <cmath>
#include <cstring>
#include <map>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "record/cdr_field.h"
#include "record/mcap_reader.h"
#include "record/mcap_writer.h"
#include "record/ros2msg.h"
#include "robot/robot_values.h"
#include "tests/support/temporary_folder.h"

namespace understudy::rehearse {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::ThrowsMessage;

constexpr char kGoState[] = "unitree_go/msg/LowState", kGoCmd[] = "unitree_go/msg/LowCmd";

// What a robot of two motors was recorded to do.
struct Play {
  double begin = 0;  // s of the movement at which the recording begins
  double seconds = 4;
  double lag = 0.02;          // s of the angles behind their commands
  double more = 0;            // rad, of the first angle
  double tau = 1;             // N·m
  double clock_set = 0;       // s, by which the clock is put forward after 2 s
  bool late_command = false;  // one is stamped a year later
  bool commands = true, moves = true;
  record::StringMap about = {
      {"robot", "go2"}, {"motors", "hip_joint knee_joint"}, {"slots", "0 1"}};
};

class CompareTest : public testing::Test {
 protected:
  // A message of zeros but for these fields.
  static std::string MessageOf(const std::string& type,
                               const std::vector<std::pair<std::string, float>>& fields) {
    std::string message(2000, '\0');
    message[1] = 1;  // little-endian
    for (const auto& [path, value] : fields) {
      static std::map<std::string, record::CdrField> fields_of;
      const auto [known, is_new] = fields_of.try_emplace(type + path);
      if (is_new) known->second = record::FindField(type, path);
      const record::CdrField& field = known->second;
      std::memcpy(&message[4 + field.offset], &value, sizeof value);
    }
    return message;
  }

  std::filesystem::path Recording(const std::string& name, const Play& play) {
    const std::filesystem::path file = folder_.path() / name;
    record::McapWriter writer(record::OutputFile(file, true), "ros2", "a test");
    if (!play.about.empty()) writer.AddMetadata("understudy", play.about);
    const auto channel = [&](const char* topic, const char* type) {
      return writer.AddChannel(topic, writer.AddSchema(type, "ros2msg", record::Ros2MsgText(type)),
                               "cdr", {});
    };
    const auto state = channel("/lowstate", kGoState), cmd = channel("/lowcmd", kGoCmd);
    // Moves that are like themselves at no other time.
    const auto angle = [&](double t, int joint) {
      if (!play.moves) return 0.0;
      return 0.3 * std::sin(2 * t + 0.4 * t * t / 10 + joint) + 0.1 * std::sin(7.3 * t);
    };
    for (int i = 0; i < static_cast<int>(play.seconds * 500); ++i) {
      const double t = play.begin + 0.002 * i;
      const double set = i > 1000 ? play.clock_set : 0;
      const std::uint64_t at = 5'000'000'000 + static_cast<std::uint64_t>(i) * 2'000'000 +
                               static_cast<std::uint64_t>(set * 1e9);
      const auto f = [](double value) { return static_cast<float>(value); };
      const std::string told =
          MessageOf(kGoState, {{"motor_state[0].q", f(angle(t - play.lag, 0) + play.more)},
                               {"motor_state[1].q", f(angle(t - play.lag, 1))},
                               {"motor_state[1].tau_est", f(play.tau)},
                               {"imu_state.rpy[0]", f(0.01 * play.tau)},
                               {"power_v", 28}});
      writer.Write(state, at, at, record::AsBytes(told));
      if (!play.commands) continue;
      const std::string asked =
          MessageOf(kGoCmd, {{"motor_cmd[0].q", f(angle(t, 0))},
                             {"motor_cmd[1].q", static_cast<float>(robot::kNoPosition)}});
      writer.Write(cmd, at, at, record::AsBytes(asked));
      constexpr std::uint64_t kYear = 31'536'000'000'000'000;
      if (play.late_command && i == 0) writer.Write(cmd, at + kYear, at, record::AsBytes(asked));
    }
    writer.Finish();
    return file;
  }
  Differences Compared(const Play& first, const Play& second,
                       std::optional<double> shift = std::nullopt) {
    return Compare(record::McapReader(Recording("first.mcap", first)),
                   record::McapReader(Recording("second.mcap", second)), shift);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(CompareTest, FindsBetweenARecordingAndItselfNothing) {
  const Differences same = Compared({}, {});
  EXPECT_TRUE(same.aligned);
  EXPECT_EQ(same.shift, 0);
  EXPECT_NEAR(same.likeness, 1, 1e-6);
  ASSERT_THAT(same.motors, SizeIs(2));
  EXPECT_EQ(same.motors[0].joint, "hip");
  EXPECT_EQ(same.motors[0].q.rms, 0);
  EXPECT_EQ(same.motors[1].tau.rms, 0);
}

TEST_F(CompareTest, AlignsThemByTheirMovements) {
  for (const double begin : {0.7, -1.1}) {
    const Differences shifted = Compared({}, {.begin = begin});
    EXPECT_NEAR(shifted.shift, begin, 1e-9);
    EXPECT_LT(shifted.motors[0].q.rms.value(), 1e-6);
    EXPECT_NEAR(shifted.from, std::max(0.0, begin), 1e-9);
  }
}

TEST_F(CompareTest, MeasuresHowFarTheyAreApart) {
  const Differences apart = Compared({}, {.more = 0.05, .tau = -2});
  EXPECT_NEAR(apart.motors[0].q.rms.value(), 0.05, 1e-6);
  EXPECT_NEAR(apart.motors[0].q.most.value(), 0.05, 1e-6);
  EXPECT_EQ(apart.motors[1].q.rms, 0);
  EXPECT_NEAR(apart.motors[1].tau.rms.value(), 3, 1e-6);
  const auto roll = std::ranges::find(apart.rest, "imu.roll", &Apart::name);
  ASSERT_NE(roll, apart.rest.end());
  EXPECT_NEAR(roll->rms.value(), 0.03, 1e-6);
  EXPECT_NEAR(roll->rms_second.value(), 0.02, 1e-6);
}

TEST_F(CompareTest, MeasuresHowMotorsFollowTheirCommands) {
  const Differences lags = Compared({.lag = 0.02}, {.lag = 0.06});
  EXPECT_NEAR(lags.motors[0].first.lag.value(), 0.02, 1e-9);
  EXPECT_NEAR(lags.motors[0].second.lag.value(), 0.06, 1e-9);
  EXPECT_LT(lags.motors[0].first.error.value(), lags.motors[0].second.error.value());
  EXPECT_NEAR(lags.shift, -0.04, 1e-9);  // the angles are later
}

TEST_F(CompareTest, TakesNoPositionForNone) {
  EXPECT_EQ(Compared({}, {}).motors[1].first.error, std::nullopt);
}

TEST_F(CompareTest, NeedsNoCommands) {
  const Differences states = Compared({}, {.commands = false});
  EXPECT_EQ(states.motors[0].second.lag, std::nullopt);
  EXPECT_EQ(states.motors[0].q.rms, 0);
}

TEST_F(CompareTest, ShiftsByWhatItIsTold) {
  const Differences told = Compared({}, {}, 0.5);
  EXPECT_FALSE(told.aligned);
  EXPECT_NEAR(told.shift, 0.5, 1e-9);
  EXPECT_GT(told.motors[0].q.rms.value(), 0.05);
}

TEST_F(CompareTest, BeginsBothAtTheirStartsWhereNothingMoves) {
  const Differences still = Compared({.moves = false}, {.moves = false});
  EXPECT_FALSE(still.aligned);
  EXPECT_EQ(still.shift, 0);
  EXPECT_THAT(CompareText(still), HasSubstr("too little moves"));
}

TEST_F(CompareTest, NamesMotorsOfOtherRecordersAsTheOneThatKnows) {
  EXPECT_EQ(Compared({}, {.about = {}}).motors[1].joint, "knee");
  const Differences nameless = Compared({.about = {}}, {.about = {}});
  ASSERT_THAT(nameless.motors, SizeIs(2));  // of 20 slots
  EXPECT_EQ(nameless.motors[1].joint, "1");
}

// A robot without a clock gets one when it finds a server of time.
TEST_F(CompareTest, SaysWhereAClockWasSet) {
  for (const double set : {100.0, 1e6, 3e7}) {  // s
    const std::string jump =
        "at 2.0 s its clock jumps by " + std::to_string(std::lround(set)) + " s";
    EXPECT_THAT([&] { Compared({.clock_set = set}, {}); },
                ThrowsMessage<RecordError>(HasSubstr("first.mcap: " + jump)));
    EXPECT_THAT([&] { Compared({}, {.clock_set = set}); },
                ThrowsMessage<RecordError>(HasSubstr("second.mcap: " + jump)));
  }
}

TEST_F(CompareTest, TakesNoCommandsFromAfterTheLastState) {
  const Differences same = Compared({.late_command = true}, {});
  EXPECT_NEAR(same.to, Compared({}, {}).to, 0.1);
}

TEST_F(CompareTest, RefusesOtherRobots) {
  EXPECT_THAT(
      [&] {
        Compared({}, {.about = {{"robot", "b2"}}});
      },
      ThrowsMessage<RecordError>(HasSubstr("first.mcap is of go2, second.mcap of b2: expected")));
}

TEST_F(CompareTest, RefusesLessThanASecondInCommon) {
  EXPECT_THAT([&] { Compared({}, {}, 3.5); },
              ThrowsMessage<RecordError>(HasSubstr("less than a second in common")));
}

TEST_F(CompareTest, RefusesARecordingWithoutStates) {
  const std::filesystem::path file = folder_.path() / "empty.mcap";
  record::McapWriter writer(record::OutputFile(file, true), "ros2", "a test");
  writer.Finish();
  EXPECT_THAT([&] { Compare(record::McapReader(file), record::McapReader(file), {}); },
              ThrowsMessage<RecordError>(HasSubstr("empty.mcap: has no messages of rt/lowstate")));
}

TEST_F(CompareTest, IsToldAsLinesJsonAndAPage) {
  const Differences apart = Compared({}, {.more = 0.05, .commands = false});
  const std::string text = CompareText(apart);
  EXPECT_THAT(text, HasSubstr("first.mcap and second.mcap, go2"));
  EXPECT_THAT(text, HasSubstr("\nhip                        50           50"));
  const auto json = nlohmann::json::parse(CompareJson(apart));
  EXPECT_NEAR(json["motors"][0]["q"]["rms"], 0.05, 1e-6);
  EXPECT_TRUE(json["motors"][0]["second"]["lag"].is_null());
  const std::string html = CompareHtml(apart);
  EXPECT_THAT(html, HasSubstr("class=\"other\""));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_LT(html.find("hip [rad]"), html.find("knee [rad]"));  // the worst first
}

TEST_F(CompareTest, NamesFilesOfOneNameByTheirPaths) {
  std::filesystem::create_directory(folder_.path() / "a");
  const auto one = Recording("a/r.mcap", {}), other = Recording("r.mcap", {});
  const Differences named = Compare(record::McapReader(one), record::McapReader(other), {});
  EXPECT_EQ(named.first, one.string());
  EXPECT_EQ(named.second, other.string());
}

}  // namespace
}  // namespace understudy::rehearse
