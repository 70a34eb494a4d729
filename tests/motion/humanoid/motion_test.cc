// Tests the state machine of a G1 in simulation, and its arm actions.

#include "motion/humanoid/motion.h"

#include <cmath>

#include "tests/motion/humanoid/fixture.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

constexpr auto kIgnored = authority::MotionVerdict::kIgnored;

class HumanoidMotionTest : public test::MujocoTest {
 protected:
  void Balance() {
    rig_.Start("standing");
    rig_.Run(1);
    ASSERT_EQ(rig_.SetFsm(501), Verdict::kTaken);
    rig_.Run(0.5);
  }
  robot::MotionState state() const { return rig_.state(); }
  authority::MotionVerdict Act(int id) { return rig_.Ask(goal::ArmAction{id}); }

  HumanoidRig rig_{"g1"};
};

TEST_F(HumanoidMotionTest, ComesUpLimp) {
  rig_.Start("hanging");
  EXPECT_EQ(rig_.state().id, 0);
  rig_.Run(0.1);
  for (const robot::MotorCommand& m : rig_.command().motors) {
    EXPECT_TRUE(m.enabled);
    EXPECT_EQ(std::abs(m.tau) + m.kp + m.kd, 0);
  }
}

TEST_F(HumanoidMotionTest, HoldsARobotItFindsStanding) {
  rig_.Start("standing");
  EXPECT_EQ(rig_.state().id, 4);
  rig_.Run(5);
  EXPECT_EQ(rig_.state().id, 4);
  EXPECT_TRUE(rig_.standing());
}

TEST_F(HumanoidMotionTest, BrakesInDamping) {
  rig_.Start("hanging");
  rig_.SetFsm(1);
  rig_.Run(0.05);
  for (const robot::MotorCommand& m : rig_.command().motors) {
    EXPECT_EQ(m.kp, 0);
    EXPECT_EQ(m.tau, 0);
    EXPECT_GT(m.kd, 0);
  }
}

TEST_F(HumanoidMotionTest, ReachesLockStandInTheAirWithinFiveSecondsCalmly) {
  rig_.Start("hanging");
  rig_.SetFsm(1);
  ASSERT_EQ(rig_.SetFsm(4), Verdict::kTaken);
  double fastest = 0;
  rig_.watch = [&] { fastest = std::max(fastest, rig_.fastest()); };
  rig_.Run(1);
  EXPECT_EQ(state().mode, 1);
  EXPECT_EQ(state().progress, 1);
  EXPECT_EQ(rig_.SetFsm(501), Verdict::kNotNow);
  rig_.Run(4);
  EXPECT_EQ(state().mode, 2) << "its feet carry nothing";
  EXPECT_LT(fastest, 0.7);
  for (std::size_t i = 0; i < rig_.spec().motors.size(); ++i) {
    EXPECT_NEAR(rig_.world().robot().q()[i], rig_.spec().standing.q[i], 0.02) << i;
  }
  fastest = 0;
  rig_.Run(1);
  EXPECT_LT(fastest, 0.05);
}

TEST_F(HumanoidMotionTest, SquatsAndRisesWithLockedJoints) {
  rig_.Start("standing");
  rig_.Run(1);
  ASSERT_EQ(rig_.SetFsm(2), Verdict::kTaken);
  rig_.Run(5);
  EXPECT_EQ(state().mode, 0);
  EXPECT_LT(rig_.height(), 0.55);
  EXPECT_LT(rig_.world().robot().tilt(), 0.4);
  ASSERT_EQ(rig_.SetFsm(4), Verdict::kTaken);
  rig_.Run(5);
  EXPECT_TRUE(rig_.standing());
}

TEST_F(HumanoidMotionTest, LocksItsJointsAsOnAChair) {
  rig_.Start("hanging");
  rig_.SetFsm(1);
  ASSERT_EQ(rig_.SetFsm(3), Verdict::kTaken);
  rig_.Run(5);
  EXPECT_EQ(rig_.state().id, 3);
  EXPECT_NEAR(rig_.q("left_hip_pitch_joint"), -1.5, 0.05);
  EXPECT_NEAR(rig_.q("left_knee_joint"), 1.5, 0.05);
}

