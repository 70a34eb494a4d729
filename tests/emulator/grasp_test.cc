// Hands of a G1 close on things and hold them while the arm moves.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "config/load.h"
#include "mjcf/eigen_views.h"
#include "robot/hand_law.h"
#include "tests/emulator/emulator_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::emulator {
namespace {

constexpr char kCube[] = R"(<geom type="box" size="0.025 0.025 0.025" mass="0.1"/>)";
constexpr char kBottle[] = R"(<geom type="cylinder" size="0.032 0.1" mass="0.3"/>)";
constexpr int kShoulderPitch = 15, kElbow = 18;  // of the left arm

struct Grasp {
  std::string make;
  std::string thing;            // MJCF of its shape
  std::array<double, 3> place;  // m, where the thing is in the frame of the left wrist
  // Of the left hand's motors: before the thing is there, and around it. rad, joint side.
  std::vector<double> open, closed;
};

class GraspTest : public EmulatorTest, public testing::WithParamInterface<Grasp> {
 protected:
  void SetUp() override {
    const std::string scene =
        folder_.Write("scene.xml",
                      "<mujoco><worldbody><geom name=\"floor\" type=\"plane\" size=\"0 0 1\"/>"
                      "<body name=\"thing\" pos=\"2 0 1\"><freejoint/>" +
                          GetParam().thing + "</body></worldbody></mujoco>");
    if (GetParam().make == "inspire_ftp") tau_ = 0.8;  // N·m, its register of force
    config_ = config::LoadConfig(
        {.robot = "g1",
         .sets = {"robot.hand_make=left:" + GetParam().make, "start.pose=clamped",
                  "motion.service=none", "scene=" + scene}},
        UNDERSTUDY_SOURCE_DIR);
    world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
    const mjModel& model = world_->physics().model();
    thing_ = mj_name2id(&model, mjOBJ_BODY, "thing");
    wrist_ = mj_name2id(&model, mjOBJ_BODY, "left_wrist_yaw_link");
  }

  // Ticks with the arm at these angles [rad] and the fingers there.
  void Hold(double shoulder, double elbow, const std::vector<double>& fingers) {
    robot::RobotCommand body;
    for (const robot::MotorSpec& motor : config_.robots[0].spec.motors) {
      body.motors.push_back({.enabled = true, .kp = 2 * motor.hold_kp, .kd = 2 * motor.hold_kd});
    }
    body.motors[kShoulderPitch].q = shoulder;
    body.motors[kElbow].q = elbow;
    port_.Send(body);
    robot::RobotCommand hand;
    for (const double q : fingers) {
      hand.motors.push_back({.enabled = true, .q = q, .dq = 9, .tau = tau_, .kp = 5, .kd = 0.05});
    }
    port_.SendHand(0, hand);
    Tick();
  }

  Eigen::Isometry3d X_W(int body) const {
    const mjData& data = world_->physics().data();
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = mjcf::Vector(data.xpos + 3 * body);
    X.linear() = mjcf::RotationView(data.xmat + 9 * body);
    return X;
  }

