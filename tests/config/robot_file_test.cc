// Robots that extend another, and their hardware revisions: what they are made of, and each way to
// get it wrong.
#include "config/robot_file.h"

#include "config_fixture.h"

namespace understudy::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RobotFileTest : public ConfigFixture {
 protected:
  // A robot that extends tiny, whose revisions the text may add.
  Config LoadLong(const std::string& robot_keys, const std::vector<std::string>& sets = {}) const {
    Write("config/robots/long.yaml", "extends: tiny\nrobot:\n  name: long\n" + robot_keys);
    return LoadConfig({.robot = "long", .files = {}, .sets = sets}, directory_);
  }
  std::string ErrorOfLong(const std::string& robot_keys,
                          const std::vector<std::string>& sets = {}) const {
    return Relative(ErrorOf([&] { LoadLong(robot_keys, sets); }));
  }
};

TEST_F(RobotFileTest, SaysOnlyWhatDiffersFromTheRobotItExtends) {
  const robot::RobotSpec robot = LoadLong("  hanging: {height: 2}\n").robots[0].spec;
  EXPECT_EQ(robot.name, "long");
  EXPECT_EQ(robot.hanging.height, 2);
  EXPECT_THAT(robot.hanging.q, ElementsAre(0, 0));
  EXPECT_EQ(robot.motors[1].torque_limit, 20);
}

TEST_F(RobotFileTest, ChangesElementsOfListsByNameOrIndex) {
  const robot::RobotSpec robot =
      LoadLong("  motors:\n    b: {torque_limit: 30}\n    0: {hold_kp: 5}\n").robots[0].spec;
  ASSERT_EQ(robot.motors.size(), 2U);
  EXPECT_EQ(robot.motors[1].torque_limit, 30);
  EXPECT_EQ(robot.motors[1].slot, 1);
  EXPECT_EQ(robot.motors[0].hold_kp, 5);
  EXPECT_EQ(Load({}, {"robot.motors.b.slot=7"}).robots[0].spec.motors[1].slot, 7);
  EXPECT_THAT(Load({}, {"robot.feet.left.geoms=[x]"}).robots[0].spec.feet[0].geoms,
              ElementsAre("x"));
}

TEST_F(RobotFileTest, ExtendsAFileBesideIt) {
  Write("mine/base.yaml", "");  // there is no folder yet
  Write("mine/base.yaml", test::kTinyRobot);
  const std::string path = Write("mine/mine.yaml", "extends: ./base.yaml\nrobot: {name: mine}\n");
  EXPECT_EQ(LoadConfig({.robot = path}, "/nowhere").robots[0].spec.name, "mine");
  EXPECT_EQ(LoadConfig({.robot = path}, "/nowhere").robots[0].spec.motors.size(), 2U);
}

TEST_F(RobotFileTest, ExtendsWhatExtends) {
  LoadLong("  hanging: {height: 2}\n");
  const std::string path = Write("longer.yaml", "extends: long\nrobot: {name: longer}\n");
  const Config config = LoadConfig({.robot = path}, directory_);
  EXPECT_EQ(config.robots[0].spec.name, "longer");
  EXPECT_EQ(config.robots[0].spec.hanging.height, 2);
}

TEST_F(RobotFileTest, NamesTheFileAndLineOfAFault) {
  EXPECT_EQ(ErrorOfLong("  hight: 2\n").substr(0, 54),
            "config/robots/long.yaml:4: key 'robot.hight': unknown;");
  EXPECT_EQ(ErrorOfLong("  motors:\n    c: {slot: 3}\n"),
            "config/robots/long.yaml:5: robot.motors: has 2 elements, counted from 0; there is no "
            "'c'; did you mean 'a'?");
}

TEST_F(RobotFileTest, RefusesToExtendARobotThatIsNotThere) {
  const std::string path = Write("mine.yaml", "extends: tyni\n");
  EXPECT_EQ(Relative(ErrorOf([&] { LoadConfig({.robot = path}, directory_); })),
            "mine.yaml:1: extends: robot 'tyni': unknown; did you mean 'tiny'? (valid: tiny)");
}

TEST_F(RobotFileTest, RefusesToExtendAFileThatIsNotThere) {
  const std::string path = Write("mine.yaml", "extends: none.yaml\n");
  EXPECT_THAT(ErrorOf([&] { LoadConfig({.robot = path}, directory_); }),
              HasSubstr("none.yaml: cannot be read"));
}

