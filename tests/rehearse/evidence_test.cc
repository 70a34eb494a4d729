#include "rehearse/evidence.h"

#include "tests/rehearse/rehearse_fixture.h"

namespace understudy::rehearse {
namespace {

using testing::HasSubstr;

// Judges one expectation in YAML by what `play` tells.
judge::Verdict VerdictOf(const std::string& expectation, const std::function<void(Stage*)>& play) {
  const Expectations expect = ReadExpect("- " + expectation);
  Jury jury(expect);
  Stage stage(jury.Hearing(0));
  play(&stage);
  jury.Finish();
  return jury.verdicts().front();
}
double ValueOf(const std::string& condition, const std::function<void(Stage*)>& play) {
  return VerdictOf("{final: " + condition + "}", play).worth.value;
}
constexpr auto kLean = [](Stage* stage) { stage->Truth(0, 0.3, 0.5); };

TEST(EvidenceTest, ReadsTheTruth) {
  EXPECT_EQ(ValueOf("base.x > 0", kLean), 1);
  EXPECT_EQ(ValueOf("base.y > 0", kLean), 2);
  EXPECT_EQ(ValueOf("base.height > 0", kLean), 0.3);
  EXPECT_NEAR(ValueOf("base.roll > 0", kLean), 0.5, 1e-12);
  EXPECT_NEAR(ValueOf("base.tilt > 0", kLean), 0.5, 1e-12);
  EXPECT_NEAR(ValueOf("base.tilt > 0 deg", kLean), 0.5 * 57.29577951308232, 1e-9);
  EXPECT_EQ(ValueOf("base.speed > 0", kLean), 5);
  EXPECT_EQ(ValueOf("base.forward > 0", kLean), 3);
  EXPECT_EQ(ValueOf("base.left > 0", kLean), 4);
  EXPECT_EQ(ValueOf("torque(knee) > 0", kLean), -20);
  EXPECT_EQ(ValueOf("foot_force(right) > 0", kLean), 70);
  EXPECT_EQ(ValueOf("feet.force > 0", kLean), 120);
  EXPECT_EQ(ValueOf("hand_force(right) > 0", kLean), 7);
  EXPECT_EQ(ValueOf("touch(right_tip) > 0", kLean), 0.5);
}

TEST(EvidenceTest, ReadsWhereObjectsAre) {
  const auto play = [](Stage* stage) { stage->Object(0, "cube", {4, 5, 6}, 0.5); };
  EXPECT_EQ(ValueOf("object.x(cube) > 0", play), 4);
  EXPECT_EQ(ValueOf("object.y(cube) > 0", play), 5);
  EXPECT_EQ(ValueOf("object.height(cube) > 0", play), 6);
  EXPECT_EQ(ValueOf("object.height(cube) > 0 cm", play), 600);
  EXPECT_NEAR(ValueOf("object.tilt(cube) > 0", play), 0.5, 1e-12);
  EXPECT_EQ(ValueOf("object.speed(cube) > 0", play), 7);
}

TEST(EvidenceTest, DoesNotKnowAnObjectThatARecordingHasNot) {
  const judge::Verdict verdict = VerdictOf("{final: object.height(cup) > 0}", [](Stage* stage) {
    stage->Object(0, "cube", {4, 5, 6});
  });
  EXPECT_EQ(verdict.outcome, judge::Outcome::kNotJudged);
  const judge::Verdict old =
      VerdictOf("{final: object.height(cube) > 0}", [](Stage* stage) { stage->Truth(0, 1); });
  EXPECT_EQ(old.outcome, judge::Outcome::kNotJudged);
}

TEST(EvidenceTest, BelievesNoAddressBeyondTheTruth) {
  const judge::Verdict verdict = VerdictOf("{final: object.height(cube) > 0}", [](Stage* stage) {
    stage->Object(0, "cube", {4, 5, 6}, 0, 2);
  });
  EXPECT_EQ(verdict.outcome, judge::Outcome::kNotJudged);
}

TEST(EvidenceTest, KeepsWhatAnEventSaidAndTellsWhenItHappens) {
  const auto play = [](Stage* stage) {
    stage->Truth(0, 0.3);
    stage->Event(1, "gate", R"({"state": "damping"})");
    stage->Truth(2, 0.3);
  };
  using enum judge::Outcome;
  EXPECT_EQ(VerdictOf("{final: gate is damping}", play).outcome, kPassed);
  EXPECT_EQ(VerdictOf("{always: gate is damping, to: 0.5}", play).outcome, kFailed);
  EXPECT_EQ(VerdictOf("{always: gate is damping, from: gate happens}", play).outcome, kPassed);
  EXPECT_EQ(VerdictOf("{count: gate happens, least: 1, most: 1}", play).outcome, kPassed);
  EXPECT_EQ(VerdictOf("{never: gate happens, from: 1.5}", play).outcome, kPassed);
}

TEST(EvidenceTest, TellsAtWhichInstantTheProgramPrintsAText) {
  const auto play = [](Stage* stage) {
    stage->Event(0, "program_prints", R"({"text": "walk", "count": 1})");
    stage->Event(1, "program_prints", R"({"text": "ready", "count": 1})");
    stage->Event(2, "program_prints", R"({"text": "walk", "count": 1})");
  };
  using enum judge::Outcome;
  EXPECT_EQ(VerdictOf(R"({count: the program prints "walk", least: 2, most: 2})", play).outcome,
            kPassed);
  EXPECT_EQ(VerdictOf(R"({never: the program prints "walk", from: 0.5, to: 1.5})", play).outcome,
            kPassed);
  EXPECT_EQ(VerdictOf(R"({eventually: the program prints "ready", to: 0.5})", play).outcome,
            kFailed);
}

TEST(EvidenceTest, CountsABurstOfEventsAsManyTimesAsItHappened) {
  const auto play = [](Stage* stage) {
    stage->Event(0, "refused", R"({"reason": "crc", "count": 1})");
    stage->Event(1, "refused", R"({"reason": "crc", "count": 40})");
  };
  EXPECT_EQ(ValueOf("refusals > 0", play), 41);
  EXPECT_EQ(VerdictOf("{count: refused happens, least: 41, most: 41}", play).worth.margin, 0);
}

TEST(EvidenceTest, MeasuresGapsAlsoWhileNothingComes) {
  const auto play = [](Stage* stage) {
    stage->Truth(0, 0.3);
    for (const double at : {1.0, 1.1, 1.5}) stage->Message(at, "lowcmd");
    stage->Truth(3, 0.3);
  };
  const judge::Verdict worst = VerdictOf("{always: gap(lowcmd) < 1}", play);
  EXPECT_NEAR(worst.worth.value, 1.5, 1e-9);
  const judge::Verdict early = VerdictOf("{always: gap(lowcmd) < 1, to: 1.5}", play);
  EXPECT_NEAR(early.worth.value, 0.4, 1e-9);
  EXPECT_EQ(VerdictOf("{count: lowcmd arrives, least: 3, most: 3}", play).worth.margin, 0);
}

TEST(EvidenceTest, CountsTheMessagesOfTheLastSecond) {
  const auto play = [](Stage* stage) {
    stage->Truth(0, 0.3);
    for (int i = 0; i < 30; ++i) stage->Message(1 + 0.05 * i, "lowcmd");
    stage->Truth(2.95, 0.3);
    stage->Truth(4, 0.3);
  };
  EXPECT_EQ(ValueOf("rate(lowcmd) >= 0", play), 0);
  EXPECT_EQ(VerdictOf("{always: rate(lowcmd) >= 15, to: 2.4}", play).worth.value, 20);
  EXPECT_EQ(VerdictOf("{always: rate(lowcmd) >= 15, to: 3}", play).worth.value, 10);
  // Before that there has been no second of them.
  EXPECT_EQ(VerdictOf("{always: rate(lowcmd) >= 15, to: 1.9}", play).outcome,
            judge::Outcome::kNotJudged);
}

TEST(EvidenceTest, ARealRobotsFirstJumpIsThatOfTheFirstCommandThatAsksForAnAngle) {
  const auto play = [](Stage* stage) {
    stage->Command(0, 9, 9, 40);  // nobody has said yet where the joints are
    stage->State(0.1, 0.5F, -1);
    stage->Command(0.2, 7, 7, 0);  // asks for no angle
    stage->State(0.3, 0.75F, -1);
    stage->Command(0.4, 1, -1.5F, 40);
    stage->Command(0.5, 8, 8, 40);
  };
  const judge::Verdict verdict = VerdictOf("{always: first_jump < 0.2}", play);
  EXPECT_EQ(verdict.outcome, judge::Outcome::kFailed);
  EXPECT_EQ(verdict.worth.value, 0.5);
  EXPECT_EQ(verdict.worth.at, 400'000'000);
}

TEST(EvidenceTest, ASimulatedRobotSaysItselfByWhichCommandItsFirstJumpWas) {
  const auto play = [](Stage* stage) {
    stage->Truth(0, 0.3);
    stage->State(0.1, 0.5F, -1);
    stage->Command(0.2, 5, 5, 40);  // refused
    stage->Event(0.3, "first_command", R"({"jump": 0.125, "joint": "knee_joint"})");
    stage->Truth(1, 0.3);
  };
  EXPECT_EQ(ValueOf("first_jump > 0", play), 0.125);
}

TEST(EvidenceTest, AFirstJumpOfNoCommandIsNotJudged) {
  const auto play = [](Stage* stage) { stage->State(0.1, 0, 0); };
  EXPECT_EQ(VerdictOf("{always: first_jump < 0.2}", play).outcome, judge::Outcome::kNotJudged);
}

TEST(EvidenceTest, MeasuresTorquesByTheirLimitsAndReadsTemperatures) {
  const auto play = [](Stage* stage) {
    stage->Truth(0, 0.3);
    stage->Go(0.1, "lowstate", "unitree_go/msg/LowState",
              {{"motor_state[0].tau_est", -5}, {"motor_state[1].temperature", 71}});
  };
  EXPECT_EQ(ValueOf("torque_share(knee) > 0", play), 0.5);
  EXPECT_EQ(ValueOf("tau_est_share(hip) > 0", play), 0.25);
  EXPECT_EQ(ValueOf("temperature(knee) > 0", play), 71);
}

TEST(EvidenceTest, DoesNotJudgeByATruthThatARecordingDoesNotHave) {
  const Expectations expect = ReadExpect("[{always: base.height > 0.2}, {never: lowcmd arrives}]");
  Jury jury(expect);
  Stage(jury.Hearing(0)).Message(1, "lowstate");
  jury.Finish();
  EXPECT_EQ(jury.verdicts()[0].outcome, judge::Outcome::kNotJudged);
  EXPECT_THAT(jury.WhyNot(0), HasSubstr("base.height is the simulation's truth"));
  EXPECT_EQ(jury.verdicts()[1].outcome, judge::Outcome::kPassed);
}

TEST(EvidenceTest, DoesNotJudgeByObstaclesThatWereNotMeasured) {
  const Expectations expect = ReadExpect("[{always: nearest_obstacle > 0.2}]");
  Jury jury(expect);
  Stage(jury.Hearing(0)).Truth(1, 0.3);
  jury.Finish();
  EXPECT_EQ(jury.verdicts()[0].outcome, judge::Outcome::kNotJudged);
  EXPECT_THAT(jury.WhyNot(0), HasSubstr("nearest_obstacle was not asked for"));
}

TEST(EvidenceTest, DoesNotJudgeByHandsThatAnOlderRecordingLacks) {
  const Expectations expect = ReadExpect("[{always: hand_force(left) > 0}]");
  Jury jury(expect);
  Stage stage(jury.Hearing(0));
  stage.Joints(1, std::vector<double>(8), {0, 2});
  jury.Finish();
  EXPECT_EQ(jury.verdicts()[0].outcome, judge::Outcome::kNotJudged);
  EXPECT_THAT(jury.WhyNot(0), HasSubstr("hand_force(left) is not in this recording"));
}

TEST(EvidenceTest, DoesNotJudgeByPadsThatAnOlderRecordingLacks) {
  const Expectations expect = ReadExpect("[{always: touch(left_tip) > 0}]");
  Jury jury(expect);
  Stage stage(jury.Hearing(0));
  stage.Joints(1, std::vector<double>(8), {0, 2});
  jury.Finish();
  EXPECT_EQ(jury.verdicts()[0].outcome, judge::Outcome::kNotJudged);
  EXPECT_THAT(jury.WhyNot(0), HasSubstr("touch(left_tip) is not in this recording"));
}

TEST(EvidenceTest, DoesNotJudgeByTheBaseOfARobotWhoseBaseIsFixed) {
  const Expectations expect =
      ReadExpect("[{always: base.height > -1}, {always: torque(knee) > 1}]");
  Jury jury(expect);
  Stage stage(jury.Hearing(0));
  stage.Joints(1, std::vector<double>(8), {0, 2});
  jury.Finish();
  EXPECT_EQ(jury.verdicts()[0].outcome, judge::Outcome::kNotJudged);
  EXPECT_THAT(jury.WhyNot(0), HasSubstr("base.height is of a base that moves"));
  EXPECT_EQ(jury.verdicts()[1].outcome, judge::Outcome::kPassed);
}

TEST(EvidenceTest, DoesNotJudgeByEventsThatARecordingDoesNotHave) {
  const Expectations expect = ReadExpect("[{never: refused happens}]");
  Jury jury(expect);
  Stage(jury.Hearing(0)).Message(1, "lowstate");
  jury.Finish();
  EXPECT_EQ(jury.verdicts()[0].outcome, judge::Outcome::kNotJudged);
  EXPECT_THAT(jury.WhyNot(0), HasSubstr("comes from events"));
}

TEST(EvidenceTest, JudgesNothingByNoMessages) {
  const Expectations expect = ReadExpect("[{never: lowcmd arrives}]");
  Jury jury(expect);
  jury.Finish();
  EXPECT_EQ(jury.verdicts()[0].outcome, judge::Outcome::kNotJudged);
}

}  // namespace
}  // namespace understudy::rehearse