  // Puts the thing at rest between the fingers, as if held by somebody.
  void PutThere() {
    const mjModel& model = world_->physics().model();
    auto& data = const_cast<mjData&>(world_->physics().data());
    const Eigen::Vector3d p =
        X_W(wrist_) *
        Eigen::Vector3d(GetParam().place[0], GetParam().place[1], GetParam().place[2]);
    const Eigen::Quaterniond q(X_W(wrist_).linear());
    const int joint = model.body_jntadr[thing_];
    mjtNum* const qpos = data.qpos + model.jnt_qposadr[joint];
    const std::array<double, 7> pose{p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
    std::ranges::copy(pose, qpos);
    std::fill_n(data.qvel + model.jnt_dofadr[joint], 6, 0.0);
  }

  // What presses on the left hand, which is the only one. N
  double Force() const {
    double force = -1;
    world_->physics().robot().HandForces({&force, 1});
    return force;
  }

  Eigen::Vector3d InHand() const { return (X_W(wrist_).inverse() * X_W(thing_)).translation(); }

  // Opens the hand, holds the thing in it and closes.
  void Take(double elbow) {
    for (int i = 0; i < 1500; ++i) Hold(0, elbow, GetParam().open);
    for (int i = 0; i < 900; ++i) {
      PutThere();
      Hold(0, elbow, GetParam().closed);
    }
    for (int i = 0; i < 500; ++i) Hold(0, elbow, GetParam().closed);
  }

  test::TemporaryFolder folder_;
  double tau_ = 0;
  int thing_ = -1, wrist_ = -1;
};

TEST_P(GraspTest, HoldsWhileTheArmMoves) {
  constexpr double kElbowBent = 0.4;  // rad
  for (int i = 0; i < 1500; ++i) Hold(0, kElbowBent, GetParam().open);
  EXPECT_EQ(Force(), 0) << "nothing is in it";
  Take(kElbowBent);
  EXPECT_GT(Force(), 2);
  const Eigen::Vector3d held = InHand();
  const double height = X_W(thing_).translation().z();
  double most = height;
  for (int i = 0; i < 4000; ++i) {
    const double swing = std::sin(2 * std::numbers::pi * i / 2000.0);
    Hold(-0.4 * swing, kElbowBent - 0.3 * swing, GetParam().closed);
    most = std::max(most, X_W(thing_).translation().z());
  }
  EXPECT_GT(most, height + 0.05) << "the arm has lifted it";
  EXPECT_LT((InHand() - held).norm(), 0.02);
}

std::vector<double> Inspire(double finger, double bend, double turn) {
  return {finger, finger, finger, finger, bend, turn};
}
std::vector<double> Revo2(double turn, double bend, double finger) {
  return {turn, bend, finger, finger, finger, finger};
}

INSTANTIATE_TEST_SUITE_P(
    Hands, GraspTest,
    testing::Values(
        Grasp{"dex1", kCube, {0.155, 0, 0}, {5.4}, {0}},
        Grasp{"dex1", kBottle, {0.155, 0, 0}, {5.4}, {0}},
        Grasp{
            "inspire", kCube, {0.175, -0.043, 0.02}, Inspire(0, -0.1, 1.3), Inspire(0.3, 0.5, 1.3)},
        Grasp{
            "inspire", kBottle, {0.19, -0.05, 0.02}, Inspire(0, -0.1, 1.3), Inspire(0.3, 0.5, 1.3)},
        Grasp{"inspire_ftp",
              kCube,
              {0.208, -0.046, 0.02},
              Inspire(0, 0, 1.1641),
              Inspire(0.5, 0.5, 1.1641)},
        Grasp{"inspire_ftp",
              kBottle,
              {0.215, -0.053, 0.02},
              Inspire(0, 0, 1.1641),
              Inspire(0.5, 0.5, 1.1641)},
        Grasp{"brainco", kCube, {0.14, -0.043, 0.02}, Revo2(1.5, 0, 0), Revo2(1.5, 1, 0.3)},
        Grasp{"brainco", kBottle, {0.14, -0.05, 0.02}, Revo2(1.5, 0, 0), Revo2(1.5, 1, 0.3)}),
    [](const auto& grasp) {
      return grasp.param.make + (grasp.param.thing == kCube ? "Cube" : "Bottle");
    });

// Hands with pads, and what the pads show of a cube that they hold.
class FeltTest : public GraspTest {
 protected:
  void SetUp() override {
    GraspTest::SetUp();
    port_.KeepTheLastOnly();
  }
  // The sum of the counts of the pads with that word in the names of their sites.
  double Counts(const std::string& word) const {
    const std::vector<float>& touch = port_.last().state.touch;
    double sum = 0;
    std::size_t first = 0;
    for (const robot::PadSpec& pad : config_.robots[0].spec.hands[0].pads) {
      const std::size_t end = first + robot::CellsOf(pad);
      const bool counts = pad.site.find(word) != std::string::npos;
      for (; first < end; ++first) sum += counts ? static_cast<double>(touch[first]) : 0;
    }
    return sum;
  }
};

TEST_P(FeltTest, AThingIsFeltByTheFingersThatHoldItAndNowhereElse) {
  for (int i = 0; i < 1500; ++i) Hold(0, 0.4, GetParam().open);
  EXPECT_EQ(Counts(""), 0) << "an open hand feels nothing";
  EXPECT_EQ(Force(), 0);
  Take(0.4);
  EXPECT_GT(Force(), 2);
  Snapshot shown = world_->MakeSnapshot(0);
  shown.parts = kPartTouch;
  world_->Show(&shown);
  EXPECT_EQ(shown.touch.size(), port_.last().state.touch.size());
  EXPECT_GT(*std::ranges::max_element(shown.touch), 0.5) << "N";
  const bool ftp = GetParam().make == "inspire_ftp";
  for (const std::string finger : {"thumb", "index", "middle"}) {
    EXPECT_GT(Counts((ftp ? "left_" : "hand_") + finger), 300) << finger;
  }
  for (const char* none : {ftp ? "little" : "palm_0", ftp ? "ring" : "palm_1", "left_palm"}) {
    EXPECT_EQ(Counts(none), 0) << none;
  }
}

TEST_P(FeltTest, IsNotComputedWhileNobodyReads) {
  Take(0.4);
  const std::vector<float> felt = port_.last().state.touch;
  port_.IgnoreTouch();
  for (int i = 0; i < 1500; ++i) Hold(0, 0.4, GetParam().open);
  EXPECT_EQ(port_.last().state.touch, felt);
}

INSTANTIATE_TEST_SUITE_P(Hands, FeltTest,
                         testing::Values(Grasp{"inspire_ftp",
                                               kCube,
                                               {0.188, -0.043, 0.02},
                                               Inspire(0, 0, 1.1641),
                                               Inspire(0.9, 0.5, 1.1641)},
                                         Grasp{"dex3",
                                               kBottle,
                                               {0.106, -0.05, 0},
                                               {0, 0, 0, 0, 0, 0, 0},
                                               {0, 0.3, 0.3, -1.2, -0.5, -1.2, -0.5}}),
                         [](const auto& grasp) { return grasp.param.make; });

}  // namespace
}  // namespace understudy::emulator
