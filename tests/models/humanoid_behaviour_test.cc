// What the models of humanoids do: keep clear of themselves, stand on their soles only,
// hang still under the vendor's gains, lie after a fall.

#include <algorithm>
#include <cmath>
#include <set>
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

using testing::IsEmpty;

constexpr double kTimestep = 0.001;  // s, as the models ask for
constexpr int kSecond = 1000;        // steps
constexpr int kBaseDofs = 6;

class HumanoidTest : public ModelTest, public testing::WithParamInterface<std::string> {
 protected:
  HumanoidTest() : figures_(ReadFigures(GetParam())) {}

  // The pelvis is held and there is no ground: a robot on its stand.
  void Hang() { Load({ModelFile(GetParam())}, "<equality><weld body1=\"pelvis\"/></equality>"); }
  void PutOnGround() { Load({ModelFile(GetParam()), kFlat}, ""); }

  JointPd Pd(std::vector<double> kp, std::vector<double> kd) const {
    return JointPd(*model_, figures_["motor_order"].get<std::vector<std::string>>(), std::move(kp),
                   std::move(kd));
  }
  std::vector<double> Example(const char* gain) const {
    return figures_["hang"][gain].get<std::vector<double>>();
  }
  // `pose`: joint angles in motor order, rad; empty for zero. `height`: of the base, m.
  void Place(const std::vector<double>& pose, double height) {
    const std::size_t motors = figures_["motor_order"].size();
    JointPd pd = Pd(std::vector<double>(motors), std::vector<double>(motors));
    if (!pose.empty()) pd.SetTarget(pose);
    pd.PlaceAtTarget(*model_, data_.get());
    data_->qpos[2] = height;
    mj_forward(model_.get(), data_.get());
  }
  // The fastest joint in the last of 5 s from a nudge of every joint, rad/s.
  double SpeedAfterNudge(const JointPd& pd) {
    std::fill(data_->qvel + kBaseDofs, data_->qvel + model_->nv, 0.1);  // rad/s
    double speed = 0;
    for (int i = 0; i < 5 * kSecond; ++i) {
      pd.Step(*model_, data_.get());
      if (i > 4 * kSecond) speed = std::max(speed, pd.MaxSpeed(*model_, *data_));
    }
    return speed;
  }
  double Sole(const std::string& foot) const {  // m, lowest point of a foot's sphere
    const int id = Id(*model_, mjOBJ_GEOM, foot);
    return data_->geom_xpos[3 * id + 2] - model_->geom_size[3 * id];
  }

  nlohmann::json figures_;
  ModelPtr model_;
  DataPtr data_;

 private:
  void Load(const std::vector<std::string>& files, const std::string& extra) {
    model_ = LoadTogether(files, extra);
    ASSERT_TRUE(model_ != nullptr);
    data_.reset(mj_makeData(model_.get()));
  }
};

TEST_P(HumanoidTest, RunsAtOneMillisecond) {
  Hang();
  EXPECT_EQ(model_->opt.timestep, kTimestep);
}

