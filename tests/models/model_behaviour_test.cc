// What the humanoids do when they are stepped: hang, keep clear of themselves.

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

using testing::IsEmpty;

constexpr double kTimestep = 0.001;  // s, as the models ask for
constexpr int kSecond = 1000;        // steps

std::vector<std::string> Motors(const std::string& robot) {
  return ReadFigures(robot)["motor_order"].get<std::vector<std::string>>();
}

class G1Test : public ModelTest {
 protected:
  // The pelvis is held and there is no ground: a robot on its stand.
  G1Test()
      : model_(LoadTogether({ModelFile("g1")}, "<equality><weld body1=\"pelvis\"/></equality>")),
        data_(model_ ? mj_makeData(model_.get()) : nullptr) {}

  void SetUp() override { ASSERT_TRUE(model_ != nullptr); }

  // Runs 5 s at the zero pose from a nudge of 0.1 rad/s in every joint. Returns the largest joint
  // speed of the last second, rad/s.
  double SpeedAfterNudge(std::vector<double> kp, std::vector<double> kd) {
    const JointPd pd(*model_, Motors("g1"), std::move(kp), std::move(kd));
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
  JointPd pd(*model_, Motors("g1"), std::vector<double>(29), std::vector<double>(29));
  pd.SetTarget(ReadFigures("g1")["stand"]["pose"]);
  pd.PlaceAtTarget(*model_, data_.get());
  mj_forward(model_.get(), data_.get());
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

// The SDK example only swings ankles: everything else hangs on soft gains and sags under its
// weight.

TEST_F(G1Test, HangsStillAtTheZeroPoseUnderTheGainsOfTheExample) {
  const nlohmann::json hang = ReadFigures("g1")["hang"];
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
}  // namespace understudy::models