TEST_F(RobotFileTest, RefusesToExtendANameTooLongForAFile) {
  const std::string path = Write("mine.yaml", "extends: " + std::string(300, 'a') + ".yaml\n");
  EXPECT_THAT(ErrorOf([&] { LoadConfig({.robot = path}, directory_); }),
              HasSubstr("a.yaml: cannot be read: File name too long"));
}

TEST_F(RobotFileTest, RefusesToExtendAList) {
  const std::string path = Write("mine.yaml", "extends: [tiny]\n");
  EXPECT_EQ(Relative(ErrorOf([&] { LoadConfig({.robot = path}, directory_); })),
            "mine.yaml:1: extends: expected a robot's name or file, got a list");
}

TEST_F(RobotFileTest, RefusesToExtendItself) {
  Write("a.yaml", "extends: ./b.yaml\n");
  const std::string b = Write("b.yaml", "extends: ./a.yaml\n");
  EXPECT_THAT(ErrorOf([&] { LoadConfig({.robot = b}, directory_); }),
              HasSubstr("a.yaml:1: extends: './b.yaml' extends this file in turn"));
}

TEST_F(RobotFileTest, ExtendsOnlyInARobotsOwnFile) {
  EXPECT_THAT(FileError("extends: tiny\n"), HasSubstr("run.yaml:1: key 'extends': unknown"));
}

constexpr char kRevisions[] = R"(  revision: old
  revisions:
    old: {}
    strong: {motors: {b: {torque_limit: 50}}, mode_machine: 9}
    stiff: {locked_joints: [a]}
)";

TEST_F(RobotFileTest, PlaysTheRevisionThatIsAskedForLast) {
  EXPECT_EQ(LoadLong(kRevisions).robots[0].spec.motors[1].torque_limit, 20);
  const robot::RobotSpec strong =
      LoadLong(kRevisions, {"robot.revision=stiff", "robot.revision=strong"}).robots[0].spec;
  EXPECT_EQ(strong.revision, "strong");
  EXPECT_EQ(strong.motors[1].torque_limit, 50);
  EXPECT_EQ(strong.mode_machine, 9);
  EXPECT_EQ(strong.motors.size(), 2U);
}

TEST_F(RobotFileTest, LaysARevisionBelowEveryOtherLayer) {
  const std::vector<std::string> sets{"robot.motors.b.torque_limit=60", "robot.revision=strong"};
  EXPECT_EQ(LoadLong(kRevisions, sets).robots[0].spec.motors[1].torque_limit, 60);
}

TEST_F(RobotFileTest, HasTheRevisionsOfWhatItExtendsAndItsOwn) {
  LoadLong(kRevisions);
  Write("config/robots/longer.yaml",
        "extends: long\nrobot:\n  revisions:\n    stiff:\n    strong: {hanging: {height: 3}}\n"
        "    new: {}\n");
  EXPECT_THAT(ReadRobotFile("longer", directory_).RevisionNames(),
              ElementsAre("old", "strong", "new"));
  const robot::RobotSpec robot =
      LoadConfig({.robot = "longer", .files = {}, .sets = {"robot.revision=strong"}}, directory_)
          .robots[0]
          .spec;
  EXPECT_EQ(robot.hanging.height, 3);
  EXPECT_EQ(robot.motors[1].torque_limit, 50);
}

TEST_F(RobotFileTest, NamesTheRevisionsThereAre) {
  EXPECT_EQ(ErrorOfLong(kRevisions, {"robot.revision=strange"}),
            "--set robot.revision=strange: robot.revision: this robot has no revision 'strange'; "
            "it has old, strong, stiff");
  EXPECT_EQ(SetError("robot.revision=5"),
            "--set robot.revision=5: robot.revision: this robot has no revision '5', nor any "
            "other");
}

TEST_F(RobotFileTest, NamesTheRobotThatHasTheRevision) {
  LoadLong(kRevisions);
  Write("config/robots/other.yaml", "extends: tiny\nrobot: {revisions: {x: {}}}\n");
  const auto load = [&] {
    LoadConfig({.robot = "other", .files = {}, .sets = {"robot.revision=stiff"}}, directory_);
  };
  EXPECT_THAT(ErrorOf(load), HasSubstr("it has x; long has: understudy run long --revision stiff"));
}

TEST_F(RobotFileTest, TellsAFaultInTheRevisionThatIsPlayed) {
  const std::vector<std::string> sets{"robot.revision=new"};
  EXPECT_THAT(ErrorOfLong("  revisions:\n    old: {}\n    new: {moters: 3}\n", sets),
              HasSubstr("long.yaml:6: key 'robot.moters': unknown; did you mean 'motors'?"));
  EXPECT_THAT(ErrorOfLong("  revisions:\n    new: {locked_joints: [c]}\n", sets),
              HasSubstr("long.yaml:5: robot.locked_joints: no motor has a joint 'c'"));
}

