// That rt/sportmodestate tells what the robot knows of itself: each field is near the simulation's
// truth, and neither that truth nor a constant.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "idl/unitree_go.h"
#include "tests/motion/quadruped/rig.h"
#include "wire/motion_codec.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;
using Message = unitree_go_msg_dds__SportModeState_;

// One number of the message and the same of the simulation, of the instants of a walk.
struct Field {
  std::string name;
  std::function<double(const Message&)> told;
  std::function<double(const QuadrupedRig&)> truth;
  double near;    // root mean square of the difference at most
  double varies;  // spread of what is told at least
};

Vector3d FootInBase(const QuadrupedRig& rig, std::size_t foot) {
  const mjModel& model = rig.world().model();
  const mjData& data = rig.world().data();
  const int geom = mj_name2id(&model, mjOBJ_GEOM, rig.spec().feet[foot].geoms[0].c_str());
  const int base = mj_name2id(&model, mjOBJ_BODY, rig.spec().base_body.c_str());
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R_WB(data.xmat + 9 * base);
  const Eigen::Map<const Vector3d> p_WF(data.geom_xpos + 3 * geom), p_WB(data.xpos + 3 * base);
  return R_WB.transpose() * (p_WF - p_WB);
}

std::vector<Field> FieldsOfAll() {
  std::vector<Field> fields;
  for (int axis = 0; axis < 2; ++axis) {
    fields.push_back({"position[" + std::to_string(axis) + "]",
                      [axis](const Message& m) { return m.position[axis]; },
                      [axis](const QuadrupedRig& r) { return r.robot().sampled().base.p_WB[axis]; },
                      0.15, 0.02});
  }
  fields.push_back({"position[2]", [](const Message& m) { return m.position[2]; },
                    [](const QuadrupedRig& r) { return r.robot().sampled().base.p_WB.z(); }, 0.02,
                    0.002});
  for (int axis = 0; axis < 3; ++axis) {
    fields.push_back(
        {"velocity[" + std::to_string(axis) + "]",
         [axis](const Message& m) { return m.velocity[axis]; },
         [axis](const QuadrupedRig& r) { return r.robot().sampled().base.v_WB_W[axis]; }, 0.1,
         0.02});
  }
  fields.push_back({"yaw_speed", [](const Message& m) { return m.yaw_speed; },
                    [](const QuadrupedRig& r) {
                      return r.world().data().qvel[5];  // of a free joint, in the body
                    },
                    0.05, 0.05});
  return fields;
}

std::vector<Field> FieldsOfFeet() {
  std::vector<Field> fields;
  for (std::size_t foot = 0; foot < 4; ++foot) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t slot = 3 * foot + axis;
      fields.push_back({"foot_position_body[" + std::to_string(slot) + "]",
                        [slot](const Message& m) { return m.foot_position_body[slot]; },
                        [foot, axis](const QuadrupedRig& r) {
                          return FootInBase(r, foot)[static_cast<Eigen::Index>(axis)];
                        },
                        0.02, 0.003});
    }
    fields.push_back({"foot_force[" + std::to_string(foot) + "]",
                      [foot](const Message& m) { return m.foot_force[foot]; },
                      [](const QuadrupedRig&) { return 30.0; },  // counts, of a trot: 15.5 to 60
                      40, 5});
  }
  return fields;
}

class ToldTest : public testing::Test {
 protected:
  // Ahead, to the side and in a turn; what is told and what is true in every step.
  void Walk(WalkingRig* rig, const std::vector<Field>& fields) {
    const wire::MotionFields kind = wire::MotionFieldsOf(rig->spec());
    rig->Start("standing");
    rig->Run(1);
    told_.resize(fields.size());
    truth_.resize(fields.size());
    rig->watch = [&, this] {
      Message message{};
      wire::EncodeMotion(rig->robot().sampled(), rig->spec(), kind, &message);
      for (std::size_t i = 0; i < fields.size(); ++i) {
        told_[i].push_back(fields[i].told(message));
        truth_[i].push_back(fields[i].truth(*rig));
      }
    };
    rig->Walk({0.6, 0, 0}, 2);
    rig->Walk({0.3, 0.2, 0.8}, 2);
    rig->watch = {};
  }

