// What the models do when they are stepped: stand, hang, lie, keep clear of themselves.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

#include "tests/models/model_fixture.h"

namespace understudy {
namespace {

using testing::IsEmpty;

constexpr double kTimestep = 0.001;  // s, as the models ask for
constexpr int kSecond = 1000;        // steps

std::vector<std::string> Motors(const std::string& robot) {
  return ReadFigures(robot)["motor_order"].get<std::vector<std::string>>();
}

class Go2Test : public ModelTest {
 protected:
  Go2Test()
      : figures_(ReadFigures("go2")),
        model_(LoadTogether({kGo2, kFlat})),
        data_(model_ ? mj_makeData(model_.get()) : nullptr) {}

  void SetUp() override { ASSERT_TRUE(model_ != nullptr); }

  JointPd Pd(double kp, double kd) const {
    return JointPd(*model_, Motors("go2"), std::vector<double>(12, kp),
                   std::vector<double>(12, kd));
  }
  // hip, thigh, calf of each leg, rad; height of the base, m.
  void Place(JointPd* pd, double hip, double thigh, double calf, double height) const {
    std::vector<double> target;
    for (int leg = 0; leg < 4; ++leg) target.insert(target.end(), {hip, thigh, calf});
    pd->SetTarget(target);
    pd->PlaceAtTarget(*model_, data_.get());
    data_->qpos[2] = height;
    mj_forward(model_.get(), data_.get());
  }

  nlohmann::json figures_;
  ModelPtr model_;
  DataPtr data_;
};

TEST_F(Go2Test, RunsAtOneMillisecondWithEllipticCones) {
  EXPECT_EQ(model_->opt.timestep, kTimestep);
  EXPECT_EQ(model_->opt.cone, mjCONE_ELLIPTIC);
  EXPECT_EQ(model_->opt.impratio, 100.0);
}

TEST_F(Go2Test, StandsTenSecondsUnderTheGainsOfTheExample) {
  const nlohmann::json& stand = figures_["stand"];
  JointPd pd = Pd(stand["kp"], stand["kd"]);
  Place(&pd, stand["pose"][0], stand["pose"][1], stand["pose"][2], stand["start_height"]);
  double tilt = 0;
  for (int i = 0; i < 10 * kSecond; ++i) {
    pd.Step(*model_, data_.get());
    tilt = std::max(tilt, TiltDegrees(*data_, 1));
  }
  RecordProperty("height", std::to_string(data_->qpos[2]));
  RecordProperty("tilt", std::to_string(tilt));
  EXPECT_LT(tilt, 2.0);
  EXPECT_GT(data_->qpos[2], stand["height"][0].get<double>());
  EXPECT_LT(data_->qpos[2], stand["height"][1].get<double>());
  // The body sinks and moves back 2 cm as the calves give; the feet stay.
  EXPECT_LT(std::hypot(data_->qpos[0], data_->qpos[1]), 0.03);
  EXPECT_LT(pd.MaxSpeed(*model_, *data_), 0.01);
}

TEST_F(Go2Test, DoesNotTouchItselfStandingOrLying) {
  JointPd pd = Pd(60, 5);
  Place(&pd, 0, 0.67, -1.3, 1.0);
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty()) << "standing";
  Place(&pd, 0, 1.36, -2.65, 1.0);
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty()) << "lying";
}

