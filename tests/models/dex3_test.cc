// Simulates the Dex3-1 hands of the G1's model.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

#include "tests/models/model_fixture.h"

namespace understudy::models {
namespace {

constexpr int kSecond = 1000;       // steps
constexpr double kExampleKd = 0.1;  // unitree_sdk2 g1_dex3_example
constexpr double kMostKd = 0.3;     // that a public report on a real pair used

class Dex3Test : public ModelTest {
 protected:
  // The wrists are where they are; no ground.
  Dex3Test()
      : model_(LoadTogether({ModelFile("g1_29dof_dex3")},
                            "<equality><weld body1=\"left_wrist_yaw_link\"/>"
                            "<weld body1=\"right_wrist_yaw_link\"/></equality>")),
        data_(model_ ? mj_makeData(model_.get()) : nullptr),
        hands_(ReadFigures("g1_29dof_dex3")["hands"]) {}

  void SetUp() override { ASSERT_TRUE(model_ != nullptr); }

  std::vector<std::string> Motors(const std::string& side) const {
    return hands_[side]["motor_order"].get<std::vector<std::string>>();
  }
  std::vector<std::string> Fingers() const {
    std::vector<std::string> all = Motors("left");
    const std::vector<std::string> right = Motors("right");
    all.insert(all.end(), right.begin(), right.end());
    return all;
  }
  // The middle between the limits of the example, as when it grips.
  std::vector<double> Grip() const {
    std::vector<double> q;
    for (const char* side : {"left", "right"}) {
      for (std::size_t i = 0; i < 7; ++i) {
        q.push_back(
            (hands_[side]["sdk_min"][i].get<double>() + hands_[side]["sdk_max"][i].get<double>()) /
            2);
      }
    }
    return q;
  }
  JointPd Pd(double kp, double kd) const {
    const std::size_t count = Fingers().size();
    return JointPd(*model_, Fingers(), std::vector<double>(count, kp),
                   std::vector<double>(count, kd));
  }
  double FeltInertia(const std::string& joint) {  // kg m^2, 1 / (M^-1)ii
    mj_forward(model_.get(), data_.get());
    const int dof = model_->jnt_dofadr[Id(*model_, mjOBJ_JOINT, joint)];
    std::vector<mjtNum> unit(static_cast<std::size_t>(model_->nv)), column(unit);
    unit[static_cast<std::size_t>(dof)] = 1;
    mj_solveM(model_.get(), data_.get(), column.data(), unit.data(), 1);
    return 1 / column[static_cast<std::size_t>(dof)];
  }
  // Largest finger speed, rad/s, in the second second under the example's gains.
  double FastestFinger() {
    const JointPd pd = Pd(0.5, kExampleKd);
    double fastest = 0;
    for (int i = 0; i < 2 * kSecond; ++i) {
      pd.Step(*model_, data_.get());
      if (i > kSecond) fastest = std::max(fastest, pd.MaxSpeed(*model_, *data_));
    }
    return fastest;
  }
  // The joints of the fingers as the vendor's file has them.
  void TakeArmatureAndFrictionAway() {
    for (const std::string& joint : Fingers()) {
      const int dof = model_->jnt_dofadr[Id(*model_, mjOBJ_JOINT, joint)];
      model_->dof_armature[dof] = model_->dof_frictionloss[dof] = 0;
    }
  }

  ModelPtr model_;
  DataPtr data_;
  const nlohmann::json hands_;
};

// A torque held for one step brakes a joint only while kd < 2 I / dt.
TEST_F(Dex3Test, FingersBearTheDampingThatProgramsSend) {
  for (const std::string& joint : Fingers()) {
    EXPECT_LT(kMostKd, FeltInertia(joint) / model_->opt.timestep) << joint << ", half is margin";
  }
}

TEST_F(Dex3Test, FingersAreStillUnderTheGainsOfTheExample) { EXPECT_LT(FastestFinger(), 0.05); }

// The trap of the vendor's file: why ours has an armature.
TEST_F(Dex3Test, FingersWithoutArmatureWouldChatterUnderTheGainsOfTheExample) {
  TakeArmatureAndFrictionAway();
  for (const char* joint : {"left_hand_index_1_joint", "right_hand_thumb_2_joint"}) {
    EXPECT_LT(FeltInertia(joint) * 2 / model_->opt.timestep, kExampleKd) << joint;
  }
  std::fill(data_->qvel, data_->qvel + model_->nv, 0.1);  // rad/s, a nudge
  EXPECT_GT(FastestFinger(), 10);
}

TEST_F(Dex3Test, DoesNotTouchItselfWithOpenHands) {
  mj_forward(model_.get(), data_.get());
  EXPECT_THAT(SelfContacts(*model_, *data_), testing::IsEmpty());
}

// Within what the real pair of the report missed its aims by, at kp 1.
TEST_F(Dex3Test, FingersComeNearWhereTheExampleGrips) {
  JointPd pd = Pd(1.5, kExampleKd);
  const std::vector<double> aim = Grip();
  pd.SetTarget(aim);
  for (int i = 0; i < 2 * kSecond; ++i) pd.Step(*model_, data_.get());
  const std::vector<double> q = pd.Positions(*model_, *data_);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(q[i], aim[i], 0.09) << Fingers()[i];
  EXPECT_LT(pd.MaxSpeed(*model_, *data_), 0.02);
}

// The limits of the example say which motor is which: its table against the joints' own.
TEST_F(Dex3Test, RangesAreTheExamplesMotorByMotor) {
  for (const char* side : {"left", "right"}) {
    const std::vector<std::string> motors = Motors(side);
    for (std::size_t i = 0; i < motors.size(); ++i) {
      const int joint = Id(*model_, mjOBJ_JOINT, motors[i]);
      // It rounds, and has 0.742 where the models have 0.724.
      EXPECT_NEAR(model_->jnt_range[2 * joint], hands_[side]["sdk_min"][i].get<double>(), 0.02)
          << motors[i];
      EXPECT_NEAR(model_->jnt_range[2 * joint + 1], hands_[side]["sdk_max"][i].get<double>(), 0.02)
          << motors[i];
    }
  }
}

// One hand is the other one turned over: motor by motor they stand on mirrored places.
TEST_F(Dex3Test, MotorsOfTheRightHandStandWhereThoseOfTheLeftDoTurnedAboutTheForearm) {
  const std::vector<std::string> left = Motors("left"), right = Motors("right");
  for (std::size_t i = 0; i < left.size(); ++i) {
    const mjtNum* l = model_->body_pos + 3 * model_->jnt_bodyid[Id(*model_, mjOBJ_JOINT, left[i])];
    const mjtNum* r = model_->body_pos + 3 * model_->jnt_bodyid[Id(*model_, mjOBJ_JOINT, right[i])];
    EXPECT_EQ(r[0], l[0]) << right[i];
    EXPECT_EQ(r[1], -l[1]) << right[i];
    EXPECT_EQ(r[2], -l[2]) << right[i];
  }
}

}  // namespace
}  // namespace understudy::models
