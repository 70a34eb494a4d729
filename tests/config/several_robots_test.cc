// Configurations of several robots in one world.
#include "tests/config/config_fixture.h"

namespace understudy::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class SeveralRobotsTest : public ConfigFixture {
 protected:
  Config LoadWorld(const std::string& text, const std::vector<std::string>& sets = {}) const {
    return LoadConfig({.files = {Write("world.yaml", text)}, .sets = sets}, directory_);
  }
  Config LoadNamed(const std::string& robot, const std::vector<std::string>& others,
                   const std::vector<std::string>& sets = {}) const {
    return LoadConfig({.robot = robot, .others = others, .sets = sets}, directory_);
  }
  std::string WorldError(const std::string& text) const {
    return Relative(ErrorOf([&] { LoadWorld(text); }));
  }
  static std::vector<std::string> NamesOf(const Config& config) {
    std::vector<std::string> names;
    for (const RobotConfig& robot : config.robots) names.push_back(robot.name);
    return names;
  }
};

TEST_F(SeveralRobotsTest, OneRobotIsNamedAfterItself) {
  EXPECT_THAT(NamesOf(LoadNamed("tiny", {})), ElementsAre("tiny"));
  EXPECT_EQ(LoadNamed("tiny", {}).robots[0].start.at[1], 0);
}

TEST_F(SeveralRobotsTest, OfTheCommandLineHaveNumbersWhereTheirNamesAreEqual) {
  Write("config/robots/small.yaml", std::string("extends: tiny\nrobot: {name: small}\n"));
  EXPECT_THAT(NamesOf(LoadNamed("tiny", {"small"})), ElementsAre("tiny", "small"));
  EXPECT_THAT(NamesOf(LoadNamed("tiny", {"small", "tiny"})),
              ElementsAre("tiny_1", "small", "tiny_2"));
}

TEST_F(SeveralRobotsTest, StandSideBySideInDomainsThatCountUp) {
  const Config config = LoadNamed("tiny", {"tiny", "tiny"}, {"network.domain=5"});
  for (std::size_t i = 0; i < 3; ++i) {
    const RobotConfig& robot = config.robots[i];
    EXPECT_EQ(robot.network.domain, 5 + static_cast<int>(i));
    EXPECT_EQ(robot.network.interface, "lo");
    EXPECT_THAT(robot.start.at, ElementsAre(0, 1.5 * static_cast<double>(i), 0));
  }
}

TEST_F(SeveralRobotsTest, HaveSettingsOfTheirOwnOverThoseOfAll) {
  const Config config = LoadWorld(
      "gate: {timeout: 0.5}\n"
      "time: {speed: 2}\n"
      "robots:\n"
      "  left: {robot: tiny, start: {at: [0, 3, 1], pose: lying}}\n"
      "  right:\n"
      "    robot: tiny\n"
      "    gate: {timeout: 0.25}\n"
      "    network: {domain: 9, partition: r}\n");
  EXPECT_THAT(NamesOf(config), ElementsAre("left", "right"));
  EXPECT_EQ(config.time.speed, 2);
  EXPECT_EQ(config.robots[0].gate.timeout, 0.5);
  EXPECT_EQ(config.robots[1].gate.timeout, 0.25);
  EXPECT_EQ(config.robots[0].start.pose, "lying");
  EXPECT_EQ(config.robots[1].start.pose, "");
  EXPECT_THAT(config.robots[0].start.at, ElementsAre(0, 3, 1));
  EXPECT_EQ(config.robots[0].network.domain, 0);
  EXPECT_EQ(config.robots[1].network.domain, 9);
  EXPECT_EQ(config.robots[1].network.partition, "r");
}

TEST_F(SeveralRobotsTest, AreSetOneByOneAndAllAtOnce) {
  const std::string world = "robots: {a: {robot: tiny}, b: {robot: tiny}}";
  const Config config =
      LoadWorld(world, {"robots.b.gate=lenient", "crane.length=2", "robots.a.crane.length=3"});
  EXPECT_FALSE(config.robots[0].gate.lenient);
  EXPECT_TRUE(config.robots[1].gate.lenient);
  EXPECT_EQ(config.robots[0].crane.length, 3);
  EXPECT_EQ(config.robots[1].crane.length, 2);
}