TEST_F(RobotFileTest, ReadsNoRevisionThatIsNotPlayed) {
  EXPECT_EQ(LoadLong("  revisions:\n    new: {moters: 3}\n").robots[0].spec.name, "long");
}

TEST_F(RobotFileTest, RefusesRevisionsThatAreNoMapping) {
  EXPECT_EQ(ErrorOfLong("  revisions: [1, 2]\n"),
            "config/robots/long.yaml:4: robot.revisions: expected a mapping from names to what "
            "differs, got a list");
  EXPECT_EQ(ErrorOfLong("  revisions: {1: two}\n"),
            "config/robots/long.yaml:4: robot.revisions.1: expected a mapping of keys, {} for "
            "none, got 'two'");
}

TEST_F(RobotFileTest, RefusesToTakeAwayARevisionThatIsNotThere) {
  EXPECT_EQ(ErrorOfLong("  revisions:\n    1:\n"),
            "config/robots/long.yaml:5: robot.revisions.1: expected a mapping of keys, {} for "
            "none, got nothing");
}

TEST_F(RobotFileTest, RefusesRevisionsInALayer) {
  EXPECT_THAT(FileError("robot: {revisions: {1: {}}}\n"),
              HasSubstr("run.yaml:1: key 'robot.revisions': unknown"));
}

class LockedJointsTest : public ConfigFixture {};

TEST_F(LockedJointsTest, TakeTheirMotorsAndAnglesOut) {
  const robot::RobotSpec robot = Load({}, {"robot.parallel=[{pitch: 0, roll: 1}]",
                                           "robot.arm_sdk.slots=[0, 1]", "robot.locked_joints=[a]"})
                                     .robots[0]
                                     .spec;
  ASSERT_EQ(robot.motors.size(), 1U);
  EXPECT_EQ(robot.motors[0].joint, "b");
  EXPECT_EQ(robot.motors[0].slot, 1);
  EXPECT_THAT(robot.lying.q, testing::ElementsAre(0.5));
  EXPECT_THAT(robot.standing.q, testing::ElementsAre(0.1));
  EXPECT_THAT(robot.hanging.q, testing::ElementsAre(0));
  EXPECT_TRUE(robot.parallel.empty());
  EXPECT_THAT(robot.arm_sdk.slots, testing::ElementsAre(1));
}

TEST_F(LockedJointsTest, KeepPairsOfOthersByTheirNewPlaces) {
  const robot::RobotSpec robot = Load({Write("three.yaml", R"(robot:
  motors: [{joint: a, slot: 0, torque_limit: 1}, {joint: b, slot: 1, torque_limit: 1},
           {joint: c, slot: 2, torque_limit: 1}]
  parallel: [{pitch: 2, roll: 1}]
  lying: {q: [1, 2, 3]}
  standing: {q: [1, 2, 3]}
  hanging: {q: [1, 2, 3]}
)")},
                                      {"robot.locked_joints=[a]"})
                                     .robots[0]
                                     .spec;
  ASSERT_EQ(robot.parallel.size(), 1U);
  EXPECT_EQ(robot.parallel[0].pitch, 1);
  EXPECT_EQ(robot.parallel[0].roll, 0);
  EXPECT_THAT(robot.lying.q, testing::ElementsAre(2, 3));
}

TEST_F(LockedJointsTest, MustHaveHadAMotor) {
  EXPECT_EQ(SetError("robot.locked_joints=[c]"),
            "--set robot.locked_joints=[c]: robot.locked_joints: no motor has a joint 'c'; did you "
            "mean 'a'? (valid: a, b)");
}

TEST_F(LockedJointsTest, MayHaveBeenLeftOutByTheFileThatListsAllMotors) {
  const Config config = LoadText(
      "robot:\n  motors: [{joint: b, slot: 1, torque_limit: 1}]\n  locked_joints: [a]\n"
      "  lying: {q: [0]}\n  standing: {q: [0]}\n  hanging: {q: [0]}\n");
  EXPECT_EQ(config.robots[0].spec.motors.size(), 1U);
}

TEST_F(LockedJointsTest, LeaveAtLeastOneMotor) {
  EXPECT_THAT(SetError("robot.locked_joints=[a, b]"), testing::HasSubstr("at least one motor"));
}

TEST_F(LockedJointsTest, LeaveNoAngleForAMotorThatIsNotThere) {
  EXPECT_THAT(ErrorOf([&] {
                Load({}, {"robot.locked_joints=[a]", "robot.lying.q=[1, 2]"});
              }),
              testing::HasSubstr("expected one angle per motor, 1, got 2"));
}

TEST_F(LockedJointsTest, BodiesAreRevisedByWholeVectors) {
  EXPECT_EQ(SetError("robot.bodies=[{name: x, pos: [1, 2]}]"),
            "--set robot.bodies=[{name: x, pos: [1, 2]}]: robot.bodies.0.pos: expected 3 numbers "
            "or none, got 2");
  EXPECT_THAT(SetError("robot.bodies=[{name: x, com: [1]}]"), testing::HasSubstr("expected 3"));
  EXPECT_THAT(SetError("robot.bodies=[{name: x, inertia: [1, 1, 1]}]"),
              testing::HasSubstr("expected 6 numbers or none, got 3"));
  EXPECT_THAT(SetError("robot.bodies=[{mass: 1}]"), testing::HasSubstr("name of a body"));
  EXPECT_THAT(SetError("robot.sites=[{pos: [1, 2, 3]}]"), testing::HasSubstr("name of a site"));
}

constexpr char kFirmwares[] = R"(  firmware: "2.5"
  firmwares:
    "2.10": {mode_machine: 3}
    "1.0": {mode_machine: 1, motors: {b: {torque_limit: 50}}}
    "2.0": {mode_machine: 2}
  revisions:
    strong: {mode_machine: 9, motors: {b: {torque_limit: 40}}}
)";