// docs/dev/sources.md#g1-states: 6 to 7 s on the way.
TEST_F(HumanoidMotionTest, SquatsBalancedAndRisesToWhereItWas) {
  Balance();
  ASSERT_EQ(rig_.SetFsm(706), Verdict::kTaken);
  rig_.Run(1);
  EXPECT_EQ(state().mode, 1);
  EXPECT_EQ(Act(26), Verdict::kNotNow);
  rig_.Run(4.9);
  EXPECT_EQ(rig_.SetFsm(706), Verdict::kNotNow) << "on the way";
  rig_.Run(1.1);
  EXPECT_EQ(rig_.state().id, 706);
  EXPECT_EQ(state().mode, 1) << "706 is never told at rest";
  EXPECT_LT(rig_.height(), 0.55);
  ASSERT_EQ(rig_.SetFsm(706), Verdict::kTaken);
  rig_.Run(5.9);
  EXPECT_EQ(rig_.state().id, 706);
  rig_.Run(1.1);
  EXPECT_EQ(rig_.state().id, 501);
  EXPECT_TRUE(rig_.standing());
}

TEST_F(HumanoidMotionTest, IsDampedNineSecondsAfterItWasToldToSquat) {
  Balance();
  ASSERT_EQ(rig_.SetFsm(706), Verdict::kTaken);
  rig_.Run(8.9);
  EXPECT_EQ(rig_.state().id, 706);
  rig_.Run(0.2);
  EXPECT_EQ(rig_.state().id, 1);
  rig_.Run(3);
  EXPECT_LT(rig_.height(), 0.55) << "stays down";
}

// unitree_g1_vibes and phanthymotus-driver as docs/dev/sources.md has them.
TEST_F(HumanoidMotionTest, TellsThatItsFeetCarryNothingUntilTheCraneHasSetItDown) {
  rig_.Start("hanging");
  EXPECT_EQ(state().mode, 0) << "limp";
  rig_.SetFsm(1);
  rig_.SetFsm(4);
  rig_.Run(5);
  EXPECT_EQ(state().mode, 2);
  rig_.robot().crane().Lower(0.4);
  rig_.Run(4.5);
  EXPECT_EQ(state().mode, 0);
  ASSERT_EQ(rig_.SetFsm(501), Verdict::kTaken);
  rig_.Run(1);
  EXPECT_EQ(state().mode, 0);
}

TEST_F(HumanoidMotionTest, KnowsTheWalkOfItsWaistAndTheOldOne) {
  rig_.Start("standing");
  rig_.Run(1.5);
  EXPECT_EQ(rig_.SetFsm(500), authority::MotionVerdict::kUnknown) << "a free waist's is 501";
  EXPECT_EQ(state().id, 4);
  EXPECT_EQ(rig_.SetFsm(200), Verdict::kTaken);
  EXPECT_EQ(state().id, 200);
  EXPECT_EQ(rig_.SetFsm(501), Verdict::kTaken);
  EXPECT_EQ(state().id, 501);
}

TEST(HumanoidWaistTest, ALockedWaistWalksIn500And801) {
  HumanoidRig rig("g1 6");
  rig.Start("standing");
  rig.Run(1.5);
  EXPECT_EQ(rig.SetFsm(501), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig.SetFsm(802), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig.SetFsm(500), Verdict::kTaken);
  EXPECT_EQ(rig.state().id, 500);
  EXPECT_EQ(rig.SetFsm(801), Verdict::kTaken);
  EXPECT_EQ(rig.state().id, 801);
}

TEST(HumanoidFirmwareTest, BeforeOneFourAG1WalksIn200) {
  HumanoidRig rig(ConfigOf("g1", {"robot.firmware='1.3'"}));
  rig.Start("standing");
  rig.Run(1.5);
  EXPECT_EQ(rig.SetFsm(501), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig.SetFsm(706), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig.Ask(goal::BalanceStand{}), Verdict::kTaken);
  EXPECT_EQ(rig.state().id, 200);
}

// Two R1s: xr_teleoperate issue 319, unitree_sdk2_python issue 168.
TEST(HumanoidArmsTest, AnR1TellsAStateOfItsOwnWhileArmSdkHasAWeight) {
  HumanoidRig rig("r1");
  rig.Start("standing");
  rig.Run(1.5);
  ASSERT_EQ(rig.SetFsm(811), Verdict::kTaken);
  rig.Run(0.5);
  EXPECT_EQ(rig.state().id, 811);
  robot::RobotCommand arms{.motors = std::vector<robot::MotorCommand>(rig.spec().motors.size())};
  rig.port().SendArms(arms, 0.3);
  rig.Run(0.1);
  EXPECT_EQ(rig.state().id, 816);
  rig.port().SendArms(arms, 0);
  rig.Run(0.1);
  EXPECT_EQ(rig.state().id, 811);
}

