#include "signals/bound_condition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/load.h"

namespace understudy::signals {
namespace {

// Of a running robot with two joints.
Names TinyNames() {
  return {.joints = {"hip_joint", "knee_joint", "finger_joint"},
          .slots = {3, 4},
          .torque_limits = {20, 40, 1},
          .feet = {"left", "right"},
          .topics = {{"rt/lowcmd", ""}, {"rt/arm_sdk", ""}}};
}

std::string WhyNot(const std::string& text, const Names& names = TinyNames()) {
  std::vector<Signal> signals;
  return BindCondition(text, names, &signals).why();
}

TEST(BoundConditionTest, SharesASignalBetweenComparisons) {
  std::vector<Signal> signals;
  const auto bound = BindCondition(
      "base.height > 0.3 and not (base.height > 50 cm or lowcmd arrives)", TinyNames(), &signals);
  ASSERT_TRUE(bound) << bound.why();
  ASSERT_EQ(signals.size(), 2U);
  EXPECT_EQ(signals[0].source, Signal::Source::kTruth);
  EXPECT_EQ(signals[1].topic, "rt/lowcmd");
  ASSERT_EQ(bound->leaves.size(), 3U);
  EXPECT_EQ(bound->leaves[1].unit, "cm");
  EXPECT_EQ(bound->leaves[1].signal, 0U);
}

TEST(BoundConditionTest, ARunningRobotKnowsTheCommandsItHearsAndWhatItSamples) {
  EXPECT_EQ(WhyNot("lowcmd arrives"), "");
  EXPECT_EQ(WhyNot("gap(arm_sdk) > 0.1"), "");
  EXPECT_EQ(WhyNot("q(knee) > 0.1 and dq(hip) < 1 and tau_est(hip) < 1"), "");
  EXPECT_EQ(WhyNot("lowstate arrives"),
            "no topic of commands 'rt/lowstate'; did you mean 'rt/lowcmd'? "
            "(valid: rt/arm_sdk, rt/lowcmd)");
  EXPECT_THAT(WhyNot("rt/mine arrives"), testing::HasSubstr("no topic of commands 'rt/mine'"));
  EXPECT_THAT(WhyNot("lowstate:tick > 5"),
              testing::HasSubstr("q, dq, tau_est and temperature of a joint"));
  EXPECT_EQ(WhyNot("q(finger) > 1"), "rt/lowstate does not have finger_joint");
}

TEST(BoundConditionTest, TorquesCanBeMeasuredByTheirLimitsAndTemperaturesByTheFamily) {
  std::vector<Signal> signals;
  Names names = TinyNames();
  ASSERT_TRUE(
      BindCondition("torque_share(knee) < 0.9 and tau_est_share(hip) < 0.9", names, &signals));
  EXPECT_EQ(signals[0].Told(-30), 0.75);
  EXPECT_EQ(signals[1].Told(5), 0.25);
  EXPECT_EQ(signals[1].field, "motor_state[3].tau_est");
  ASSERT_TRUE(BindCondition("temperature(knee) < 60 °C", names, &signals));
  names.hg = true;
  ASSERT_TRUE(BindCondition("temperature(hip) < 60", names, &signals));
  EXPECT_EQ(signals[2].field, "motor_state[4].temperature");
  EXPECT_EQ(signals[3].field, "motor_state[3].temperature[1]");
  robot::RobotState sample;
  sample.motors = {{.casing_c = 50.4, .winding_c = 40.6}, {.casing_c = 30, .winding_c = 40.6}};
  EXPECT_EQ(signals[2].of_sample(sample, 0), 50);
  EXPECT_EQ(signals[3].of_sample(sample, 0), 41);
}

TEST(BoundConditionTest, KnowsTheObjectsOfTheScene) {
  Names names = TinyNames();
  EXPECT_EQ(WhyNot("object.height(cube) > 1", names),
            "no object 'cube'; `objects` has none that moves");
  names.objects = {"cube", "cup"};
  EXPECT_EQ(WhyNot("object.height(cube) > 80 cm and object.tilt(cup) < 5 deg", names), "");
  EXPECT_EQ(WhyNot("object.x(cub) > 1", names),
            "no object 'cub'; did you mean 'cube'? (valid: cube, cup)");
  EXPECT_EQ(WhyNot("object.speed(anything) > 1", RunningNames()), "");
}

TEST(BoundConditionTest, NamesTheNearestWord) {
  EXPECT_EQ(WhyNot("base.hight > 1"), "no signal 'base.hight'; did you mean 'base.height'?");
  EXPECT_THAT(WhyNot("q(kne) > 1"), testing::HasSubstr("did you mean 'knee'?"));
  EXPECT_THAT(WhyNot("refusd happens"), testing::HasSubstr("did you mean 'refused'?"));
  EXPECT_THAT(WhyNot("base.height < 3 kg"), testing::HasSubstr("base.height: no unit 'kg'"));
}

TEST(BoundConditionTest, SaysThatARobotHasNoHands) {
  EXPECT_THAT(WhyNot("hand_force(left) > 1"),
              testing::HasSubstr("no hand 'left': this robot has none"));
}

TEST(BoundConditionTest, ARobotHasTwoHandsAlsoWhereTheyShareMessages) {
  for (const std::string make : {"inspire", "dex1", "inspire_ftp"}) {
    const Names names =
        RunningNames(config::LoadConfig({.robot = "g1", .sets = {"robot.hand_make=" + make}},
                                        UNDERSTUDY_SOURCE_DIR)
                         .robots[0]
                         .spec);
    EXPECT_THAT(names.hands, testing::ElementsAre("left", "right")) << make;
  }
}

TEST(BoundConditionTest, PadsHaveTheNamesOfTheirSites) {
  const auto why_not = [](const std::string& make, const std::string& text) {
    return WhyNot(
        text, RunningNames(config::LoadConfig({.robot = "g1", .sets = {"robot.hand_make=" + make}},
                                              UNDERSTUDY_SOURCE_DIR)
                               .robots[0]
                               .spec));
  };
  EXPECT_EQ(why_not("inspire_ftp", "touch(left_index_tip) > 1 and touch(right_palm) > 1"), "");
  EXPECT_EQ(why_not("dex3", "touch(left_hand_palm_2) > 1"), "");
  EXPECT_THAT(why_not("inspire_ftp", "touch(left_indx_tip) > 1"),
              testing::HasSubstr("no pad of a hand 'left_indx_tip'; did you mean"));
  EXPECT_THAT(why_not("brainco", "touch(left_index_tip) > 1"),
              testing::HasSubstr("no pad of a hand 'left_index_tip': this robot has none"));
}

TEST(BoundConditionTest, ForAnyRobotEachJointFootAndHandWillDoAndNoTopicThatNoneHears) {
  EXPECT_EQ(WhyNot("q(tail) > 1 and foot_force(paw) > 1 and hand_force(claw) > 1 and "
                   "touch(nail) > 1",
                   RunningNames()),
            "");
  EXPECT_EQ(WhyNot("dex3/left/cmd arrives", RunningNames()), "");
  EXPECT_THAT(WhyNot("lowcmt arrives", RunningNames()), testing::HasSubstr("'rt/lowcmd'"));
}

TEST(BoundConditionTest, ForAnyRobotTheOthersMayHaveAnyName) {
  EXPECT_EQ(WhyNot("tall:feet.force > 250 and left:lowcmd arrives", RunningNames()), "");
  EXPECT_THAT(WhyNot("tall:feet.forc > 250", RunningNames()),
              testing::HasSubstr("did you mean 'feet.force'?"));
}

TEST(BoundConditionTest, ARecordingHasTheTopicsOfItsRobotWithTheirTypes) {
  const auto recorded = [](const char* robot) {
    return RecordedNames(
        config::LoadConfig({.robot = robot}, UNDERSTUDY_SOURCE_DIR).robots[0].spec,
        [](const std::string& type, const std::string& field) { return type + " " + field; });
  };
  EXPECT_EQ(WhyNot("gap(errorlist) > 1 and gap(lf/sportmodestate) > 1", recorded("go2")), "");
  EXPECT_THAT(WhyNot("gap(lf/bmsstate) > 1", recorded("go2")), testing::HasSubstr("no topic"));
  const Names hands = recorded("g1_29dof_dex3");
  EXPECT_EQ(WhyNot("gap(lf/bmsstate) > 1 and gap(lf/dex3/left/state) > 1", hands), "");
  EXPECT_EQ(WhyNot("dex3/right/cmd:motor_cmd[0].q > 1", hands),
            "unitree_hg::msg::dds_::HandCmd_ motor_cmd[0].q");
}

TEST(BoundConditionTest, AProgramPrintsOnlyWhereThereIsOne) {
  Names names = TinyNames();
  EXPECT_EQ(WhyNot("the program prints \"ready\"", names), "");
  names.program = false;
  EXPECT_THAT(WhyNot("the program prints \"ready\"", names), testing::HasSubstr("no program"));
}

TEST(BoundConditionTest, TheTextsToLookForAreListedOnce) {
  std::vector<Signal> signals;
  for (const char* text :
       {"the program prints \"a b\" or the program prints \"c\"", "the program prints \"a b\""}) {
    ASSERT_TRUE(BindCondition(text, TinyNames(), &signals));
  }
  EXPECT_EQ(PrintedTexts(signals), (std::vector<std::string>{"a b", "c"}));
}

}  // namespace
}  // namespace understudy::signals
