#include "config/validate.h"

#include "authority/onboard.h"
#include "config_fixture.h"
#include "tests/support/robots.h"

namespace understudy::config {
namespace {

class ValidateTest : public ConfigFixture {};

TEST_F(ValidateTest, NamesThePlaceOfWhatDoesNotFit) {
  EXPECT_EQ(FileError("time: {speed: 1}\nrobot: {rates: {lowstate_hz: 300}}\n"),
            "run.yaml:2: robot.rates.lowstate_hz: expected a rate whose period is a whole number "
            "of physics steps of 0.001 s, got 300");
}

TEST_F(ValidateTest, TellsWhatDoesNotFitAndWhatDoes) {
  const std::pair<std::string, std::string> rows[] = {
      {"robot.motors.1.slot=0",
       "robot.motors.1.slot: expected more than 0, as slots ascend and no two are alike, "
       "got 0"},
      {"robot.motors.1.joint=a", "robot.motors.1.joint: 'a' has a motor already"},
      {"robot.motors.1.torque_limit=0", "robot.motors.1.torque_limit: expected more than 0 N·m"},
      {"robot.motors.0.knee_speed=8",
       "robot.motors.0.knee_speed: expected less than no_load_speed 8 rad/s, got 8"},
      {"robot.standing.q=[0]", "robot.standing.q: expected one angle per motor, 2, got 1"},
      {"robot.motion.humanoid.balance=[1.5]",
       "robot.motion.humanoid.balance.0: expected a whole number from -1 to 1000, got '1.5'"},
      {"robot.rates.lf_hz=30",
       "robot.rates.lf_hz: expected a rate that divides lowstate_hz 500, got 30"},
      {"robot.rates.motion_hz=2000",
       "robot.rates.motion_hz: expected at most one message per physics step, 1000 Hz, got 2000"},
      {"robot.motors.1.type=Go2VH",
       "robot.motors.1.type: no motor type 'Go2VH', nor any other: config/motors.yaml is missing"},
      {"robot.motors.1.gear=0", "robot.motors.1.gear: expected a number from 0.01 to 100, got '0'"},
      {"robot.battery.cell_v.10=3.5",
       "robot.battery.cell_v: expected rising voltages, got 3.5 after 4.068"},
      {"robot.battery.cutoff_v=3.5",
       "robot.battery.cutoff_v: expected less than a cell at a tenth of its charge has, 3.42 V, "
       "got 3.5"},
      {"robot.cameras=[{name: a}, {name: a}]", "robot.cameras.1.name: there is a 'a' already"},
      {"robot.cameras=[{name: a, service: videhub}]",
       "robot.cameras.0.service: no service 'videhub'; did you mean 'videohub'?"},
      {"robot.cameras=[{name: a, depth: [10, 1]}]",
       "robot.cameras.0.depth: expected the nearest before the farthest"},
      {"robot.cameras=[{name: a, distortion: [-2, 0, 0, 0]}]",
       "robot.cameras.0.distortion: expected a lens that shows each direction once, within 80° of "
       "its axis"},
      {"robot.cameras=[{name: a_right}, {name: a, baseline: 0.06}]",
       "robot.cameras.1.name: there is a 'a_right', as its right eye is called"},
      {"robot.cameras=[{name: a, baseline: 0.06, depth: [1, 10]}]",
       "robot.cameras.0.depth: expected 0, 0 of a camera with two eyes (baseline)"},
      {"robot.battery.cells=0", "robot.battery.cells: expected at least one cell"},
  };
  for (const auto& [set, error] : rows) EXPECT_EQ(SetError(set), "--set " + set + ": " + error);
}

TEST_F(ValidateTest, NeedsARobot) {
  EXPECT_EQ(ErrorOf([] { Validate(Config{}); }), "robot.name: expected a name");
  EXPECT_EQ(SetError("robot.motors=[]"),
            "--set robot.motors=[]: robot.motors: expected at least one motor");
  EXPECT_EQ(SetError("robot.imu.site=''"),
            "--set robot.imu.site='': robot.imu.site: expected the name of a site");
}

TEST_F(ValidateTest, RefusesASlotTheFamilyLacks) {
  EXPECT_EQ(SetError("robot.motors.1.slot=20"),
            "--set robot.motors.1.slot=20: robot.motors.1.slot: expected 0 to 19 for this family, "
            "got 20");
  EXPECT_EQ(Load({}, {"robot.family=hg", "robot.motors.1.slot=34"}).robots[0].spec.motors[1].slot,
            34);
}

TEST_F(ValidateTest, RefusesASquatWithoutItsPose) {
  EXPECT_EQ(SetError("robot.motion.humanoid.squat=2"),
            "robot.motion.humanoid.squat_q: expected one angle per motor, 2, as there is a squat, "
            "got 0");
  EXPECT_EQ(SetError("robot.motion.humanoid.sit_q=[1]"),
            "--set robot.motion.humanoid.sit_q=[1]: robot.motion.humanoid.sit_q: expected one "
            "angle per motor, 2, got 1");
}

TEST_F(ValidateTest, AKindNeedsWhatItsControllerCannotDoWithout) {
  EXPECT_THAT(SetError("robot.kind=humanoid"),
              testing::HasSubstr("robot.motion.humanoid.lock_stand: a humanoid needs this state"));
  EXPECT_THAT(
      SetError("robot.kind=quadruped"),
      testing::HasSubstr("robot.motion.quadruped.stand_height: a quadruped needs this height"));
  EXPECT_THAT(FileError("robot: {kind: wheeled, motion: {quadruped: {stand_height: 0.3}}}\n"),
              testing::HasSubstr("robot.motors: a wheeled robot has 16, got 2"));
  EXPECT_THAT(SetError("robot.kind=biped"), testing::HasSubstr("one of other, quadruped, "));
}

TEST_F(ValidateTest, NamesApisThatThereAre) {
  EXPECT_THAT(SetError("robot.apis=[config, sport_g]"),
              testing::HasSubstr("robot.apis.1: no api 'sport_g'; did you mean 'sport_g1'?"));
  EXPECT_EQ(Load({}, {"robot.apis=[]"}).robots[0].spec.apis.size(), 0U);
}

class HandsTest : public ValidateTest {
 protected:
  // The tiny robot as one of the hg family, with what is said of its hands.
  Config Hands(const std::string& hands) const {
    return LoadText("robot: {family: hg, hands: [" + hands + "]}\n");
  }
  std::string HandsError(const std::string& hands) const {
    return ErrorOf([&] { Hands(hands); });
  }
  static std::string Hand(const std::string& topic, const std::string& motors,
                          const std::string& more = "") {
    return "{name: " + topic + ", topic: " + topic + ", motors: [" + motors + "]" + more + "}";
  }
};

constexpr char kThumb[] = "{joint: thumb, torque_limit: 1}";

TEST_F(HandsTest, AreReadWithTheirMotors) {
  const robot::RobotSpec robot = Hands(Hand("left", kThumb, ", timeout: 2")).robots[0].spec;
  ASSERT_EQ(robot.hands.size(), 1U);
  EXPECT_EQ(robot.hands[0].motors.at(0).joint, "thumb");
  EXPECT_EQ(robot.hands[0].timeout, 2);
}

TEST_F(HandsTest, AreNotOfTheGoFamily) {
  EXPECT_THAT(SetError("robot.hands=[" + Hand("left", kThumb) + "]"),
              testing::HasSubstr("robot.hands: the go family has no messages for them"));
}

TEST_F(HandsTest, AreTwoAtMost) {
  EXPECT_THAT(HandsError(Hand("a1", kThumb) + "," + Hand("a2", kThumb) + "," + Hand("a3", kThumb)),
              testing::HasSubstr("robot.hands: expected at most 2, got 3"));
}

TEST_F(HandsTest, HaveMotorsOfTheirOwn) {
  EXPECT_THAT(HandsError(Hand("left", "")),
              testing::HasSubstr("robot.hands.0.motors: expected 1 to 16, got 0"));
  EXPECT_THAT(HandsError(Hand("left", "{joint: a, torque_limit: 1}")),
              testing::HasSubstr("robot.hands.0.motors.0.joint: 'a' has a motor already"));
  EXPECT_THAT(HandsError(Hand("left", "{joint: thumb}")),
              testing::HasSubstr("robot.hands.0.motors.0.torque_limit: expected more than 0 N·m"));
}

TEST_F(HandsTest, HaveTopicsThatDdsTakes) {
  for (const char* topic : {"''", "/left", "left/", "a//b", "a-b", "'a b'"}) {
    EXPECT_THAT(
        HandsError("{name: left, topic: " + std::string(topic) + ", motors: [" + kThumb + "]}"),
        testing::HasSubstr("robot.hands.0.topic: expected words"))
        << topic;
  }
  EXPECT_THAT(
      HandsError(Hand("left", kThumb) + "," + Hand("left", "{joint: index, torque_limit: 1}")),
      testing::HasSubstr("robot.hands.1.topic: another hand has 'left' already"));
}

TEST_F(HandsTest, HaveTaxelsInPlacesThatThereAre) {
  EXPECT_THAT(
      HandsError(Hand("left", kThumb, ", pads: [{taxels: [1.5]}]")),
      testing::HasSubstr(
          "robot.hands.0.pads.0.taxels.0: expected a whole number from 0 to 11, got '1.5'"));
  EXPECT_THAT(HandsError(Hand("left", kThumb, ", pads: [{taxels: [12]}]")),
              testing::HasSubstr("robot.hands.0.pads.0.taxels"));
}

TEST_F(HandsTest, AreToldAtARateThatDividesLowstates) {
  EXPECT_THAT(HandsError(Hand("left", kThumb, ", hz: 300")),
              testing::HasSubstr("robot.hands.0.hz: expected a rate that divides lowstate_hz"));
}

TEST_F(HandsTest, WithTouchHaveAStarInTheirTopicAndARateOfTouch) {
  const auto error = [this](const std::string& topic, const std::string& more) {
    return HandsError("{name: left, topic: " + topic + ", motors: [" + kThumb + "]" + more + "}");
  };
  const std::string law = ", law: inspire_ftp";
  EXPECT_THAT(error("hand/l", law + ", touch: {hz: 1}"),
              testing::HasSubstr("robot.hands.0.topic: expected words of letters, digits and _ "
                                 "between slashes, as in inspire_hand/*/l with its *"));
  EXPECT_THAT(error("hand/*/*", law + ", touch: {hz: 1}"), testing::HasSubstr("0.topic"));
  EXPECT_THAT(error("hand/*/l", ""), testing::HasSubstr("0.topic: expected words"));
  EXPECT_THAT(error("hand/*/l", law),
              testing::HasSubstr("robot.hands.0.touch.hz: expected more than 0 Hz, as the law "
                                 "inspire_ftp has messages of touch"));
  EXPECT_THAT(error("hand", ", touch: {hz: 300}"),
              testing::HasSubstr("robot.hands.0.touch.hz: expected a rate that divides"));
}

TEST_F(HandsTest, HaveRoomInTheirMessages) {
  EXPECT_EQ(HandsError(Hand("left", kThumb, ", slot: 6, slots: 12")), "");
  EXPECT_THAT(HandsError(Hand("left", kThumb, ", slot: 6")),
              testing::HasSubstr("robot.hands.0.slots: expected room for 1 motors from slot 6"));
  EXPECT_EQ(HandsError(Hand("left", kThumb, ", sdk_slot: 3")), "");
  EXPECT_THAT(HandsError(Hand("left", std::string(kThumb) + ", {joint: index, torque_limit: 1}",
                              ", sdk_slot: 3")),
              testing::HasSubstr("robot.hands.0.sdk_slot: expected room for 2 of the 4 motors"));
}

TEST_F(HandsTest, WhoseLawLeadsMotorsHaveTheFiguresForIt) {
  const std::string law = ", law: inspire";
  EXPECT_THAT(HandsError(Hand("left", kThumb, law)),
              testing::HasSubstr("robot.hands.0.motors.0.span: expected two angles, as the law "
                                 "inspire leads it by that"));
  const std::string spanned = "{joint: thumb, torque_limit: 1, span: [1, 0]";
  EXPECT_THAT(HandsError(Hand("left", spanned + "}", law)),
              testing::HasSubstr("robot.hands.0.motors.0.hold_kp: expected more than 0"));
  EXPECT_THAT(HandsError(Hand("left", spanned + ", hold_kp: 1}", law)),
              testing::HasSubstr("robot.hands.0.motors.0.knee_speed: expected more than 0"));
  EXPECT_THAT(HandsError(Hand("left", kThumb, ", law: inspir")), testing::HasSubstr("inspire"));
}

TEST_F(ValidateTest, RefusesAPairOfMotorsThatAreNotThere) {
  EXPECT_EQ(FileError("robot:\n  parallel:\n    - {pitch: 0, roll: 2}\n"),
            "run.yaml:3: robot.parallel.0.roll: expected 0 to 1, as there are 2 motors, got 2");
}

TEST_F(ValidateTest, RefusesAMotorInTwoPairs) {
  EXPECT_EQ(FileError("robot: {parallel: [{pitch: 0, roll: 0}]}\n"),
            "run.yaml:1: robot.parallel.0.roll: motor 0 is in a pair already");
}

TEST_F(ValidateTest, RefusesATimestepThatTheRateDoesNotFit) {
  EXPECT_EQ(SetError("physics.timestep=0.003"),
            "robot.rates.lowstate_hz: expected a rate whose period is a whole number of physics "
            "steps of 0.003 s, got 500");
  EXPECT_EQ(Load({}, {"physics.timestep=0.0005"}).physics.timestep, 0.0005);
}

TEST_F(ValidateTest, RefusesPosesAndNumbersSetByAProgram) {
  Config config = LoadText("");
  config.robots[0].start.pose = "standin";
  EXPECT_EQ(ErrorOf([&] { Validate(config); }),
            "start.pose: no pose 'standin'; did you mean 'standing'? (valid: lying, standing, "
            "hanging, clamped)");
  config = LoadText("");
  config.robots[0].spec.mode_machine = 256;
  EXPECT_EQ(ErrorOf([&] { Validate(config); }), "robot.mode_machine: expected 0 to 255");
  config = LoadText("");
  config.robots[0].network.domain = 233;
  EXPECT_EQ(ErrorOf([&] { Validate(config); }), "network.domain: expected 0 to 232");
}

TEST_F(ValidateTest, AMotionServiceIsOneOfTheFirmwares) {
  EXPECT_THAT(SetError("motion.service=ai"), testing::HasSubstr("has no motion service 'ai'"));
  Load({}, {"motion.service=none", "start.pose=standing"});
  Load({}, {"robot.services=[{name: sport, alias: ai}]", "motion.service=ai"});
  EXPECT_THAT(ErrorOf([&] {
                Load({}, {"robot.services=[{name: sport, alias: ai, since: \"2\"}]",
                          "robot.firmware=\"1\"", "motion.service=ai"});
              }),
              testing::HasSubstr("firmware '1' has no motion service 'ai'"));
}

TEST(ValidateStartTest, AHumanoidDoesNotStandWithNobodyToBalanceIt) {
  for (const std::string& robot : test::Humanoids()) {
    const auto load = [&](const std::string& pose, const std::string& service) {
      LoadConfig({.robot = robot, .sets = {"start.pose=" + pose, "motion.service=" + service}},
                 UNDERSTUDY_SOURCE_DIR);
    };
    EXPECT_THAT(ErrorOf([&] { load("standing", "none"); }),
                testing::HasSubstr("start.pose: a standing humanoid falls while no motion service"))
        << robot;
    load("standing", authority::MotionServices(test::ShippedRobot(robot)).front());
    load("hanging", "none");
    load("clamped", "none");
  }
}

TEST_F(ValidateTest, FirmwareIsNumbersBetweenDots) {
  EXPECT_THAT(SetError("robot.firmware=new"), testing::HasSubstr("expected numbers between dots"));
}

TEST_F(ValidateTest, ArmSdkMovesMotorsThatAreThere) {
  EXPECT_THAT(SetError("robot.arm_sdk.slots=[0, 5]"), testing::HasSubstr("no motor is in slot 5"));
}

TEST_F(ValidateTest, ChordsAreOfKeysThatExist) {
  EXPECT_THAT(SetError("robot.remote.chords=[{keys: L9, does: damp}]"),
              testing::HasSubstr("robot.remote.chords.0.keys: expected keys joined by +"));
}

TEST_F(ValidateTest, FaultsAreOfWhatTheRobotHas) {
  using testing::HasSubstr;
  EXPECT_THAT(SetError("faults=[{component: imv, fault: off}]"),
              HasSubstr("faults.0: the robot has no 'imv'; did you mean 'imu'?"));
  EXPECT_THAT(SetError("faults=[{component: rt/lowstat, fault: off}]"),
              HasSubstr("did you mean 'rt/lowstate'?"));
  EXPECT_THAT(SetError("faults=[{component: fan.front, fault: off}]"),
              HasSubstr("faults.0: the robot has no 'fan.front'"));
  EXPECT_THAT(SetError("faults=[{component: battery, fault: limp}]"),
              HasSubstr("faults.0: 'limp' is no fault of a battery; valid: weak, empty"));
  EXPECT_THAT(SetError("faults=[{component: a, fault: week}]"), HasSubstr("did you mean 'weak'?"));
  EXPECT_THAT(SetError("faults=[{component: a, fault: weak, by: 2}]"),
              HasSubstr("faults.0: by: expected 0 to 1 for 'weak', found 2"));
  EXPECT_THAT(SetError("faults=[{component: a, fault: weak, at: -1}]"),
              HasSubstr("faults.0.at: expected a number from 0 to 1000000 s"));
  EXPECT_THAT(SetError("faults=[{component: a, fault: weak, probabilty: 1}]"),
              HasSubstr("unknown; did you mean 'probability'?"));
}

TEST_F(ValidateTest, FaultsThatTheRobotCanHaveAreTaken) {
  EXPECT_EQ(
      SetError("faults=[{component: rt/lf/lowstate, fault: delayed}, {component: mcu, "
               "fault: off}, {component: service.config, fault: slow, by: 2, at: 3, for: 1}]"),
      "");
}

TEST_F(ValidateTest, BusesHaveNamesAndMotorsOfTheirOwn) {
  EXPECT_THAT(SetError("robot.buses=[{name: x}, {name: x}]"),
              testing::HasSubstr("robot.buses.1.name: expected a name of its own"));
  EXPECT_THAT(SetError("robot.buses=[{name: x, slots: [0]}, {name: y, slots: [1, 0]}]"),
              testing::HasSubstr("robot.buses.1.slots: slot 0 is on a bus already"));
  EXPECT_THAT(SetError("robot.buses=[{name: x, delay: [0.02, 0.01]}]"),
              testing::HasSubstr("robot.buses.0.delay: expected least before most"));
}

TEST_F(ValidateTest, AClampHasItsLeastBeforeItsMost) {
  EXPECT_THAT(SetError("robot.motors.1.q_clamp=[0.2, -0.2]"),
              testing::HasSubstr("robot.motors.1.q_clamp: expected least before most"));
  EXPECT_EQ(SetError("robot.motors.1.q_clamp=[-0.2, 0.2]"), "");
}

TEST_F(ValidateTest, FansHaveNamesAndPlacesOfTheirOwn) {
  EXPECT_THAT(SetError("robot.fans=[{name: x}, {name: y}]"),
              testing::HasSubstr("robot.fans.1.place: place 0 has a fan already"));
  EXPECT_THAT(SetError("robot.fans=[{name: x}, {name: x, place: 1}]"),
              testing::HasSubstr("robot.fans.1.name: expected a name of its own"));
}

}  // namespace
}  // namespace understudy::config
