#include "physics/set_down.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include <mujoco/mujoco.h>

#include "physics/mujoco_world.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

// A box of 0.2 m in all directions, its base in the middle, and a leg that ends 0.3 m below it.
constexpr char kRobot[] = R"(<mujoco><worldbody><body name="trunk"><freejoint/>
  <geom type="box" size=".1 .1 .1"/><site name="imu"/>
  <body name="leg"><joint name="knee"/><geom name="foot" pos=".05 0 -.28" size=".02"/></body>
</body></worldbody></mujoco>)";

class SetDownTest : public test::MujocoTest {
 protected:
  SetDownTest() {
    spec_.base_body = spec_.crane_body = "trunk";
    spec_.imu.site = "imu";
    spec_.motors.resize(1);
    spec_.motors[0].joint = "knee";
    spec_.feet = {{.name = "foot", .geoms = {"foot"}}};
  }

  // Height of the base when it is put at `height` over such ground.
  double Base(const std::string& ground, double height) {
    MujocoWorld world(LoadWorldModel({{spec_, folder_.Write("robot.xml", kRobot)}},
                                     folder_.Write("ground.xml", "<mujoco><worldbody>" + ground +
                                                                     "</worldbody></mujoco>"),
                                     0.001),
                      {{spec_}});
    robot::PoseSpec pose;
    pose.q = {0};
    pose.height = height;
    world.robot().Reset(pose);
    return world.robot().base().p_WB.z();
  }

  static std::string Box(const std::string& pos, const std::string& size = "1 1 .1") {
    return R"(<geom type="box" size=")" + size + R"(" pos=")" + pos + R"("/>)";
  }
  static std::string Plane(const std::string& z) {
    return R"(<geom type="plane" size="0 0 1" pos="0 0 )" + z + R"("/>)";
  }

  // MuJoCo's binary format: rows, columns, heights from 0 to 1.
  std::string Hill() {
    const std::int32_t rows = 3, columns = 3;
    const float heights[9] = {0, 0, 0, 0, 1, 0, 0, 0, 0};
    std::string bytes(reinterpret_cast<const char*>(&rows), sizeof rows);
    bytes.append(reinterpret_cast<const char*>(&columns), sizeof columns);
    bytes.append(reinterpret_cast<const char*>(heights), sizeof heights);
    return folder_.Write("hill.hf", bytes).string();
  }

  test::TemporaryFolder folder_;
  robot::RobotSpec spec_;
};

TEST_F(SetDownTest, ChangesNothingOnGroundAtNull) {
  EXPECT_EQ(Base(Plane("0"), 0.3), 0.3);
  EXPECT_EQ(Base(Plane("0"), 0.299), 0.299);  // pressed in a little, as a pose at rest is
  EXPECT_EQ(Base(Plane("0"), 1.3), 1.3);      // hanging
}

TEST_F(SetDownTest, TakesGroundWithinATenthOfAMillimetreForLevel) {
  for (const char* level : {"0.00009", "-0.00009"}) EXPECT_EQ(Base(Plane(level), 0.3), 0.3);
  EXPECT_NEAR(Base(Plane("0.00012"), 0.3), 0.30012, 2e-6);
  EXPECT_NEAR(Base(Plane("-0.00012"), 0.3), 0.29988, 2e-6);
}

TEST_F(SetDownTest, StandsOnGroundThatIsHigher) {
  EXPECT_NEAR(Base(Plane("2.5"), 0.3), 2.8, 1e-5);
  EXPECT_NEAR(Base(Plane("0") + Box("0 0 .1"), 0.3), 0.5, 1e-5);
}

TEST_F(SetDownTest, StandsOnGroundThatIsLower) {
  EXPECT_NEAR(Base(Plane("-1.5"), 0.3), -1.2, 1e-5);
}

