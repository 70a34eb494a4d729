// robot.hand_make: which hands a robot bears, and on which side.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "config_fixture.h"
#include "robot/hand_law.h"
#include "tests/support/temporary_folder.h"

namespace understudy::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Config With(const std::string& make, const std::string& robot = "g1") {
  return LoadConfig({.robot = robot, .sets = {"robot.hand_make=" + make}},
                    std::filesystem::path(UNDERSTUDY_SOURCE_DIR));
}

std::vector<std::string> Topics(const std::string& make) {
  std::vector<std::string> topics;
  const Config config = With(make);
  for (const robot::HandSpec& hand : config.robots[0].spec.hands) topics.push_back(hand.topic);
  return topics;
}

std::string Refusal(const std::string& make, const std::string& robot = "g1") {
  try {
    With(make, robot);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(HandChoiceTest, ANameIsOfBothSidesAndNoneOfNeither) {
  EXPECT_THAT(Topics("dex1"), ElementsAre("dex1/left", "dex1/right"));
  EXPECT_THAT(Topics("brainco"), ElementsAre("brainco/left", "brainco/right"));
  EXPECT_THAT(Topics("none"), ElementsAre());
  EXPECT_TRUE(With("none", "g1_29dof_dex3").robots[0].spec.hands.empty());
}

TEST(HandChoiceTest, ASideBearsAHandAloneOrEachSideAnother) {
  EXPECT_THAT(Topics("left:dex1"), ElementsAre("dex1/left"));
  EXPECT_THAT(Topics("right:dex3"), ElementsAre("dex3/right"));
  EXPECT_THAT(Topics("left:dex1,right:brainco"), ElementsAre("dex1/left", "brainco/right"));
  EXPECT_THAT(Topics("left:none,right:dex1"), ElementsAre("dex1/right"));
}

TEST(HandChoiceTest, HandsThatShareMessagesKeepTheirSlots) {
  const robot::HandSpec both = With("inspire").robots[0].spec.hands.at(0);
  EXPECT_EQ(both.motors.size(), 12U);
  EXPECT_EQ(both.slots, 0);
  const robot::HandSpec left = With("left:inspire").robots[0].spec.hands.at(0);
  ASSERT_EQ(left.motors.size(), 6U);
  EXPECT_EQ(left.motors[0].joint, "left_inspire_pinky_proximal_joint");
  EXPECT_EQ(left.slot, 6);
  EXPECT_EQ(left.slots, 12);
  EXPECT_THAT(left.models, ElementsAre("g1/hands/left_inspire.xml"));
  const robot::HandSpec right = With("right:inspire").robots[0].spec.hands.at(0);
  EXPECT_EQ(right.slot, 0);
  EXPECT_EQ(right.slots, 12);
}

TEST(HandChoiceTest, AnFtpHandHasThePadsOfItsSideInTheOrderOfTheFields) {
  for (const std::string side : {"left", "right"}) {
    const robot::HandSpec hand = With(side + ":inspire_ftp").robots[0].spec.hands.at(0);
    EXPECT_EQ(hand.motors.at(5).joint, side + "_thumb_1_joint");
    ASSERT_EQ(hand.pads.size(), 17U);
    EXPECT_EQ(hand.pads[0].site, side + "_little_tip_touch");
    EXPECT_EQ(hand.pads[15].site, side + "_thumb_palm_touch");
    EXPECT_EQ(robot::CellsOf(hand), 1062U);
    EXPECT_EQ(robot::HandTopic(hand, "touch"), "rt/inspire_hand/touch/" + side.substr(0, 1));
  }
}

TEST(HandChoiceTest, OldGrippersAreTheSamePairInOneMessageRightBeforeLeft) {
  const robot::HandSpec old = With("dex1_old").robots[0].spec.hands.at(0);
  EXPECT_EQ(old.topic, "unitree_actuator");
  EXPECT_EQ(old.hz, 200);
  ASSERT_EQ(old.motors.size(), 2U);
  EXPECT_EQ(old.motors[0].joint, "right_dex1_motor_joint");
  EXPECT_EQ(old.motors[1].joint, "left_dex1_motor_joint");
  const robot::HandSpec now = With("dex1").robots[0].spec.hands.at(0);
  EXPECT_EQ(old.motors[1].torque_limit, now.motors[0].torque_limit);
  EXPECT_EQ(old.motors[1].lock_kd, now.motors[0].lock_kd);
  EXPECT_EQ(old.motors[1].q_step, now.motors[0].q_step);
  EXPECT_EQ(old.timeout, now.timeout);
  EXPECT_EQ(With("left:dex1_old").robots[0].spec.hands.at(0).slot, 1);
}

TEST(HandChoiceTest, ModelsAreThoseBesideTheRobotsWhereItHasThem) {
  const auto models = [](const std::string& robot) {
    return With("inspire", robot).robots[0].spec.hands.at(0).models;
  };
  EXPECT_THAT(models("h1_2"),
              ElementsAre("h1_2/hands/right_inspire.xml", "h1_2/hands/left_inspire.xml"));
  EXPECT_THAT(models("g1"), ElementsAre("g1/hands/right_inspire.xml", "g1/hands/left_inspire.xml"));
}

TEST(HandChoiceTest, ModelsAreThoseOfTheRobotThatItExtendsWhereItHasNoneOfItsOwn) {
  const test::TemporaryFolder folder;
  folder.Write("mine.xml", "<mujoco/>");
  const std::string robot = folder.Write("mine.yaml",
                                         "extends: h1_2\n"
                                         "robot: {name: mine, model: mine.xml}\n");
  const auto models = [&] { return With("inspire", robot).robots[0].spec.hands.at(0).models; };
  EXPECT_THAT(models(), ElementsAre("h1_2/hands/right_inspire.xml", "h1_2/hands/left_inspire.xml"));
  const std::string own = folder.Write("hands/left_inspire.xml", "<mujoco/>");
  EXPECT_THAT(models(), ElementsAre("h1_2/hands/right_inspire.xml", own));
}

TEST(HandChoiceTest, RefusesByName) {
  EXPECT_EQ(
      Refusal("inspir"),
      "--set robot.hand_make=inspir: robot.hand_make: no hands 'inspir' for this robot; did "
      "you mean 'inspire'? (valid: brainco, dex1, dex1_old, dex3, inspire, inspire_ftp, none)");
  EXPECT_EQ(Refusal("dex1", "go2"),
            "--set robot.hand_make=dex1: robot.hand_make: this robot bears no hands, so not 'dex1' "
            "either; g1 bears them: understudy run g1 --hands dex1");
  EXPECT_THAT(Refusal("dex1", "g1_23dof"), HasSubstr("this robot bears no hands"));
  EXPECT_THAT(Refusal("dex1", "h1_2"), HasSubstr("no hands 'dex1' for this robot"));
  for (const char* wrong : {"up:dex1", "dex1,dex3", "left:dex1,dex3", "left:dex1,"}) {
    EXPECT_THAT(Refusal(wrong), HasSubstr("expected left:NAME or right:NAME")) << wrong;
  }
  EXPECT_THAT(Refusal("left:dex1,left:dex3"), HasSubstr("two hands for the left side"));
}

TEST(HandChoiceTest, ALayerChangesTheChosenHands) {
  const Config config =
      LoadConfig({.robot = "g1", .sets = {"robot.hand_make=dex1", "robot.hands.0.timeout=3"}},
                 std::filesystem::path(UNDERSTUDY_SOURCE_DIR));
  EXPECT_EQ(config.robots[0].spec.hands.at(0).timeout, 3);
}

}  // namespace
}  // namespace understudy::config