  void Expect(const std::vector<Field>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      SCOPED_TRACE(fields[i].name);
      double square = 0;
      std::size_t same = 0;
      for (std::size_t step = 0; step < told_[i].size(); ++step) {
        const double off = told_[i][step] - truth_[i][step];
        square += off * off;
        if (static_cast<float>(truth_[i][step]) == static_cast<float>(told_[i][step])) ++same;
      }
      const auto [low, high] = std::ranges::minmax(told_[i]);
      EXPECT_LT(std::sqrt(square / static_cast<double>(told_[i].size())), fields[i].near);
      EXPECT_GT(high - low, fields[i].varies);
      EXPECT_LT(same, told_[i].size() / 10) << "it is the truth";
    }
  }

  std::vector<std::vector<double>> told_, truth_;  // by field, by step
};

TEST_F(ToldTest, EveryFieldOfMcfIsTheRobotsOwn) {
  WalkingRig rig("go2");
  const std::vector<Field> fields = FieldsOfAll();
  Walk(&rig, fields);
  Expect(fields);
}

TEST_F(ToldTest, EveryFieldOfOlderFirmwareIsTheRobotsOwn) {
  WalkingRig rig("go2", {"robot.firmware='1.1.5'"});
  std::vector<Field> fields = FieldsOfAll();
  for (Field& field : FieldsOfFeet()) fields.push_back(std::move(field));
  Walk(&rig, fields);
  Expect(fields);
}

// The difference of what is told of a foot's place is what is told of its speed.
TEST_F(ToldTest, SpeedsOfFeetAreThoseOfTheirPlaces) {
  std::vector<Field> fields;
  for (std::size_t slot = 0; slot < 12; ++slot) {
    fields.push_back({"place", [slot](const Message& m) { return m.foot_position_body[slot]; },
                      [](const QuadrupedRig&) { return 0.0; }, 0, 0});
    fields.push_back({"speed", [slot](const Message& m) { return m.foot_speed_body[slot]; },
                      [](const QuadrupedRig&) { return 0.0; }, 0, 0});
  }
  WalkingRig rig("go2", {"robot.firmware='1.1.5'", "sensors.noise=false"});
  Walk(&rig, fields);
  constexpr std::size_t kSpan = 20;  // steps of 1 ms
  for (std::size_t slot = 0; slot < 12; ++slot) {
    const std::vector<double>&place = told_[2 * slot], &speed = told_[2 * slot + 1];
    double worst = 0, fastest = 0;
    for (std::size_t i = kSpan; i < place.size(); ++i) {
      double mean = 0;
      for (std::size_t k = i - kSpan; k < i; ++k) mean += speed[k] / kSpan;
      worst = std::max(worst, std::abs((place[i] - place[i - kSpan]) / (1e-3 * kSpan) - mean));
      fastest = std::max(fastest, std::abs(mean));
    }
    EXPECT_LT(worst, 0.25 * fastest + 0.05) << slot;
    EXPECT_GT(fastest, 0.02) << slot;
  }
}

TEST_F(ToldTest, ItsPlaceBeginsAtNoughtAndDrifts) {
  WalkingRig rig("go2");
  rig.Start("standing");
  EXPECT_LT(rig.state().p_WB.head<2>().norm(), 0.01);
  rig.Walk({0.8, 0, 0.3}, 8);
  const Vector3d told = rig.state().p_WB, truth = rig.world().robot().base().p_WB;
  const double drift = (told - truth).head<2>().norm();
  EXPECT_GT(drift, 1e-3);
  EXPECT_LT(drift, 0.6);
}

TEST_F(ToldTest, HeightGaitAndFootRaiseAreThoseThatAreSet) {
  QuadrupedRig rig("go2", {"robot.firmware='1.1.5'"});
  rig.Start("standing");
  rig.Run(1);
  const auto told = [&] {
    Message message{};
    wire::EncodeMotion(rig.robot().sampled(), rig.spec(), wire::MotionFieldsOf(rig.spec()),
                       &message);
    return message;
  };
  EXPECT_EQ(told().gait_type, 1);
  EXPECT_EQ(told().progress, 0);
  EXPECT_NEAR(told().body_height, 0.33, 1e-6);
  EXPECT_NEAR(told().foot_raise_height, 0.08, 1e-6);
  rig.Ask(goal::BodyHeight{-0.05});
  rig.Ask(goal::Gait{goal::GaitName::kRun});
  rig.Run(0.5);
  EXPECT_NEAR(told().body_height, 0.28, 1e-6);
  EXPECT_EQ(told().gait_type, 2);
  rig.Ask(goal::Gait{goal::GaitName::kClassic});
  rig.Run(0.5);
  EXPECT_GT(told().foot_raise_height, 0.1);
  ASSERT_EQ(rig.Ask(goal::Gesture{}), authority::MotionVerdict::kTaken);
  rig.Run(0.5);
  EXPECT_EQ(told().progress, 1);
}

}  // namespace
}  // namespace understudy::motion