TEST_F(RobotFileTest, PlaysTheNewestFirmwareThatItReaches) {
  const auto played = [&](const std::string& firmware) {
    return LoadLong(kFirmwares, {"robot.firmware='" + firmware + "'"}).robots[0].spec.mode_machine;
  };
  EXPECT_EQ(LoadLong(kFirmwares).robots[0].spec.mode_machine, 2) << "2.5, the robot's own";
  EXPECT_EQ(played("1.0"), 1);
  EXPECT_EQ(played("1.9.9"), 1);
  EXPECT_EQ(played("2.9"), 2);
  EXPECT_EQ(played("2.10.1"), 3);
  EXPECT_EQ(played("0.9"), LoadLong("").robots[0].spec.mode_machine) << "older than all";
}

TEST_F(RobotFileTest, LaysAFirmwareOverARevisionAndBelowEveryOtherLayer) {
  const std::vector<std::string> sets{"robot.firmware='1.0'", "robot.revision=strong"};
  EXPECT_EQ(LoadLong(kFirmwares, sets).robots[0].spec.motors[1].torque_limit, 50);
  EXPECT_EQ(LoadLong(kFirmwares, {"robot.firmware='1.0'", "robot.mode_machine=7"})
                .robots[0]
                .spec.mode_machine,
            7);
}

TEST_F(RobotFileTest, HasTheFirmwaresOfWhatItExtendsAndItsOwn) {
  LoadLong(kFirmwares);
  Write("config/robots/longer.yaml",
        "extends: long\nrobot:\n  firmwares:\n    '2.0':\n    '3.0': {mode_machine: 4}\n");
  const RobotFile file = ReadRobotFile("longer", directory_);
  EXPECT_THAT(file.FirmwareNames(), ElementsAre("2.10", "1.0", "3.0"));
  EXPECT_EQ(file.FindFirmware("2.9")->name, "1.0");
  EXPECT_EQ(file.FindFirmware("0.1"), nullptr);
}

TEST_F(RobotFileTest, RefusesFirmwaresThatAreNoVersions) {
  EXPECT_THAT(ErrorOfLong("  firmwares: {new: {}}\n"),
              HasSubstr("robot.firmwares.new: expected numbers between dots, as in 1.1.6"));
  EXPECT_EQ(ErrorOfLong("  firmwares: [1]\n"),
            "config/robots/long.yaml:4: robot.firmwares: expected a mapping from names to what "
            "differs, got a list");
}

TEST_F(RobotFileTest, TellsAFaultInTheFirmwareThatIsPlayed) {
  EXPECT_THAT(ErrorOfLong("  firmwares:\n    '1.0': {moters: 3}\n", {"robot.firmware='1.2'"}),
              HasSubstr("long.yaml:5: key 'robot.moters': unknown; did you mean 'motors'?"));
}

}  // namespace
}  // namespace understudy::config
