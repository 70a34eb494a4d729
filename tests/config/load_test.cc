#include "config/load.h"

#include "config_fixture.h"

namespace understudy::config {
namespace {

class LoadConfigTest : public ConfigFixture {};

TEST_F(LoadConfigTest, KeepsDefaultsWhereNothingIsSaid) {
  const Config config = LoadText("");
  EXPECT_EQ(config.robots[0].gate.timeout, authority::GateConfig{}.timeout);
  EXPECT_EQ(config.robots[0].network.interface, "lo");
  EXPECT_EQ(config.robots[0].spec.rates.lowstate_hz, robot::RateSpec{}.lowstate_hz);
}

TEST_F(LoadConfigTest, TakesASectionWithoutKeys) {
  EXPECT_EQ(LoadText("gate:\ntime: {}\n").robots[0].gate.timeout, authority::GateConfig{}.timeout);
}

TEST_F(LoadConfigTest, LetsLaterLayersWin) {
  Write("config/robots/tiny.yaml",
        std::string(test::kTinyRobot) + "crane: {length: 1, damping: 1, stiffness: 1, speed: 1}\n");
  const std::string first = Write("a.yaml", "crane: {damping: 2, stiffness: 2, speed: 2}\n");
  const std::string second = Write("b.yaml", "crane: {stiffness: 3, speed: 3}\n");
  const Config config = Load({first, second}, {"crane.speed=4", "crane.speed=5"});
  EXPECT_EQ(config.robots[0].crane.length, 1);
  EXPECT_EQ(config.robots[0].crane.damping, 2);
  EXPECT_EQ(config.robots[0].crane.stiffness, 3);
  EXPECT_EQ(config.robots[0].crane.speed, 5);
}

TEST_F(LoadConfigTest, ReplacesAListAsAWhole) {
  const Config config = LoadText("robot: {feet: [{name: x}, {name: y}]}\n");
  ASSERT_EQ(config.robots[0].spec.feet.size(), 2U);
  EXPECT_TRUE(config.robots[0].spec.feet[0].geoms.empty());
}

TEST_F(LoadConfigTest, ChangesOneElementByItsIndex) {
  const Config config = Load({}, {"robot.motors.1.torque_limit=7", "robot.standing.q.1=0.25"});
  EXPECT_EQ(config.robots[0].spec.motors[1].torque_limit, 7);
  EXPECT_EQ(config.robots[0].spec.motors[1].joint, "b");
  EXPECT_EQ(config.robots[0].spec.motors[0].torque_limit, 10);
  EXPECT_EQ(config.robots[0].spec.standing.q, (std::vector<double>{0, 0.25}));
}

TEST_F(LoadConfigTest, ParsesSetValuesAsYaml) {
  const Config config = Load({}, {"start.pose=clamped", "robot.lying.q=[0.5, 1]",
                                  "robot.rates={lowstate_hz: 1000}", "scene='a b'"});
  EXPECT_EQ(config.robots[0].start.pose, "clamped");
  EXPECT_EQ(config.robots[0].spec.lying.q, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(config.robots[0].spec.rates.lowstate_hz, 1000);
  EXPECT_EQ(config.scene, "a b");
}

TEST_F(LoadConfigTest, TakesABareWordForTheGate) {
  EXPECT_TRUE(LoadText("gate: lenient\n").robots[0].gate.lenient);
  EXPECT_FALSE(LoadText("gate: strict\n").robots[0].gate.lenient);
  EXPECT_TRUE(Load({}, {"gate=lenient"}).robots[0].gate.lenient);
  EXPECT_TRUE(LoadText("gate: {mode: lenient}\n").robots[0].gate.lenient);
}

TEST_F(LoadConfigTest, TakesAPathForARobot) {
  const std::string path = Write("mine.yaml", test::kTinyRobot);
  EXPECT_EQ(LoadConfig({.robot = path}, "/nowhere").robots[0].spec.name, "tiny");
}

TEST_F(LoadConfigTest, FindsAModelBesideTheFileThatNamesIt) {
  EXPECT_EQ(Load({}).robots[0].spec.model, "tiny.xml");  // none is there: below models
  const std::string beside = Write("config/robots/tiny.xml", "<mujoco/>");
  EXPECT_EQ(Load({}).robots[0].spec.model, beside);
  const std::string mine = Write("mine.xml", "<mujoco/>");
  EXPECT_EQ(LoadText("robot: {model: mine.xml}\n").robots[0].spec.model, mine);
  EXPECT_EQ(LoadText("robot: {model: config/robots/../../mine.xml}\n").robots[0].spec.model, mine);
  EXPECT_EQ(Load({}, {"robot.model=mine.xml"}).robots[0].spec.model, "mine.xml");
  EXPECT_EQ(Load({}, {"robot.model=" + mine}).robots[0].spec.model, mine);
}

TEST_F(LoadConfigTest, TakesAModelThatIsNoTextForWhatItIs) {
  EXPECT_NE(FileError("robot: {model: [a]}\n"), "");
  EXPECT_NE(FileError("robot: x\n"), "");
}

TEST_F(LoadConfigTest, ListsRobotsInOrder) {
  Write("config/robots/alpha.yaml", "");
  Write("config/robots/notes.txt", "");
  EXPECT_EQ(RobotNames(directory_), (std::vector<std::string>{"alpha", "tiny"}));
  EXPECT_TRUE(RobotNames(directory_ / "none").empty());
}

TEST(StartPoseTest, IsThatOfAnOwnerAfterBoot) {
  const auto pose = [](const std::string& robot, const std::vector<std::string>& sets) {
    return StartPoseOf(LoadConfig({.robot = robot, .sets = sets}, UNDERSTUDY_SOURCE_DIR).robots[0]);
  };
  EXPECT_EQ(pose("go2", {}), "standing");
  EXPECT_EQ(pose("go2", {"motion.service=mcf"}), "standing");
  EXPECT_EQ(pose("go2", {"motion.service=none"}), "lying") << "nothing holds it up";
  EXPECT_EQ(pose("go2", {"motion.service=none", "start.pose=standing"}), "standing");
  EXPECT_EQ(pose("go2", {"start.pose=lying"}), "lying");
  EXPECT_EQ(pose("b2", {}), "lying");
  EXPECT_EQ(pose("g1", {"motion.service=none"}), "hanging");
}

}  // namespace
}  // namespace understudy::config
