// Humanoids: their slots, and that description and model carry the same published figures.
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "config_fixture.h"
#include "tests/support/robots.h"

namespace understudy::config {
namespace {

using test::ShippedRobot;

nlohmann::json Figures(const std::string& name) {
  return nlohmann::json::parse(
      std::ifstream(std::string(UNDERSTUDY_SOURCE_DIR) + "/tests/data/figures/" + name + ".json"));
}

std::string JointInSlot(const robot::RobotSpec& robot, int slot) {
  for (const robot::MotorSpec& motor : robot.motors) {
    if (motor.slot == slot) return motor.joint;
  }
  return "none";
}

class HumanoidsTest : public testing::TestWithParam<std::string> {};

TEST_P(HumanoidsTest, HasTheMotorsOfTheSdkInItsOrder) {
  const auto order = Figures(GetParam())["motor_order"].get<std::vector<std::string>>();
  const robot::RobotSpec robot = ShippedRobot(GetParam());
  ASSERT_EQ(robot.motors.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(robot.motors[i].joint, order[i]);
}

TEST_P(HumanoidsTest, LimitsTheTorqueAsItsModelDoes) {
  const nlohmann::json figures = Figures(GetParam());
  const robot::RobotSpec robot = ShippedRobot(GetParam());
  for (const nlohmann::json& joint : figures["joints"]) {
    for (const robot::MotorSpec& motor : robot.motors) {
      if (motor.joint != joint["name"]) continue;
      EXPECT_EQ(motor.torque_limit, joint["torque_limit"].get<double>()) << motor.joint;
    }
  }
}

TEST_P(HumanoidsTest, HoldsItsPosesByTheGainsOfTheExample) {
  const nlohmann::json hang = Figures(GetParam())["hang"];
  const robot::RobotSpec robot = ShippedRobot(GetParam());
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    EXPECT_EQ(robot.motors[i].hold_kp, hang["kp"][i].get<double>()) << robot.motors[i].joint;
    EXPECT_EQ(robot.motors[i].hold_kd, hang["kd"][i].get<double>()) << robot.motors[i].joint;
  }
}

// A pose that is a millimetre high drops softly; one that is low starts in the ground.
TEST_P(HumanoidsTest, StartsWithItsSolesJustAboveTheGround) {
  const nlohmann::json figures = Figures(GetParam());
  const robot::RobotSpec robot = ShippedRobot(GetParam());
  EXPECT_EQ(robot.standing.q, figures["stand"]["pose"].get<std::vector<double>>());
  const double above = robot.standing.height - figures["stand"]["height"].get<double>();
  EXPECT_GT(above, 0.0005);
  EXPECT_LT(above, 0.002);
  EXPECT_GT(robot.hanging.height, figures["zero_pose"]["height"].get<double>() + 0.2);
  EXPECT_EQ(robot.default_start, "hanging");
}

TEST_P(HumanoidsTest, PairsArePitchAndRollOfOneMechanism) {
  const robot::RobotSpec robot = ShippedRobot(GetParam());
  for (const robot::ParallelSpec& pair : robot.parallel) {
    const std::string& pitch = robot.motors[static_cast<std::size_t>(pair.pitch)].joint;
    const std::string& roll = robot.motors[static_cast<std::size_t>(pair.roll)].joint;
    EXPECT_NE(pitch.find("_pitch"), std::string::npos);
    EXPECT_EQ(pitch.substr(0, pitch.find("_pitch")), roll.substr(0, roll.find("_roll")));
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, HumanoidsTest, testing::ValuesIn(test::Humanoids()),
                         [](const auto& test) { return test.param; });

TEST(HumanoidSlotsTest, H1LeavesSlotNineToTheArmWeight) {
  const robot::RobotSpec robot = ShippedRobot("h1");
  EXPECT_EQ(robot.family, robot::WireFamily::kGo);
  EXPECT_EQ(robot.motors.size(), 19U);
  EXPECT_EQ(JointInSlot(robot, 2), "right_knee_joint");
  EXPECT_EQ(JointInSlot(robot, 8), "right_hip_yaw_joint");
  EXPECT_EQ(JointInSlot(robot, 9), "none");
  EXPECT_EQ(JointInSlot(robot, 10), "left_ankle_joint");
  EXPECT_EQ(JointInSlot(robot, 19), "left_elbow_joint");
}

TEST(HumanoidSlotsTest, H1HasNoMoreCellsThanItsMessage) {
  EXPECT_LE(ShippedRobot("h1").battery.cells, 15);  // unitree_go BmsState_.cell_vol
}

TEST(HumanoidSlotsTest, H12HasOneWaistMotorBetweenLegsAndArms) {
  const robot::RobotSpec robot = ShippedRobot("h1_2");
  EXPECT_EQ(robot.family, robot::WireFamily::kHg);
  EXPECT_EQ(robot.mode_machine, 6);
  EXPECT_EQ(JointInSlot(robot, 4), "left_ankle_pitch_joint");
  EXPECT_EQ(JointInSlot(robot, 12), "torso_joint");
  EXPECT_EQ(JointInSlot(robot, 26), "right_wrist_yaw_joint");
}

TEST(HumanoidSlotsTest, AG1OfTwentyThreeMotorsLeavesTheSlotsOfMissingJointsEmpty) {
  const robot::RobotSpec small = ShippedRobot("g1_23dof");
  const robot::RobotSpec large = ShippedRobot("g1");
  for (int slot = 0; slot < 35; ++slot) {
    const bool empty = slot == 13 || slot == 14 || slot == 20 || slot == 21 || slot >= 27;
    EXPECT_EQ(JointInSlot(small, slot), empty ? "none" : JointInSlot(large, slot)) << slot;
  }
}

TEST(HumanoidSlotsTest, R1LeavesTheSlotsOfMissingJointsEmpty) {
  const robot::RobotSpec robot = ShippedRobot("r1");
  EXPECT_EQ(robot.family, robot::WireFamily::kHg);
  for (const int slot : {14, 20, 21, 27, 28}) EXPECT_EQ(JointInSlot(robot, slot), "none") << slot;
  EXPECT_EQ(JointInSlot(robot, 12), "waist_roll_joint");
  EXPECT_EQ(JointInSlot(robot, 15), "left_shoulder_pitch_joint");
  EXPECT_EQ(JointInSlot(robot, 26), "right_wrist_roll_joint");
  EXPECT_EQ(JointInSlot(robot, 29), "head_pitch_joint");
  EXPECT_EQ(JointInSlot(robot, 30), "head_yaw_joint");
}

TEST(HumanoidSlotsTest, H2RollsItsAnkleBeforeItPitchesIt) {
  const robot::RobotSpec robot = ShippedRobot("h2");
  EXPECT_EQ(robot.family, robot::WireFamily::kHg);
  EXPECT_EQ(JointInSlot(robot, 4), "left_ankle_roll_joint");
  EXPECT_EQ(JointInSlot(robot, 5), "left_ankle_pitch_joint");
  EXPECT_EQ(JointInSlot(robot, 10), "right_ankle_roll_joint");
  EXPECT_EQ(JointInSlot(robot, 30), "head_yaw_joint");
}

}  // namespace
}  // namespace understudy::config
