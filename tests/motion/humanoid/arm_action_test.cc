#include "motion/humanoid/arm_action.h"

#include <cmath>

#include "tests/motion/humanoid/fixture.h"

namespace understudy::motion {
namespace {

class ArmActionTest : public test::MujocoTest {
 protected:
  double q(const std::string& joint) const {
    for (std::size_t i = 0; i < player_.motors().size(); ++i) {
      const auto motor = static_cast<std::size_t>(player_.motors()[i]);
      if (rig_.spec().motors[motor].joint == joint) return player_.q(i);
    }
    ADD_FAILURE() << "no " << joint;
    return 0;
  }

  HumanoidRig rig_{"g1"};
  BodyModel body_{rig_.world().model(), rig_.spec()};
  ArmActionPlayer player_{rig_.spec(), body_};
};

TEST_F(ArmActionTest, RestsAsTheRobotStands) {
  EXPECT_EQ(player_.motors().size(), 14U);
  EXPECT_EQ(q("left_elbow_joint"), 0.97);
  EXPECT_EQ(q("right_shoulder_roll_joint"), -0.25);
  EXPECT_EQ(player_.id(), 0);
  EXPECT_FALSE(player_.holding());
}

TEST_F(ArmActionTest, KnowsTheNumbersOfTheVendorsList) {
  for (const int id : {11, 12, 13, 15, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 33}) {
    EXPECT_NE(FindArmSequence(id), nullptr) << id;
  }
  for (const int id : {1, 28, 29, 30, 34, 36}) {
    EXPECT_EQ(player_.Begin(id), authority::MotionVerdict::kUnable) << id;
  }
  for (const int id : {0, 2, 14, 31, 98, 100}) {
    EXPECT_EQ(player_.Begin(id), authority::MotionVerdict::kUnknown) << id;
  }
}

TEST_F(ArmActionTest, MovesARightArmAsTheMirrorOfALeftOne) {
  player_.Begin(15);
  for (int i = 0; i < 2000; ++i) player_.Advance(0.001);
  EXPECT_DOUBLE_EQ(q("left_shoulder_roll_joint"), -q("right_shoulder_roll_joint"));
  EXPECT_DOUBLE_EQ(q("left_elbow_joint"), q("right_elbow_joint"));
}

TEST_F(ArmActionTest, HoldsUntilTheSameNumberIsAskedAgain) {
  player_.Begin(27);
  for (int i = 0; i < 3000; ++i) player_.Advance(0.001);
  EXPECT_TRUE(player_.holding());
  EXPECT_EQ(player_.Begin(26), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(player_.Begin(27), Verdict::kTaken);
  EXPECT_FALSE(player_.holding());
  for (int i = 0; i < 3000; ++i) player_.Advance(0.001);
  EXPECT_EQ(player_.id(), 0);
}

TEST_F(ArmActionTest, LetsGoByItselfAfterTwentySeconds) {
  player_.Begin(19);
  for (int i = 0; i < 2100; ++i) player_.Advance(0.01);
  EXPECT_TRUE(player_.holding());
  for (int i = 0; i < 500; ++i) player_.Advance(0.01);
  EXPECT_EQ(player_.id(), 0);
}

TEST_F(ArmActionTest, TakesAReleaseOfNothing) {
  EXPECT_EQ(player_.told(), 0);
  EXPECT_EQ(player_.Begin(99), Verdict::kTaken);
  EXPECT_EQ(player_.told(), 99);
  EXPECT_EQ(player_.id(), 0);
}

TEST_F(ArmActionTest, NeverJumps) {
  for (const int id : {11, 17, 20, 26}) {
    double last = q("left_shoulder_pitch_joint"), step = 0;
    player_.Begin(id);
    while (player_.id() != 0) {
      player_.Advance(0.001);
      if (player_.holding()) player_.Release();
      step = std::max(step, std::abs(q("left_shoulder_pitch_joint") - last));
      last = q("left_shoulder_pitch_joint");
    }
    EXPECT_LT(step, 0.004) << id;  // 4 rad/s
  }
}

}  // namespace
}  // namespace understudy::motion