TEST_F(SetDownTest, HangsAsHighOverTheGroundAsThePoseSays) {
  EXPECT_NEAR(Base(Plane("2"), 1.3), 3.3, 1e-5);
}

TEST_F(SetDownTest, StandsOnWhateverOfItTouchesFirst) {
  EXPECT_NEAR(Base(Plane("0") + Box("-.09 0 .15", ".01 .01 .15"), 0.3), 0.4, 1e-5);    // its trunk
  EXPECT_NEAR(Base(Plane("0") + Box(".05 0 .02", ".005 .005 .02"), 0.3), 0.34, 1e-5);  // its foot
}

TEST_F(SetDownTest, StandsOnTheFloorOfARoom) {
  EXPECT_EQ(Base(Plane("0") + Box("0 0 2"), 0.3), 0.3);
}

TEST_F(SetDownTest, StandsWhereItIsPlacedAndAsTurned) {
  const std::filesystem::path ground = folder_.Write(
      "ground.xml", "<mujoco><worldbody>" + Plane("0") + Box("2 1 0") + "</worldbody></mujoco>");
  const PlacedRobot placed{
      .spec = spec_, .file = folder_.Write("robot.xml", kRobot), .x = 2, .y = 1, .yaw = 0.5};
  MujocoWorld world(LoadWorldModel({placed}, ground, 0.001), {placed});
  robot::PoseSpec pose;
  pose.q = {0};
  pose.height = 0.3;
  world.robot().Reset(pose);
  EXPECT_NEAR((world.robot().base().p_WB - Eigen::Vector3d(2, 1, 0.4)).norm(), 0, 1e-9);
  const double* turned = world.data().qpos + 3;
  EXPECT_NEAR(turned[0], std::cos(0.25), 1e-9);
  EXPECT_NEAR(turned[3], std::sin(0.25), 1e-9);
}

TEST_F(SetDownTest, StandsOnAHeightFieldAndOnASlope) {
  // A hill of a pyramid, 0.5 m high in its middle.
  const std::string hill =
      R"(</worldbody><asset><hfield name="hill" size="1 1 .5 .1"
    file=")" +
      Hill() + R"("/></asset><worldbody><geom type="hfield" hfield="hill"/>)";
  EXPECT_NEAR(Base(hill, 0.3), 0.3 + 0.5 - 0.025, 0.03);
  const std::string slope = R"(<geom type="plane" size="0 0 1" euler="0 -30 0"/>)";
  EXPECT_GT(Base(slope, 0.3), 0.31);
}

TEST_F(SetDownTest, TakesNoNoticeOfWhatMoves) {
  EXPECT_EQ(Base(Plane("0") + R"(<body pos="0 0 .1"><freejoint/><geom size=".1"/></body>)", 0.3),
            0.3);
}

TEST_F(SetDownTest, StaysWhereItIsWithoutGround) { EXPECT_EQ(Base("", 0.3), 0.3); }

// A search places all shapes some 2000 times.
TEST_F(SetDownTest, SearchesNothingWhereContactsAreDisabled) {
  const mjcf::ModelHandle model = LoadModelFile(folder_.Write("robot.xml", kRobot));
  const mjcf::DataHandle data = mjcf::MakeData(*model);
  mj_kinematics(model.get(), data.get());
  const double placed = data->geom_xpos[2];
  data->qpos[2] = placed + 1;
  const int base = mj_name2id(model.get(), mjOBJ_BODY, "trunk");
  model->opt.disableflags |= mjDSBL_CONTACT;
  EXPECT_EQ(LiftOntoGround(*model, data.get(), base, 0), 0);
  EXPECT_EQ(data->geom_xpos[2], placed);
  model->opt.disableflags &= ~mjDSBL_CONTACT;
  EXPECT_EQ(LiftOntoGround(*model, data.get(), base, 0), 0) << "there is no ground";
  EXPECT_NE(data->geom_xpos[2], placed);
}

}  // namespace
}  // namespace understudy::physics