TEST_F(Go2Test, LiesDownFoldedWhenItsMotorsOnlyBrake) {
  JointPd damping = Pd(0, 3);  // motors only brake
  Place(&damping, 0, 1.36, -2.65, 0.12);
  for (int i = 0; i < 5 * kSecond; ++i) damping.Step(*model_, data_.get());
  const std::vector<double> q = damping.Positions(*model_, *data_);
  std::string pose;
  for (const double x : q) pose += std::to_string(x) + " ";
  RecordProperty("pose", pose);
  RecordProperty("height", std::to_string(data_->qpos[2]));
  RecordProperty("tilt", std::to_string(TiltDegrees(*data_, 1)));
  EXPECT_LT(TiltDegrees(*data_, 1), 5.0);
  EXPECT_LT(damping.MaxSpeed(*model_, *data_), 0.01);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    EXPECT_NEAR(q[3 * leg], 0.0, 0.1) << "hip of leg " << leg;
    EXPECT_GT(q[3 * leg + 1], 1.1) << "thigh of leg " << leg;
    EXPECT_LT(q[3 * leg + 1], 1.5) << "thigh of leg " << leg;
    EXPECT_LT(q[3 * leg + 2], -2.5) << "calf of leg " << leg;
  }
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

class G1Test : public ModelTest {
 protected:
  // The pelvis is held and there is no ground: a robot on its stand.
  G1Test()
      : model_(LoadTogether({kG1}, "<equality><weld body1=\"pelvis\"/></equality>")),
        data_(model_ ? mj_makeData(model_.get()) : nullptr) {}

  void SetUp() override { ASSERT_TRUE(model_ != nullptr); }

  // Runs 5 s at the zero pose from a nudge of 0.1 rad/s in every joint. Returns the largest joint
  // speed of the last second, rad/s.
  double SpeedAfterNudge(std::vector<double> kp, std::vector<double> kd) {
    const JointPd pd(*model_, Motors("g1_29dof"), std::move(kp), std::move(kd));
    std::fill(data_->qvel + 6, data_->qvel + model_->nv, 0.1);
    double speed = 0;
    for (int i = 0; i < 5 * kSecond; ++i) {
      pd.Step(*model_, data_.get());
      if (i > 4 * kSecond) speed = std::max(speed, pd.MaxSpeed(*model_, *data_));
    }
    for (const double q : pd.Positions(*model_, *data_)) sag_ = std::max(sag_, std::abs(q));
    return speed;
  }

  ModelPtr model_;
  DataPtr data_;
  double sag_ = 0;  // rad, largest joint angle at the end
};

TEST_F(G1Test, RunsAtOneMillisecond) { EXPECT_EQ(model_->opt.timestep, kTimestep); }

TEST_F(G1Test, DoesNotTouchItselfInTheZeroPose) {
  mj_forward(model_.get(), data_.get());
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

TEST_F(G1Test, DoesNotTouchItselfStanding) {
  JointPd pd(*model_, Motors("g1_29dof"), std::vector<double>(29), std::vector<double>(29));
  pd.SetTarget(ReadFigures("g1_29dof")["stand"]["pose"]);
  pd.PlaceAtTarget(*model_, data_.get());
  mj_forward(model_.get(), data_.get());
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

// The SDK example only swings ankles: everything else hangs on soft gains and sags under its
// weight.

TEST_F(G1Test, HangsStillAtTheZeroPoseUnderTheGainsOfTheExample) {
  const nlohmann::json hang = ReadFigures("g1_29dof")["hang"];
  const double speed =
      SpeedAfterNudge(hang["kp"].get<std::vector<double>>(), hang["kd"].get<std::vector<double>>());
  EXPECT_LT(speed, 0.02);
  EXPECT_LT(sag_, 0.35);
}

// unitree_rl_lab FixStand: the highest damping a published program sends to light joints.
TEST_F(G1Test, HangsStillUnderArmDampingOfTen) {
  std::vector<double> kp(29, 40), kd(29, 10);
  const double legs_kp[] = {100, 100, 100, 150, 40, 40};
  const double legs_kd[] = {2, 2, 2, 4, 2, 2};
  for (std::size_t i = 0; i < 12; ++i) {
    kp[i] = legs_kp[i % 6];
    kd[i] = legs_kd[i % 6];
  }
  for (std::size_t i = 12; i < 15; ++i) {
    kp[i] = 200;
    kd[i] = 5;
  }
  EXPECT_LT(SpeedAfterNudge(kp, kd), 0.02);
}

}  // namespace
}  // namespace understudy