TEST_F(HumanoidMotionTest, TakesZeroTorqueOnItsFeetAndStaysAsItIs) {
  rig_.Start("standing");
  EXPECT_EQ(rig_.SetFsm(0), kIgnored);
  EXPECT_EQ(rig_.state().id, 4);
  rig_.Run(1);
  rig_.SetFsm(501);
  EXPECT_EQ(rig_.SetFsm(0), kIgnored);
  rig_.Run(1);
  EXPECT_EQ(rig_.state().id, 501);
  EXPECT_TRUE(rig_.standing());
}

TEST_F(HumanoidMotionTest, GoesLimpByWayOfDamping) {
  Balance();
  EXPECT_EQ(rig_.SetFsm(1), Verdict::kTaken);
  EXPECT_EQ(rig_.state().id, 1);
  EXPECT_EQ(rig_.SetFsm(0), Verdict::kTaken);
  EXPECT_EQ(rig_.state().id, 0);
}

TEST_F(HumanoidMotionTest, DampsItsFall) {
  Balance();
  rig_.Push({600, 0, 0}, 0.1);
  rig_.Run(2);
  EXPECT_EQ(rig_.state().id, 1);
}

TEST_F(HumanoidMotionTest, ListensToTheGoalsOfARemote) {
  rig_.Start("hanging");
  EXPECT_EQ(rig_.Ask(goal::StandUp{}), Verdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::Damp{}), Verdict::kTaken);
  EXPECT_EQ(rig_.Ask(goal::ZeroTorque{}), Verdict::kTaken);
  rig_.Ask(goal::Damp{});
  EXPECT_EQ(rig_.Ask(goal::BalanceStand{}), Verdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kUnable);
  EXPECT_EQ(rig_.Ask(goal::Sit{}), Verdict::kTaken);
  EXPECT_EQ(rig_.state().id, 3);
  rig_.Run(4.1);
  EXPECT_EQ(rig_.Ask(goal::RiseSit{}), Verdict::kTaken);
  EXPECT_EQ(rig_.state().id, 4);
  rig_.Run(4.1);
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), Verdict::kTaken);
  EXPECT_EQ(rig_.state().id, 2);
  EXPECT_EQ(rig_.Ask(goal::Gesture{}), authority::MotionVerdict::kUnknown);
}

TEST_F(HumanoidMotionTest, WalksOnlyWhereItBalances) {
  EXPECT_EQ(rig_.Ask(goal::Move{0.3, 0, 0, 1}), Verdict::kNotNow);
  Balance();
  EXPECT_EQ(rig_.Ask(goal::Move{0.3, 0, 0, 1}), Verdict::kTaken);
  EXPECT_EQ(rig_.Ask(goal::StopMove{}), Verdict::kTaken);
  EXPECT_EQ(rig_.Ask(goal::Move{std::nan("")}), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig_.Ask(goal::SetBalanceMode{2}), authority::MotionVerdict::kUnable);
  ASSERT_EQ(rig_.SetFsm(706), Verdict::kTaken);
  EXPECT_EQ(rig_.Ask(goal::Move{0.3, 0, 0, 1}), Verdict::kNotNow);
}

TEST_F(HumanoidMotionTest, RefusesValuesThatAreNotFinite) {
  Balance();
  EXPECT_EQ(rig_.Ask(goal::SetStandHeight{std::nan("")}), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig_.Ask(goal::SetFsm::From({HUGE_VAL})), authority::MotionVerdict::kUnknown);
}

TEST(HumanoidHeightTest, StandsLowerAndHigher) {
  HumanoidRig rig(ConfigOf("g1", {"robot.motion.humanoid.stand_heights=true"}));
  rig.Start("standing");
  rig.Run(1);
  ASSERT_EQ(rig.SetFsm(501), Verdict::kTaken);
  rig.Run(0.5);
  const double high = rig.height();
  ASSERT_EQ(rig.Ask(goal::SetStandHeight{0}), Verdict::kTaken);
  rig.Run(2.5);
  EXPECT_LT(rig.height(), high - 0.05);
  EXPECT_NEAR(rig.state().body_height, rig.height(), 0.005);
  ASSERT_EQ(rig.Ask(goal::SetStandHeight{5}), Verdict::kTaken);
  rig.Run(2.5);
  EXPECT_NEAR(rig.height(), high, 0.005);
}