TEST_F(SeveralRobotsTest, OfTheCommandLineAreRefinedAndJoinedByThoseOfAFile) {
  const std::string file =
      Write("more.yaml", "robots: {tiny: {gate: lenient}, other: {robot: tiny}}");
  const Config config = LoadConfig({.robot = "tiny", .files = {file}}, directory_);
  EXPECT_THAT(NamesOf(config), ElementsAre("tiny", "other"));
  EXPECT_TRUE(config.robots[0].gate.lenient);
  EXPECT_FALSE(config.robots[1].gate.lenient);
}

TEST_F(SeveralRobotsTest, AreNamedByTheFileOfTheirWorldInPlaceOfARobot) {
  const std::string file = Write("world.yaml", "robots: {a: {robot: tiny}, b: {robot: tiny}}");
  EXPECT_THAT(NamesOf(LoadConfig({.robot = file}, directory_)), ElementsAre("a", "b"));
}

TEST_F(SeveralRobotsTest, MayBeDescribedAsInARobotsFile) {
  const Config config = LoadWorld(
      "robots:\n"
      "  a: {extends: tiny, robot: {name: mine}}\n"
      "  b: {robot: tiny}\n");
  EXPECT_EQ(config.robots[0].spec.name, "mine");
  EXPECT_EQ(config.robots[0].spec.motors.size(), config.robots[1].spec.motors.size());
}

TEST_F(SeveralRobotsTest, OnOneNetworkAreRefusedWithTheRemedy) {
  EXPECT_EQ(WorldError("robots:\n  a: {robot: tiny}\n  b: {robot: tiny, network: {domain: 0}}\n"),
            "robots.b.network: a is in domain 0 too; give one of them another domain or "
            "partition, as with --set robots.b.network.domain=1");
  EXPECT_THAT(WorldError("robots:\n  a: {robot: tiny}\n"
                         "  b: {robot: tiny, network: {interface: eth1}}\n"),
              HasSubstr("a is in domain 0 too"))
      << "multicast reaches all sockets of a computer";
  EXPECT_EQ(WorldError("robots:\n  a: {robot: tiny}\n"
                       "  b: {robot: tiny, network: {domain: 0, partition: b}}\n"),
            "");
}

TEST_F(SeveralRobotsTest, AreRefusedWhereTheyAreMisspelt) {
  EXPECT_THAT(WorldError("robots:\n  a-b: {robot: tiny}\n"),
              StartsWith("world.yaml:2: robots: expected a name of at most 32 letters"));
  EXPECT_THAT(WorldError("robots:\n  a: {robot: tony}\n"),
              HasSubstr("robot 'tony': unknown; did you mean 'tiny'?"));
  EXPECT_THAT(WorldError("robots:\n  a: {gate: lenient}\n"),
              HasSubstr("robots.a: robot: missing; expected the name of a robot"));
  EXPECT_THAT(WorldError("robots:\n  a: {robot: tiny, gait: lenient}\n"),
              HasSubstr("robots.a: unknown key 'gait'; did you mean 'gate'?"));
  EXPECT_THAT(WorldError("robots:\n  a: {robot: tiny, time: {speed: 2}}\n"),
              HasSubstr("robots.a: unknown key 'time'"));
  EXPECT_THAT(WorldError("robots: [tiny]\n"), HasSubstr("robots: expected a mapping"));
  EXPECT_THAT(WorldError("robots:\n  a: {robot: tiny, gate: {timeout: no}}\n"),
              StartsWith("world.yaml:2: gate.timeout"));
}

TEST_F(SeveralRobotsTest, ArePrintedAsTheyAreRead) {
  const Config config = LoadWorld(
      "scene: flat\nrobots:\n  a: {robot: tiny, start: {at: [1, 2, 3]}}\n"
      "  b: {robot: tiny, gate: lenient, network: {domain: 4}}\n");
  const std::string printed = PrintConfig(config, false);
  EXPECT_EQ(PrintConfig(LoadWorld(printed), false), printed);
}

}  // namespace
}  // namespace understudy::config
