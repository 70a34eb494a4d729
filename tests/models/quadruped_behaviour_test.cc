// Simulates the models of quadrupeds: they stand, lie, roll, and do not touch themselves.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

#include "tests/models/model_fixture.h"
#include "tests/support/robots.h"

namespace understudy::models {
namespace {

using nlohmann::json;
using testing::IsEmpty;

constexpr int kSecond = 1000;  // steps

class QuadrupedTest : public ModelTest, public testing::WithParamInterface<std::string> {
 protected:
  QuadrupedTest()
      : figures_(ReadFigures(GetParam())),
        motors_(figures_["motor_order"].get<std::vector<std::string>>()),
        model_(LoadTogether({ModelFile(GetParam()), kFlat})),
        data_(model_ ? mj_makeData(model_.get()) : nullptr) {}

  void SetUp() override { ASSERT_TRUE(model_ != nullptr); }

  JointPd StandingPd() const {
    const json& stand = figures_["stand"];
    return JointPd(*model_, motors_, stand["kp"], stand["kd"]);
  }
  // Puts the joints where `pose` says, motor order, rad, and the base `height` m over the ground.
  void Place(JointPd* pd, const json& pose, double height) const {
    pd->SetTarget(pose);
    pd->PlaceAtTarget(*model_, data_.get());
    data_->qpos[2] = height;
    mj_forward(model_.get(), data_.get());
  }
  void Record(const JointPd& pd) {
    std::string pose;
    for (const double q : pd.Positions(*model_, *data_)) pose += std::to_string(q) + " ";
    RecordProperty("pose", pose);
    RecordProperty("height", std::to_string(data_->qpos[2]));
    RecordProperty("tilt", std::to_string(TiltDegrees(*data_, 1)));
  }

  json figures_;
  std::vector<std::string> motors_;
  ModelPtr model_;
  DataPtr data_;
};

TEST_P(QuadrupedTest, RunsAtOneMillisecond) { EXPECT_EQ(model_->opt.timestep, 0.001); }

TEST_P(QuadrupedTest, StandsTenSecondsUnderTheGainsOfTheExample) {
  const json& stand = figures_["stand"];
  JointPd pd = StandingPd();
  Place(&pd, stand["pose"], stand["start_height"]);
  double tilt = 0;
  for (int i = 0; i < 10 * kSecond; ++i) {
    pd.Step(*model_, data_.get());
    tilt = std::max(tilt, TiltDegrees(*data_, 1));
  }
  Record(pd);
  EXPECT_LT(tilt, stand["tilt"].get<double>());
  EXPECT_GT(data_->qpos[2], stand["height"][0].get<double>());
  EXPECT_LT(data_->qpos[2], stand["height"][1].get<double>());
  // The body sinks and moves back 2 cm as the calves give; the feet stay, and wheels roll a little.
  EXPECT_LT(std::hypot(data_->qpos[0], data_->qpos[1]), 0.05);
  EXPECT_LT(pd.MaxSpeed(*model_, *data_), 0.02);
}

TEST_P(QuadrupedTest, DoesNotTouchItselfStandingOrLying) {
  JointPd pd = StandingPd();
  Place(&pd, figures_["stand"]["pose"], 1.5);
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty()) << "standing";
  Place(&pd, figures_["lie"]["start"], 1.5);
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty()) << "lying";
}

TEST_P(QuadrupedTest, LiesDownFoldedWhenItsMotorsOnlyBrake) {
  const json& lie = figures_["lie"];
  JointPd damping(*model_, motors_, std::vector<double>(motors_.size(), 0.0),
                  std::vector<double>(motors_.size(), lie["kd"].get<double>()));
  Place(&damping, lie["start"], lie["start_height"]);
  for (int i = 0; i < 5 * kSecond; ++i) damping.Step(*model_, data_.get());
  Record(damping);
  EXPECT_LT(TiltDegrees(*data_, 1), 5.0);
  EXPECT_LT(damping.MaxSpeed(*model_, *data_), 0.02);
  EXPECT_NEAR(data_->qpos[2], lie["height"].get<double>(), 0.01);
  const std::vector<double> q = damping.Positions(*model_, *data_);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(q[i], lie["settled"][i].get<double>(), 0.05) << motors_[i];
  }
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

// The stand examples of the SDK: from wherever the robot lies to the crouch and on to the stand, a
// second each, along straight lines in joint space.
TEST_P(QuadrupedTest, RisesFromLyingAsTheExampleDoes) {
  const json& lie = figures_["lie"];
  const json& stand = figures_["stand"];
  std::vector<double> from = lie["settled"];
  from.resize(motors_.size());  // wheels start at 0
  JointPd pd = StandingPd();
  Place(&pd, from, lie["height"]);
  for (const json& to : {lie["start"], stand["pose"]}) {
    for (int i = 1; i <= kSecond; ++i) {
      std::vector<double> target = from;
      for (std::size_t m = 0; m < target.size(); ++m) {
        target[m] += (to[m].get<double>() - from[m]) * i / kSecond;
      }
      pd.SetTarget(target);
      pd.Step(*model_, data_.get());
    }
    from = to.get<std::vector<double>>();
  }
  for (int i = 0; i < kSecond; ++i) pd.Step(*model_, data_.get());
  Record(pd);
  EXPECT_LT(TiltDegrees(*data_, 1), 3.0);
  EXPECT_GT(data_->qpos[2], stand["height"][0].get<double>());
}

INSTANTIATE_TEST_SUITE_P(Robots, QuadrupedTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

class WheeledTest : public QuadrupedTest {};

// Under dq commands alone (kp 0), as the SDK's examples drive the wheels.
TEST_P(WheeledTest, RollsAtTheCommandedWheelSpeed) {
  const double dq = figures_["roll"]["dq"];
  for (const double direction : {1.0, -1.0}) {
    mj_resetData(model_.get(), data_.get());
    JointPd pd = StandingPd();
    Place(&pd, figures_["stand"]["pose"], figures_["stand"]["start_height"]);
    std::vector<double> speed(motors_.size(), 0.0);
    std::fill(speed.begin() + 12, speed.end(), direction * dq);
    pd.SetTargetSpeed(speed);
    for (int i = 0; i < 3 * kSecond; ++i) pd.Step(*model_, data_.get());
    const double x = data_->qpos[0], y = data_->qpos[1];
    for (int i = 0; i < 2 * kSecond; ++i) pd.Step(*model_, data_.get());
    const double forward = (data_->qpos[0] - x) / 2;
    const double expected = direction * dq * figures_["wheels"][0]["radius"].get<double>();
    RecordProperty(direction > 0 ? "forward" : "backward", std::to_string(forward / expected));
    EXPECT_NEAR(forward / expected, 1.0, 0.1);
    EXPECT_LT(std::abs(data_->qpos[1] - y), 0.02) << "drifts sideways";
    EXPECT_LT(TiltDegrees(*data_, 1), 5.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, WheeledTest, testing::ValuesIn(test::WheeledRobots()),
                         [](const auto& test) { return test.param; });

class Go2Test : public QuadrupedTest {};

TEST_P(Go2Test, ConesAreElliptic) {
  EXPECT_EQ(model_->opt.cone, mjCONE_ELLIPTIC);
  EXPECT_EQ(model_->opt.impratio, 10000.0);
}

INSTANTIATE_TEST_SUITE_P(Robots, Go2Test, testing::Values("go2", "go2w"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::models