TEST_P(HumanoidTest, DoesNotTouchItselfInTheZeroPose) {
  Hang();
  mj_forward(model_.get(), data_.get());
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

TEST_P(HumanoidTest, DoesNotTouchItselfStanding) {
  Hang();
  Place(figures_["stand"]["pose"], 1.0);
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

TEST_P(HumanoidTest, PutsBothSolesFlatOnTheGroundInTheZeroPose) {
  PutOnGround();
  Place({}, figures_["zero_pose"]["height"]);
  for (const auto& foot : figures_["feet"]) EXPECT_NEAR(Sole(foot["name"]), 0, 1e-4) << foot;
}

TEST_P(HumanoidTest, PutsItsSolesOnTheGroundStanding) {
  PutOnGround();
  Place(figures_["stand"]["pose"], figures_["stand"]["height"]);
  double lowest = 1;
  for (const auto& foot : figures_["feet"]) lowest = std::min(lowest, Sole(foot["name"]));
  EXPECT_NEAR(lowest, 0, 1e-4);
}

TEST_P(HumanoidTest, TouchesTheGroundWithItsSolesAlone) {
  PutOnGround();
  Place({}, figures_["zero_pose"]["height"].get<double>() - 0.002);
  std::set<std::string> touching, soles;
  for (int i = 0; i < data_->ncon; ++i) {
    for (const int geom : {data_->contact[i].geom1, data_->contact[i].geom2}) {
      const char* name = mj_id2name(model_.get(), mjOBJ_GEOM, geom);
      touching.insert(name == nullptr ? "unnamed" : name);
    }
  }
  soles.insert("floor");
  for (const auto& foot : figures_["feet"]) soles.insert(foot["name"].get<std::string>());
  EXPECT_EQ(touching, soles);
}

// A torque held for one step brakes a joint only while kd < 2 I / dt, I being what the motor feels.
TEST_P(HumanoidTest, BearsTheDampingOfTheExampleAtOneMillisecond) {
  Hang();
  mj_forward(model_.get(), data_.get());
  const std::vector<double> kd = Example("kd");
  const auto joints = figures_["motor_order"].get<std::vector<std::string>>();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const int dof = model_->jnt_dofadr[Id(*model_, mjOBJ_JOINT, joints[i])];
    std::vector<mjtNum> unit(static_cast<std::size_t>(model_->nv)), column(unit);
    unit[static_cast<std::size_t>(dof)] = 1;
    mj_solveM(model_.get(), data_.get(), column.data(), unit.data(), 1);
    const double felt = 1 / column[static_cast<std::size_t>(dof)];  // kg m^2
    EXPECT_LT(kd[i], felt / kTimestep) << joints[i] << " feels " << felt << ", half is margin";
  }
}

TEST_P(HumanoidTest, HangsStillAtTheZeroPoseUnderTheGainsOfTheExample) {
  Hang();
  const JointPd pd = Pd(Example("kp"), Example("kd"));
  const double speed = SpeedAfterNudge(pd);
  double sag = 0;
  for (const double q : pd.Positions(*model_, *data_)) sag = std::max(sag, std::abs(q));
  RecordProperty("speed", std::to_string(speed));
  RecordProperty("sag", std::to_string(sag));
  EXPECT_LT(speed, 0.02);
  EXPECT_LT(sag, figures_["hang"]["sag"].get<double>());
  EXPECT_THAT(SelfContacts(*model_, *data_), IsEmpty());
}

// A humanoid without a balancing program falls, the vendor's models too. It must end on the ground,
// not in it, and stop there.
TEST_P(HumanoidTest, SlumpsToTheGroundWhenItsMotorsOnlyBrake) {
  PutOnGround();
  Place(figures_["stand"]["pose"], figures_["stand"]["height"]);
  const JointPd pd = Pd(std::vector<double>(Example("kd").size()), Example("kd"));
  for (int i = 0; i < 8 * kSecond; ++i) pd.Step(*model_, data_.get());
  const double height = data_->qpos[2];
  for (int i = 0; i < 2 * kSecond; ++i) pd.Step(*model_, data_.get());
  RecordProperty("height", std::to_string(data_->qpos[2]));
  EXPECT_GT(data_->qpos[2], 0.05);
  EXPECT_LT(data_->qpos[2], 0.45);
  EXPECT_NEAR(data_->qpos[2], height, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Robots, HumanoidTest, testing::ValuesIn(test::Humanoids()),
                         [](const auto& test) { return test.param; });

class G1Test : public HumanoidTest {};

// unitree_rl_lab FixStand: the highest damping a published program sends to light joints.
TEST_P(G1Test, HangsStillUnderArmDampingOfTen) {
  Hang();
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
  EXPECT_LT(SpeedAfterNudge(Pd(kp, kd)), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Robots, G1Test, testing::Values("g1"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::models
