#include "record/player.h"

#include <limits>

#include <gmock/gmock.h>

#include "tests/record/mcap_files.h"
#include "tests/support/manual_clock.h"

namespace understudy::record {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::ThrowsMessage;

class PlayerTest : public McapFilesTest {
 protected:
  // Four messages of the robot, 0.1 s apart, from 100 s on; a client's between each.
  PlayerTest() {
    McapWriter writer(OutputFile(File(), false), "ros2", "a test");
    const auto schema = writer.AddSchema("std_msgs/msg/String", "ros2msg", "string data\n");
    const auto channel = [&](const std::string& topic, const std::string& from) {
      return writer.AddChannel("/" + topic, schema, "cdr",
                               {{"from", from}, {"dds_topic", "rt/" + topic}});
    };
    const auto state = channel("lowstate", "robot");
    const auto command = channel("lowcmd", "client");
    const auto truth = writer.AddChannel("understudy/truth", 0, "cdr", {{"from", "simulation"}});
    for (std::uint64_t i = 0; i < 4; ++i) {
      const std::uint64_t time = (1000 + i) * 100'000'000;
      writer.Write(state, time, time, AsBytes("state " + std::to_string(i)));
      writer.Write(truth, time, time, AsBytes("truth"));
      writer.Write(command, time + 50'000'000, time, AsBytes("command " + std::to_string(i)));
    }
    writer.Finish();
  }
  // What was said and when, in ms of wall time.
  std::vector<std::pair<std::int64_t, std::string>> Played(const PlayOptions& options,
                                                           std::size_t most = 100) {
    const McapReader reader(File());
    test::ManualClock clock;
    std::vector<std::pair<std::int64_t, std::string>> played;
    Player player(&reader, options, &clock);
    player.Play([&](double, const McapMessage* message) {
      if (message == nullptr) return true;
      played.emplace_back(clock.Now() / std::chrono::milliseconds(1), TextOf(message->data));
      return played.size() < most;
    });
    return played;
  }
};

TEST_F(PlayerTest, SaysWhatTheRobotSaidAtItsPace) {
  EXPECT_THAT(Played({}), ElementsAre(Pair(0, "state 0"), Pair(100, "state 1"),
                                      Pair(200, "state 2"), Pair(300, "state 3")));
}

TEST_F(PlayerTest, SaysWhatClientsSaid) {
  EXPECT_THAT(Played({.side = PlayedSide::kClients}),
              ElementsAre(Pair(50, "command 0"), Pair(150, "command 1"), Pair(250, "command 2"),
                          Pair(350, "command 3")));
}

TEST_F(PlayerTest, KeepsAnotherSpeed) {
  EXPECT_THAT(Played({.speed = 0.5}), ElementsAre(Pair(0, "state 0"), Pair(200, "state 1"),
                                                  Pair(400, "state 2"), Pair(600, "state 3")));
  EXPECT_THAT(Played({.speed = 0}), ElementsAre(Pair(0, "state 0"), Pair(0, "state 1"),
                                                Pair(0, "state 2"), Pair(0, "state 3")));
}

TEST_F(PlayerTest, SaysAPartOnly) {
  EXPECT_THAT(Played({.from = 0.1, .to = 0.2}),
              ElementsAre(Pair(0, "state 1"), Pair(100, "state 2")));
}

TEST_F(PlayerTest, IsSilentNoLongerThanTheRecordingIs) {
  test::ManualClock clock;
  const McapReader reader(File());
  double last = 0;
  Player(&reader, {.to = 1e300}, &clock).Play([&](double at, const McapMessage*) {
    last = at;
    return true;
  });
  EXPECT_NEAR(last, 0.35, 1e-9);
  EXPECT_EQ(clock.Now(), std::chrono::milliseconds(350));
}

TEST_F(PlayerTest, PlaysNothingForTimesThatAreNone) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Played({.from = none}).size(), 4U);
  EXPECT_EQ(Played({.from = 1e300}).size(), 0U);
  EXPECT_EQ(Played({.speed = 1e-300}, 1).size(), 1U);
}

// Who listens has Ctrl-C to hear of.
TEST_F(PlayerTest, AsksAtEveryEndWhetherToGoOn) {
  test::ManualClock clock;
  const McapReader reader(File());
  int asked = 0;
  Player player(&reader, {.from = 0.11, .to = 0.12, .speed = 0, .loop = true}, &clock);
  player.Play([&](double, const McapMessage* message) {
    EXPECT_EQ(message, nullptr);
    return ++asked < 3;
  });
  EXPECT_EQ(asked, 3);
}

TEST_F(PlayerTest, BeginsAgain) {
  EXPECT_THAT(Played({.from = 0.2, .loop = true}, 4),
              ElementsAre(Pair(0, "state 2"), Pair(100, "state 3"), Pair(150, "state 2"),
                          Pair(250, "state 3")));
}

TEST_F(PlayerTest, TakesTopicsAsRosOrAsDdsSpellsThem) {
  EXPECT_EQ(Played({.topics = {"rt/lowstate"}}).size(), 4U);
  EXPECT_EQ(Played({.topics = {"/lowstate"}}).size(), 4U);
}

TEST_F(PlayerTest, NamesTheNearestTopic) {
  EXPECT_THAT([&] { Played({.topics = {"rt/lowstat"}}); },
              ThrowsMessage<RecordError>(HasSubstr("holds nothing that the robot said on "
                                                   "'rt/lowstat'; did you mean 'rt/lowstate'?")));
  EXPECT_THAT([&] { Played({.topics = {"rt/lowcmd"}}); },
              ThrowsMessage<RecordError>(HasSubstr("'rt/lowcmd'")));
}

TEST_F(PlayerTest, TellsCommandsByTheirTopicsWhereNobodySays) {
  const auto channel = [](const std::string& topic) {
    return McapChannel{.topic = topic, .encoding = "cdr", .metadata = {}};
  };
  EXPECT_TRUE(IsOf(channel("/lowcmd"), PlayedSide::kClients));
  EXPECT_TRUE(IsOf(channel("/api/sport/request"), PlayedSide::kClients));
  EXPECT_TRUE(IsOf(channel("/api/sport/response"), PlayedSide::kRobot));
  EXPECT_TRUE(IsOf(channel("/lf/lowstate"), PlayedSide::kRobot));
  EXPECT_FALSE(IsOf(channel("understudy/truth"), PlayedSide::kRobot));
  EXPECT_EQ(TopicOnWire(channel("/lowcmd")), "rt/lowcmd");
  EXPECT_EQ(TopicOnWire(channel("hello")), "hello");
  McapChannel simulations = channel("/tf");
  simulations.metadata = {{"from", "simulation"}};
  EXPECT_EQ(TopicOnWire(simulations), "/tf");
  EXPECT_FALSE(IsOf(simulations, PlayedSide::kRobot));
  EXPECT_FALSE(IsOf(simulations, PlayedSide::kClients));
}

}  // namespace
}  // namespace understudy::record