// unitree_sdk2_python issues 67 and 138.
TEST_F(HumanoidMotionTest, TakesAStandHeightAndStaysAsItIs) {
  Balance();
  const double high = rig_.height();
  EXPECT_EQ(rig_.Ask(goal::SetStandHeight{0}), kIgnored);
  rig_.Run(2.5);
  EXPECT_NEAR(rig_.height(), high, 0.005);
}

TEST_F(HumanoidMotionTest, WavesAndLetsItsArmDown) {
  Balance();
  EXPECT_EQ(Act(26), Verdict::kTaken);
  EXPECT_EQ(state().arm_action, 26);
  EXPECT_EQ(Act(27), Verdict::kNotNow);
  EXPECT_EQ(Act(99), Verdict::kNotNow);
  rig_.Run(2);
  EXPECT_LT(rig_.q("right_shoulder_pitch_joint"), -2);
  EXPECT_EQ(state().progress, 1);
  rig_.Run(3);
  EXPECT_EQ(state().arm_action, 0);
  EXPECT_EQ(state().progress, 0);
  EXPECT_NEAR(rig_.q("right_shoulder_pitch_joint"), 0, 0.03);
}

TEST_F(HumanoidMotionTest, StopsAnActionHalfway) {
  Balance();
  Act(26);
  rig_.Run(1);
  EXPECT_EQ(rig_.Ask(goal::StopArmAction{}), Verdict::kTaken);
  rig_.Run(2);
  EXPECT_EQ(state().arm_action, 0);
  EXPECT_EQ(state().arm_told, 99) << "stays until the next action";
  EXPECT_NEAR(rig_.q("right_shoulder_pitch_joint"), 0, 0.03);
  Act(26);
  EXPECT_EQ(state().arm_told, 26);
  rig_.Run(5);
  EXPECT_EQ(state().arm_told, 0) << "ended by itself";
}

TEST_F(HumanoidMotionTest, ActsOnlyWhileItBalances) {
  rig_.Start("standing");
  EXPECT_EQ(Act(26), Verdict::kNotNow);
  EXPECT_EQ(Act(77), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(Act(99), Verdict::kNotNow);
}

TEST_F(HumanoidMotionTest, StandsWhenPushedAslant) {
  Balance();
  rig_.Push({30, 30, 0}, 0.1);
  rig_.Run(2);
  EXPECT_TRUE(rig_.standing());
}

class ArmActionsTest : public test::MujocoTest, public testing::WithParamInterface<std::string> {};

TEST_P(ArmActionsTest, ReachTheirPosesOnTwoFeetAndKeepClearOfTheBody) {
  HumanoidRig rig(GetParam(), 0.002);
  rig.Start("standing");
  rig.Run(1);
  ASSERT_EQ(rig.SetFsm(rig.spec().motion.humanoid.balance.front()), Verdict::kTaken);
  double deepest = 0, tilt = 0;
  rig.watch = [&] {
    deepest = std::max(deepest, rig.DeepestSelfContact());
    tilt = std::max(tilt, rig.world().robot().tilt());
  };
  for (int id = 11; id <= 33; ++id) {
    const ArmSequence* action = FindArmSequence(id);
    if (action == nullptr) continue;
    SCOPED_TRACE(id);
    ASSERT_EQ(rig.Ask(goal::ArmAction{id}), Verdict::kTaken);
    double duration = 0.4;
    for (const ArmKey& key : action->keys) duration += key.duration;
    rig.Run(duration);
    ASSERT_EQ(rig.state().arm_holding, action->holds);
    if (action->holds) {
      const ArmPose* right = action->keys.back().right;
      EXPECT_NEAR(rig.q("right_shoulder_pitch_joint"), (*right)[0], 0.1);
      EXPECT_NEAR(rig.q("right_elbow_joint"), (*right)[3], 0.1);
      ASSERT_EQ(rig.Ask(goal::ArmAction{id}), Verdict::kTaken);
      rig.Run(1.5);
    }
    ASSERT_EQ(rig.state().arm_action, 0);
    ASSERT_TRUE(rig.standing());
    EXPECT_LT(tilt, 0.06);
    EXPECT_LT(deepest, 0.006);  // m
    deepest = tilt = 0;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, ArmActionsTest,
                         testing::ValuesIn(test::RobotsThat([](const robot::RobotSpec& spec) {
                           return spec.motion.humanoid.arm_actions && spec.hands.empty();
                         })),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::motion
